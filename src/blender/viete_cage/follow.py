"""Updates deformed objects after each change of the scene and each frame change."""
import ctypes

import bmesh
import bpy
import numpy as np
from bpy.app.handlers import persistent

from . import engine

KEY = "Viete cage"        # shape key with the deformed vertices
REST, STAMP = "viete_rest", "viete_content"

MOST_KEPT = 16  # deformers kept for later; each uses memory or a child process

deformers = {}  # deformers by the hash of model, cage, settings and mask
current = {}    # the deformer of each object
followed = {}   # the last cage pose of each object
busy = False


def rest_of(obj):
    """The undeformed model: the basis shape key or, without shape keys, the mesh."""
    keys = obj.data.shape_keys
    source = keys.reference_key.data if keys else obj.data.vertices
    rest = np.empty((len(source), 3), np.float32)
    source.foreach_get("co", rest.ravel())
    return rest


def coordinates(cage, depsgraph):
    """The cage's vertices: in edit mode the edited mesh, otherwise after shape keys, armatures and modifiers."""
    if cage.mode == "EDIT":
        return np.array([v.co for v in bmesh.from_edit_mesh(cage.data).verts], np.float32).reshape(-1, 3)
    mesh = cage.evaluated_get(depsgraph).data
    places = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", places.ravel())
    return places


def pose_of(obj, depsgraph):
    """The cage's vertices in the object's space, so that moving both objects together changes nothing."""
    cage = obj.viete.cage
    places = coordinates(cage, depsgraph)
    to_object = np.array(obj.matrix_world.inverted_safe() @ cage.matrix_world, np.float64)
    return places @ to_object[:3, :3].T + to_object[:3, 3]


def mask_of(obj):
    group = obj.vertex_groups.get(obj.viete.mask)
    if not obj.viete.mask:
        return None
    if not group:
        raise engine.Error("Vertex group %s does not exist; choose another vertex group as mask" % obj.viete.mask)
    shares = np.zeros(len(obj.data.vertices), np.float32)
    for v in obj.data.vertices:
        for g in v.groups:
            if g.group == group.index:
                shares[v.index] = g.weight
    return shares


def bytes_of(faces):
    return (faces.shape, faces.tobytes()) if isinstance(faces, np.ndarray) else tuple(f.tobytes() for f in faces)


def deformer_of(obj):
    """The object's deformer, cached until model or mask may change. Equal objects use one deformer."""
    if obj.name in current:
        return current[obj.name]
    settings, rest, mask = obj.viete, rest_of(obj), mask_of(obj)
    cage_rest = np.frombuffer(obj[REST], np.float64).reshape(-1, 3)
    faces, cage_faces = engine.corners_of(obj.data), engine.corners_of(settings.cage.data)
    content = hash((rest.tobytes(), bytes_of(faces), cage_rest.tobytes(), bytes_of(cage_faces), settings.deformer, settings.arap,
                    None if mask is None else mask.tobytes()))
    if content not in deformers:
        for old in list(deformers)[:-MOST_KEPT]:
            if deformers[old] not in current.values():
                del deformers[old]
        deformers[content] = engine.make(rest, faces, cage_rest, cage_faces, settings.deformer, settings.arap, mask)
    current[obj.name] = deformers[content]
    return deformers[content]


def check(obj):
    """Raises Error if the object cannot be bound."""
    for is_wrong, problem in (
        (not obj.viete.cage, "Choose a cage, then bind"),
        (obj.viete.cage == obj, "An object cannot be its own cage; choose another object"),
        (obj.data.users > 1, "Other objects share this mesh; use Object, Relations, Make Single User first"),
        (obj.mode == "EDIT", "The object is in edit mode; leave edit mode first"),
    ):
        if is_wrong:
            raise engine.Error(problem)


def let_go(obj):
    """Forgets the deformer and the last pose of the object."""
    current.pop(obj.name, None)
    followed.pop(obj.name, None)


def bind(obj, depsgraph):
    check(obj)
    let_go(obj)
    obj[REST] = pose_of(obj, depsgraph).tobytes()
    deformer_of(obj)
    if not obj.data.shape_keys:
        obj.shape_key_add(name="Basis")
    key = obj.data.shape_keys.key_blocks.get(KEY) or obj.shape_key_add(name=KEY, from_mix=False)
    key.value = 1
    obj.viete.bound, obj.viete.problem = True, ""


def unbind(obj):
    keys = obj.data.shape_keys
    if keys and KEY in keys.key_blocks:
        obj.shape_key_remove(keys.key_blocks[KEY])
    obj.viete.bound, obj.viete.problem = False, ""
    let_go(obj)
    obj.pop(REST, None)


def deformed(obj, depsgraph):
    """The model's vertices, (n, 3) float32, for the current cage."""
    pose = pose_of(obj, depsgraph)
    bound = len(obj[REST]) // 24
    if len(pose) != bound:
        raise engine.Error("The cage has %d vertices, but had %d when it was bound; bind again or remove its modifiers"
                           % (len(pose), bound))
    out = np.empty((len(obj.data.vertices), 3), np.float32)
    deformer_of(obj).deform(pose, out)
    return out


def write(key, places):
    """Sets the vertices of a shape key. Copying bytes is 50 times as fast as foreach_set."""
    points = key.data
    count = len(points)
    try:
        first, last = points[0].as_pointer(), points[count - 1].as_pointer()
    except (AttributeError, IndexError):
        first = last = 0
    if first and last - first == 12 * (count - 1):
        ctypes.memmove(first, np.ascontiguousarray(places, np.float32).ctypes.data, 12 * count)
    else:
        points.foreach_set("co", places.ravel())


def update(obj, depsgraph):
    """If the cage has moved, updates the shape key of the object."""
    settings = obj.viete
    key = obj.data.shape_keys and obj.data.shape_keys.key_blocks.get(KEY)
    if obj.mode != "OBJECT":  # the model or the mask may change
        let_go(obj)
    if not settings.cage or not key or obj.mode == "EDIT":
        return
    problem = ""
    try:
        now = pose_of(obj, depsgraph).tobytes()
        if followed.get(obj.name) == now:
            return
        followed[obj.name] = now
        write(key, deformed(obj, depsgraph))
        obj.data.shape_keys.update_tag()
    except ValueError as error:
        problem = str(error)
    if settings.problem != problem:
        settings.problem = problem


@persistent
def follow(scene, depsgraph=None):
    global busy
    if busy:
        return
    busy = True
    try:
        depsgraph = depsgraph or bpy.context.evaluated_depsgraph_get()
        for obj in scene.objects:
            if obj.type == "MESH" and obj.viete.bound:
                update(obj, depsgraph)
    finally:
        busy = False


@persistent
def forget(*_):
    """Clears the caches after loading a file, undo or redo."""
    current.clear()
    followed.clear()


HANDLERS = (("depsgraph_update_post", follow), ("frame_change_post", follow), ("load_post", forget), ("undo_post", forget),
            ("redo_post", forget))


def register():
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
    deformers.clear()
    forget()
