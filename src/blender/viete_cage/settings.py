"""What an object keeps of its cage, in the .blend."""
import bpy

WAYS = [
    ("smooth", "Smooth", "Spreads along the surface, keeps shapes and holds parts together: for most models"),
    ("paper", "Paper", "As published: each triangle turns and stretches all of the model, by distance"),
    ("mean-value", "Mean value", "The cage's vertices only move: follows affine poses exactly, caves in where parts turn"),
    ("rigid", "Rigid", "Turns without stretching: keeps details and sizes"),
    ("arap", "As rigid as possible", "Solved for all at once: details keep their shape best, frames take longer"),
    ("local", "Local", "Ends at a radius: what no triangle of the cage reaches stays at rest"),
]


def is_mesh(_settings, candidate):
    return candidate.type == "MESH"


class VieteSettings(bpy.types.PropertyGroup):
    cage: bpy.props.PointerProperty(name="Cage", type=bpy.types.Object, poll=is_mesh, description="The mesh that moves this one")
    way: bpy.props.EnumProperty(name="Way", items=WAYS, default="smooth", description="How parts of the cage share a vertex")
    stitched: bpy.props.BoolProperty(name="Stitched", description="Solve for the model so that its triangles keep their shape")
    mask: bpy.props.StringProperty(name="Mask", description="A vertex group: how much of its motion each vertex makes; empty: all")
    triangles: bpy.props.IntProperty(name="Triangles", default=200, min=12, max=20000, description="Of a cage that is made, about")
    bound: bpy.props.BoolProperty(name="Bound")
    problem: bpy.props.StringProperty(name="Problem")
    tolerance: bpy.props.FloatProperty(name="Tolerance", default=0.1, min=0.001, max=10, subtype="PERCENTAGE",
                                       description="How far shape keys may be off, of the model's diagonal")


classes = (VieteSettings,)
