"""Settings of a deformed object, stored in the .blend file."""
import bpy

DEFORMERS = [
    ("smooth", "Smooth", "Weights follow the surface and keep shapes. Best for most models"),
    ("paper", "As published", "Each cage triangle rotates and stretches the whole model, weighted by distance"),
    ("mean-value", "Mean value", "Interpolates positions. Exact for affine poses, but parts that rotate shrink"),
    ("rigid", "Rigid", "Rotates without stretching. Keeps details and sizes"),
    ("arap", "As rigid as possible", "Optimises all vertices together. Keeps details best, but is slower"),
    ("local", "Local", "Weights end at a radius. Vertices farther away stay at rest"),
]


def is_mesh(_settings, candidate):
    return candidate.type == "MESH"


class VieteSettings(bpy.types.PropertyGroup):
    cage: bpy.props.PointerProperty(name="Cage", type=bpy.types.Object, poll=is_mesh, description="Mesh that deforms this object")
    deformer: bpy.props.EnumProperty(name="Deformer", items=DEFORMERS, default="smooth", description="How the cage deforms the object")
    arap: bpy.props.BoolProperty(name="ARAP", description="Solve for a mesh that is as rigid as possible")
    mask: bpy.props.StringProperty(name="Mask", description="Vertex group whose weights scale the motion of vertices. Leave empty for full motion")
    triangles: bpy.props.IntProperty(name="Triangles", default=200, min=12, max=20000, description="Approximate number of triangles of a new cage")
    bound: bpy.props.BoolProperty(name="Bound")
    problem: bpy.props.StringProperty(name="Problem")
    tolerance: bpy.props.FloatProperty(name="Tolerance", default=0.1, min=0.001, max=10, subtype="PERCENTAGE",
                                       description="Maximum error of baked shape keys, in percent of the model's diagonal")


classes = (VieteSettings,)
