"""The sidebar panel of the 3D view."""
import bpy

from . import engine


class VIETE_PT_cage(bpy.types.Panel):
    bl_idname, bl_label = "VIETE_PT_cage", "Cage"
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Viete"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        layout, settings = self.layout, context.object.viete
        layout.use_property_split = True
        try:
            layout.label(text=engine.how())
        except engine.Error as error:
            layout.label(text=str(error), icon="ERROR")
            return
        fields = layout.column()
        fields.enabled = not settings.bound
        fields.prop(settings, "cage")
        if not settings.cage:
            fields.prop(settings, "triangles")
            fields.operator("viete.make_cage")
        fields.prop(settings, "deformer")
        fields.prop(settings, "arap")
        fields.prop_search(settings, "mask", context.object, "vertex_groups")
        layout.operator("viete.unbind" if settings.bound else "viete.bind")
        if settings.problem:
            layout.label(text=settings.problem, icon="ERROR")
        if not settings.bound:
            return
        if context.object.modifiers:
            layout.label(text="Modifiers apply after the cage", icon="INFO")
        box = layout.box()
        box.label(text="Bake")
        box.prop(settings, "tolerance")
        box.operator("viete.bake_keys")
        box.operator("viete.bake_mdd")


classes = (VIETE_PT_cage,)
