"""Operators: make a cage, bind, unbind."""
import bpy

from . import engine, follow


class OnMesh(bpy.types.Operator):
    """Base class of operators on the active mesh."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def execute(self, context):
        try:
            self.act(context, context.object)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class VIETE_OT_make_cage(OnMesh):
    """Create a closed cage mesh around this object"""

    bl_idname, bl_label = "viete.make_cage", "Make cage"

    def act(self, context, obj):
        vertices, faces = engine.make_cage(follow.rest_of(obj), engine.corners_of(obj.data), obj.viete.triangles)
        mesh = bpy.data.meshes.new(obj.name + " cage")
        mesh.from_pydata([tuple(v) for v in vertices], [], [[int(c) for c in f] for f in faces])
        mesh.update()
        cage = bpy.data.objects.new(obj.name + " cage", mesh)
        cage.matrix_world = obj.matrix_world
        cage.display_type = "WIRE"
        cage.hide_render = True
        (obj.users_collection[0] if obj.users_collection else context.collection).objects.link(cage)
        obj.viete.cage = cage


class VIETE_OT_bind(OnMesh):
    """Bind this object to the cage at their current positions; the cage then deforms it"""

    bl_idname, bl_label = "viete.bind", "Bind"

    def act(self, context, obj):
        follow.bind(obj, context.evaluated_depsgraph_get())


class VIETE_OT_unbind(OnMesh):
    """Unbind this object from the cage and restore its shape"""

    bl_idname, bl_label = "viete.unbind", "Unbind"

    def act(self, context, obj):
        follow.unbind(obj)


classes = (VIETE_OT_make_cage, VIETE_OT_bind, VIETE_OT_unbind)
