"""Checks viete's files with Blender's importers. A cage rotates a textured box, so all results are known."""
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import zlib

import bpy
import numpy

if "bool" not in dir(numpy):  # the glTF importer of Debian 12 uses a name that its numpy no longer has
    numpy.bool = bool
VIETE, FOLDER = sys.argv[sys.argv.index("--") + 1:]
COLORS = {"wood": (1, 1, 1), "red": (0.8, 0.1, 0.1)}
TEXTURED = "wood"
NEAR = 2e-4


def path(name):
    return os.path.join(FOLDER, name)


def put(name, data):
    with open(path(name), "wb" if isinstance(data, bytes) else "w") as file:
        file.write(data)


def turned(p):
    """Rotates p about the x axis and moves p. A fourth component 0 marks a direction: it is not moved."""
    c, s = math.cos(0.6), math.sin(0.6)
    w = p[3] if len(p) > 3 else 1
    return (p[0] + 0.25 * w, c * p[1] - s * p[2] - 0.5 * w, s * p[1] + c * p[2])


def png():
    """Returns an image of 4 x 4 pixels of different colours."""
    rows = b"".join(b"\0" + bytes(v for x in range(4) for v in (60 * x, 60 * y, 255 - 60 * x)) for y in range(4))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class Box:
    """A box. Each side has 2 x 2 quads, a part of the texture, a normal, and one of two materials."""

    def __init__(self):
        self.points, self.faces, numbers = [], [], {}
        for axis in range(3):
            for sign in (-1, 1):
                self.add_side(axis, sign, numbers)

    def add_side(self, axis, sign, numbers):
        side = 2 * axis + (sign > 0)
        normal = tuple(sign * (i == axis) for i in range(3))
        u, v = ((axis + 1) % 3, (axis + 2) % 3) if sign > 0 else ((axis + 2) % 3, (axis + 1) % 3)

        def corner(i, j):
            p = [0, 0, 0]
            p[axis], p[u], p[v] = sign, i - 1, j - 1
            p = (p[0], 0.8 * p[1], 0.6 * p[2])
            number = numbers.setdefault(p, len(numbers))
            if number == len(self.points):
                self.points.append(p)
            return number, ((side % 3 + i / 2) / 3, (side // 3 + j / 2) / 2)

        for i in range(2):
            for j in range(2):
                corners = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]
                self.faces.append((corners, normal, "wood" if side < 4 else "red"))

    def corners(self):
        """Returns (place, texture point, normal, material) for every corner of the rotated box."""
        return [(turned(self.points[n]), uv, turned(normal + (0,)), material)
                for corners, normal, material in self.faces for n, uv in corners]


def obj_of(box):
    lines = ["mtllib model.mtl", "o box"] + ["v %g %g %g" % p for p in box.points]
    faces, material = [], None
    for corners, normal, used in box.faces:
        lines += ["vt %.9g %.9g" % uv for _, uv in corners] + ["vn %g %g %g" % normal]
        faces += ["usemtl " + used] if used != material else []
        n, material = len(faces) - sum(f.startswith("usemtl") for f in faces), used
        faces.append("f " + " ".join("%d/%d/%d" % (c[0] + 1, 4 * n + k + 1, n + 1) for k, c in enumerate(corners)))
    return "\n".join(lines + faces) + "\n"


def mtl():
    return "".join("newmtl %s\nKd %g %g %g\n%s" % (name, *color, "map_Kd wood.png\n" if name == TEXTURED else "")
                   for name, color in COLORS.items())


def glb_of(box):
    data, views, accessors, primitives = b"", [], [], []

    def view(piece):
        nonlocal data
        data += b"\0" * (-len(data) % 4)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(piece)})
        data += piece
        return len(views) - 1

    def accessor(rows, kind, code, component):
        piece = struct.pack("<%d%s" % (sum(len(r) for r in rows), code), *[x for r in rows for x in r])
        accessors.append({"bufferView": view(piece), "componentType": component, "count": len(rows), "type": kind,
                          "min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]})
        return len(accessors) - 1

    for number, name in enumerate(COLORS):
        faces = [f for f in box.faces if f[2] == name]
        corners = [(box.points[n], (u, 1 - v), normal) for cs, normal, _ in faces for n, (u, v) in cs]
        triangles = [(4 * f + a,) for f in range(len(faces)) for a in (0, 1, 2, 0, 2, 3)]
        primitives.append({"material": number, "indices": accessor(triangles, "SCALAR", "H", 5123), "attributes": {
            "POSITION": accessor([c[0] for c in corners], "VEC3", "f", 5126),
            "TEXCOORD_0": accessor([c[1] for c in corners], "VEC2", "f", 5126),
            "NORMAL": accessor([c[2] for c in corners], "VEC3", "f", 5126)}})
    materials = []
    for name, color in COLORS.items():
        look = {"baseColorFactor": list(color) + [1]}
        if name == TEXTURED:
            look["baseColorTexture"] = {"index": 0}
        materials.append({"name": name, "pbrMetallicRoughness": look})
    image = view(png())
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": primitives}], "materials": materials, "textures": [{"source": 0}],
                "images": [{"bufferView": image, "mimeType": "image/png", "name": "wood"}],
                "bufferViews": views, "accessors": accessors, "buffers": [{"byteLength": len(data)}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    return (struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(data), len(text), 0x4E4F534A) + text +
            struct.pack("<II", len(data), 0x004E4942) + data)


def vertex_color(p):
    return tuple(int(127.5 + 100 * x) for x in p)


def ply_of(box):
    """Returns a PLY file. Each vertex has a texture point and a colour, because Blender reads these attributes."""
    head = ["ply", "format ascii 1.0", "element vertex %d" % len(box.points)]
    head += ["property float " + n for n in "xyz"] + ["property uchar " + n for n in ("red", "green", "blue")]
    head += ["property float s", "property float t", "element face %d" % len(box.faces),
             "property list uchar int vertex_indices", "end_header"]
    rows = ["%g %g %g %d %d %d %g %g" % (p + vertex_color(p) + ply_texture(p)) for p in box.points]
    return "\n".join(head + rows + ["4 %d %d %d %d" % tuple(c[0] for c in f[0]) for f in box.faces]) + "\n"


def ply_texture(p):
    return ((p[0] + 1) / 2, (p[2] + 1) / 2)


def stl_of(box):
    data = b""
    for corners, normal, _ in box.faces:
        for a, b, c in ((0, 1, 2), (0, 2, 3)):
            data += struct.pack("<12fH", *normal, *[x for k in (a, b, c) for x in box.points[corners[k][0]]], 0x801F)
    return b"made up".ljust(80) + struct.pack("<I", 2 * len(box.faces)) + data


def cage(pose):
    points = [(x, y, z) for x in (-1.5, 1.5) for y in (-1.5, 1.5) for z in (-1.5, 1.5)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    lines = ["v %.17g %.17g %.17g" % pose(p) for p in points]
    for a, b, c, d in quads:
        lines += ["f %d %d %d" % (a + 1, b + 1, c + 1), "f %d %d %d" % (a + 1, c + 1, d + 1)]
    return "\n".join(lines) + "\n"


def imported(name):
    """Imports a file with one mesh. Returns Blender's object, and True if the file has y up."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    extension = name.rsplit(".", 1)[1]
    candidates = {"obj": ("wm.obj_import", "import_scene.obj"), "ply": ("wm.ply_import", "import_mesh.ply"),
                  "stl": ("wm.stl_import", "import_mesh.stl"), "glb": ("import_scene.gltf",)}[extension]
    for candidate in candidates:
        group, operator = candidate.split(".")
        if operator in dir(getattr(bpy.ops, group)):
            break
    assert getattr(getattr(bpy.ops, group), operator)(filepath=path(name)) == {"FINISHED"}, name
    objects = [o for o in bpy.context.scene.objects if o.type == "MESH"]
    assert len(objects) == 1, "%s: %d meshes" % (name, len(objects))
    return objects[0], extension in ("obj", "glb")


def corner_normals(mesh):
    if hasattr(mesh, "calc_normals_split"):
        mesh.calc_normals_split()
        return [tuple(loop.normal) for loop in mesh.loops]
    return [tuple(n.vector) for n in mesh.corner_normals]


def near(a, b):
    return all(abs(x - y) < NEAR for x, y in zip(a, b))


def check_same(name, found, expected):
    for what, some, others in (("unexpected", found, expected), ("missing", expected, found)):
        odd = [s for s in some if not any(all(near(x, y) if isinstance(x, tuple) else x == y for x, y in zip(s, o))
                                          for o in others)]
        assert not odd, "%s: %d %s, such as %s" % (name, len(odd), what, odd[0])


def found_corners(scene_object, y_up, texture, normals, materials):
    """Returns the position and the requested attributes of every corner."""
    mesh, world = scene_object.data, scene_object.matrix_world
    directions = corner_normals(mesh) if normals else None
    back = (lambda v: (v[0], v[2], -v[1])) if y_up else tuple
    found = []
    for polygon in mesh.polygons:
        for i in polygon.loop_indices:
            corner = (back(world @ mesh.vertices[mesh.loops[i].vertex_index].co),)
            if texture:
                corner += (tuple(mesh.uv_layers[0].data[i].uv),)
            if normals:
                turn = world.to_3x3().normalized()
                corner += (back(turn @ type(turn.col[0])(directions[i])),)
            if materials:
                corner += (mesh.materials[polygon.material_index].name,)
            found.append(corner)
    return found


def image_of(material):
    images = [n.image for n in material.node_tree.nodes if n.type == "TEX_IMAGE" and n.image]
    return images[0] if images else None


def check_materials(name, mesh):
    assert sorted(m.name for m in mesh.materials) == sorted(COLORS), "%s: %s" % (name, mesh.materials.keys())
    for material in mesh.materials:
        image = image_of(material)
        assert (image is not None) == (material.name == TEXTURED), "%s: texture of %s" % (name, material.name)
        if image:
            assert tuple(image.size) == (4, 4), "%s: image of %s pixels" % (name, tuple(image.size))
            upper_right = image.pixels[4 * 15:4 * 15 + 3]
            assert near(upper_right, (180 / 255, 0, 75 / 255)), "%s: pixel %s" % (name, tuple(upper_right))


def check_counts(name, mesh, vertices, faces):
    if vertices:
        assert len(mesh.vertices) == vertices, "%s: %d vertices for %d" % (name, len(mesh.vertices), vertices)
    assert len(mesh.polygons) == faces, "%s: %d faces for %d" % (name, len(mesh.polygons), faces)


def deform(model, out, rest="cage.obj"):
    print(out)
    subprocess.run([VIETE, "deform", path(model), path(rest), "--pose", path("posed.obj"), "-o", path(out)],
                   check=True)


def check_textured(box, out):
    """Checks positions, texture points and normals. If the model has this format, also checks materials and image."""
    scene_object, y_up = imported(out)
    quads, own = out == "obj.obj", out in ("obj.obj", "glb.glb")
    check_counts(out, scene_object.data, len(box.points) if out.endswith("obj") else None,
                 len(box.faces) * (1 if quads else 2))
    check_same(out, found_corners(scene_object, y_up, True, True, own), box.corners())
    if own:
        check_materials(out, scene_object.data)


def check_ply_vertices(box, out):
    scene_object, y_up = imported(out)
    mesh = scene_object.data
    expected = [(turned(p), ply_texture(p)) for p in box.points]
    check_same(out, found_corners(scene_object, y_up, True, False, False), expected)
    assert len(mesh.color_attributes) == 1, "%s: no colours" % out


def check_places(box, out, faces):
    scene_object, y_up = imported(out)
    check_counts(out, scene_object.data, len(box.points), faces)
    check_same(out, found_corners(scene_object, y_up, False, False, False), [(turned(p),) for p in box.points])


def check_blue():
    """Checks that facet colours of an STL become vertex colours in a GLB."""
    deform("model.stl", "stl.glb")
    mesh = imported("stl.glb")[0].data
    colors = mesh.color_attributes[0].data
    assert len(colors) > 0 and all(near(c.color, (0, 0, 1, 1)) for c in colors), "stl.glb: colours"


FRAMES = (1, 4, 6, 11)


def animate(out, *words):
    print(out)
    subprocess.run([VIETE, "animate", "model.obj", "cage.obj", "--keys", "key_##.obj", "-o", out, *words], check=True,
                   cwd=FOLDER)


def written_places(frame):
    with open(path("frame_%02d.obj" % frame)) as file:
        return [tuple(float(x) for x in line.split()[1:4]) for line in file if line.startswith("v ")]


def places_at(scene_object, frame):
    """Returns the vertices at a frame, in object coordinates."""
    bpy.context.scene.frame_set(int(frame), subframe=frame % 1)
    shown = scene_object.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    places = [tuple(v.co) for v in mesh.vertices]
    shown.to_mesh_clear()
    return places


def check_cache(out):
    animate(out)
    scene_object, _ = imported("frame_01.obj")
    cache = scene_object.modifiers.new("cache", "MESH_CACHE")
    cache.cache_format = out[-3:].upper()
    cache.filepath = path(out)
    cache.frame_start = 1
    for frame in FRAMES:
        expected, found = written_places(frame), places_at(scene_object, frame)
        assert len(found) == len(expected), "%s: %d vertices for %d" % (out, len(found), len(expected))
        odd = [v for v, (a, b) in enumerate(zip(found, expected)) if not near(a, b)]
        assert not odd, "%s: frame %d: vertex %d is at %s" % (out, frame, odd[0], found[odd[0]])


def check_morphs(out):
    animate(out)
    scene_object, _ = imported(out)
    curves = scene_object.data.shape_keys.animation_data.action.fcurves
    first = min(point.co[0] for curve in curves for point in curve.keyframe_points)
    for frame in FRAMES:
        found = [(p[0], p[2], -p[1]) for p in places_at(scene_object, first + frame - 1)]  # the importer has exchanged axes
        expected = written_places(frame)
        lost = [p for p in expected if not any(math.dist(p, q) < 1e-3 for q in found)]
        assert not lost, "%s: frame %d: nothing is at %s" % (out, frame, lost[0])


def check_animations():
    """Compares point caches and morph targets of the rotating box with the model at each frame."""
    put("key_01.obj", cage(tuple))
    put("key_11.obj", cage(turned))
    animate("frame_##.obj", "--digits", "all")
    check_cache("box.pc2")
    check_cache("box.mdd")
    check_morphs("box.glb")


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    os.makedirs(FOLDER)
    box = Box()
    for name, data in (("model.obj", obj_of(box)), ("model.mtl", mtl()), ("wood.png", png()), ("model.glb", glb_of(box)),
                       ("model.ply", ply_of(box)), ("model.stl", stl_of(box)), ("cage.obj", cage(tuple)),
                       ("posed.obj", cage(turned))):
        put(name, data)
    for model, out in (("model.obj", "obj.obj"), ("model.obj", "obj.glb"), ("model.glb", "glb.glb"),
                       ("model.glb", "glb.obj"), ("glb.obj", "glb_obj.glb")):
        deform(model, out, rest="posed.obj" if model == "glb.obj" else "cage.obj")  # posed.obj is already rotated
        check_textured(box, out)
    for model, out in (("model.ply", "ply.ply"), ("model.ply", "ply.glb")):
        deform(model, out)
        check_ply_vertices(box, out)
    for model, out, faces in (("model.obj", "obj.ply", 1), ("model.obj", "obj.stl", 2), ("model.stl", "stl.stl", 2),
                              ("model.stl", "stl.obj", 2), ("model.stl", "stl.ply", 2)):
        deform(model, out)
        check_places(box, out, faces * len(box.faces))
    check_blue()
    check_animations()
    print("Blender %s sees what viete wrote" % bpy.app.version_string)


main()
