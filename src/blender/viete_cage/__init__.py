"""Deforms objects by cages, with the module `viete`."""

bl_info = {
    "name": "Viete cages",
    "description": "Deforms objects by cages, smoothly and without artefacts",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D View, sidebar, Viete",
    "category": "Animation",
}

import bpy

from . import bake, follow, operators, panel, settings


def register():
    for module in (settings, operators, bake, panel):
        for cls in module.classes:
            bpy.utils.register_class(cls)
    bpy.types.Object.viete = bpy.props.PointerProperty(type=settings.VieteSettings)
    follow.register()


def unregister():
    follow.unregister()
    del bpy.types.Object.viete
    for module in (panel, bake, operators, settings):
        for cls in reversed(module.classes):
            bpy.utils.unregister_class(cls)
