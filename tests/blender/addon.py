"""Tests the add-on in Blender: blender -b --factory-startup --python addon.py -- ADDONS PROGRAM FOLDER"""
import os
import pathlib
import struct
import subprocess
import sys
import time
import traceback

import bpy
import numpy as np

ADDONS, PROGRAM, FOLDER = sys.argv[sys.argv.index("--") + 1:][:3]
sys.path.insert(0, ADDONS)
os.environ["PATH"] = os.path.dirname(PROGRAM) + os.pathsep + os.environ["PATH"]
import viete_cage  # noqa: E402
from viete_cage import engine, follow  # noqa: E402

viete_cage.register()
FOLDER = pathlib.Path(FOLDER)


def key_of(obj):
    places = np.empty((len(obj.data.vertices), 3), np.float32)
    obj.data.shape_keys.key_blocks[follow.KEY].data.foreach_get("co", places.ravel())
    return places


def select(obj):
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)


def new_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 25
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4, radius=1)
    ball = bpy.context.object
    ball.viete.triangles = 60
    bpy.ops.viete.make_cage()
    bpy.ops.viete.bind()
    return ball, ball.viete.cage


def bend(cage, name="bent", amount=0.8):
    """Adds a shape key that twists the cage in proportion to height."""
    if not cage.data.shape_keys:
        cage.shape_key_add(name="Basis")
    key = cage.shape_key_add(name=name, from_mix=False)
    for v, point in zip(cage.data.vertices, key.data):
        x, y, z = v.co
        c, s = np.cos(amount * z), np.sin(amount * z)
        point.co = (c * x - s * y, s * x + c * y, z)
    return key


def update():
    bpy.context.view_layer.update()


def expected(ball, deformer="smooth"):
    """Returns the expected vertices. Calls the engine directly."""
    import viete
    depsgraph = bpy.context.evaluated_depsgraph_get()
    rest = np.frombuffer(ball[follow.REST], np.float64).reshape(-1, 3)
    d = viete.Deformer(follow.rest_of(ball), engine.corners_of(ball.data), rest, engine.corners_of(ball.viete.cage.data), deformer,
                       dtype="float32")
    return d.deform(follow.pose_of(ball, depsgraph))


def it_follows_shape_keys_and_edits():
    ball, cage = new_scene()
    rest = follow.rest_of(ball)
    assert np.abs(key_of(ball) - rest).max() < 1e-5
    bend(cage).value = 1
    update()
    assert np.abs(key_of(ball) - rest).max() > 0.2
    assert np.abs(key_of(ball) - expected(ball)).max() < 1e-5
    cage.data.shape_keys.key_blocks["bent"].value = 0
    update()
    assert np.abs(key_of(ball) - rest).max() < 1e-5
    select(cage)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.translate(value=(0, 0, 0.5))
    update()
    moved = key_of(ball) - rest
    assert np.abs(moved - [0, 0, 0.5]).max() < 1e-4, moved
    bpy.ops.object.mode_set(mode="OBJECT")


def moving_both_objects_deforms_nothing():
    ball, cage = new_scene()
    rest = follow.rest_of(ball)
    for obj in (ball, cage):
        obj.location, obj.rotation_euler, obj.scale = (3, 1, -2), (0.3, 0.2, 0.1), (2, 2, 2)
    update()
    assert np.abs(key_of(ball) - rest).max() < 1e-4
    cage.location.z += 2  # 2 units of the world are 1 unit of the ball, which is scaled by 2
    update()
    assert abs(np.linalg.norm((key_of(ball) - rest).mean(axis=0)) - 1) < 1e-3


def an_armature_moves_the_cage_over_frames():
    ball, cage = new_scene()
    bpy.ops.object.armature_add()
    armature = bpy.context.object
    modifier = cage.modifiers.new("Armature", "ARMATURE")
    modifier.object = armature
    group = cage.vertex_groups.new(name="Bone")
    group.add([v.index for v in cage.data.vertices if v.co.z > 0], 1, "REPLACE")
    bone = armature.pose.bones["Bone"]
    bone.rotation_mode = "XYZ"
    for frame, angle in ((1, 0.0), (25, 1.0)):
        bone.rotation_euler = (0, 0, angle) if frame == 1 else (angle, 0, 0)
        bone.keyframe_insert("rotation_euler", frame=frame)
    seen = []
    for frame in (1, 13, 25):
        bpy.context.scene.frame_set(frame)
        assert np.abs(key_of(ball) - expected(ball)).max() < 1e-4
        seen.append(key_of(ball))
    assert np.abs(seen[0] - seen[2]).max() > 0.2 and np.abs(seen[1] - seen[2]).max() > 0.05


def bakes_to_cache_and_keys():
    ball, cage = new_scene()
    key = bend(cage)
    for frame, value in ((1, 0), (13, 1), (25, 0.2)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    frames = []
    for frame in range(1, 26):
        bpy.context.scene.frame_set(frame)
        frames.append(key_of(ball))
    select(ball)
    file = FOLDER / "ball.mdd"
    bpy.ops.viete.bake_mdd(filepath=str(file))
    data = file.read_bytes()
    count, points = struct.unpack(">ii", data[:8])
    assert (count, points) == (25, len(ball.data.vertices)) and len(data) == 8 + 4 * 25 + 12 * 25 * points
    cached = np.frombuffer(data, ">f4", offset=8 + 4 * 25).reshape(25, -1, 3)
    assert np.abs(cached - np.array(frames)).max() < 1e-5
    places = np.empty((points, 3), np.float32)
    ball.viete.tolerance = 0.2
    bpy.ops.viete.bake_keys()
    assert not ball.viete.bound and follow.KEY not in ball.data.shape_keys.key_blocks
    diagonal = np.linalg.norm(np.ptp(follow.rest_of(ball), axis=0))
    for index in range(25):
        bpy.context.scene.frame_set(index + 1)
        mesh = ball.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        mesh.vertices.foreach_get("co", places.ravel())
        assert np.abs(places - frames[index]).max() < 0.0021 * diagonal, index
    assert 3 < len(ball.data.shape_keys.key_blocks) < 26


def clothed_figure():
    """Adds a body and an open tunic in one cage. Two bones bend and rotate the cage over 100 frames."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 100
    bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=24, radius=1)
    body = bpy.context.object
    for v in body.data.vertices:
        v.co.z *= 2
    bpy.ops.mesh.primitive_cylinder_add(vertices=48, radius=1.15, depth=2.4, end_fill_type="NOTHING")
    tunic = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=6)
    bpy.ops.object.mode_set(mode="OBJECT")
    select(body)
    body.viete.triangles = 80
    bpy.ops.viete.make_cage()
    cage = tunic.viete.cage = body.viete.cage
    bpy.ops.object.armature_add(location=(0, 0, -2))
    armature = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    lower = armature.data.edit_bones[0]
    lower.name, lower.tail = "lower", (0, 0, 2)
    upper = armature.data.edit_bones.new("upper")
    upper.parent, upper.head, upper.tail = lower, (0, 0, 2), (0, 0, 4)
    bpy.ops.object.mode_set(mode="OBJECT")
    for name in ("lower", "upper"):
        group = cage.vertex_groups.new(name=name)
        for v in cage.data.vertices:
            share = min(max(0.5 + 0.5 * v.co.z, 0), 1)
            group.add([v.index], share if name == "upper" else 1 - share, "REPLACE")
    cage.modifiers.new("Armature", "ARMATURE").object = armature
    bone = armature.pose.bones["upper"]
    bone.rotation_mode = "XYZ"
    for frame, angles in ((1, (0, 0, 0)), (40, (1.1, 0.8, 0)), (70, (-0.9, 2.2, 0.3)), (100, (0.2, -1.5, -0.6))):
        bone.rotation_euler = angles
        bone.keyframe_insert("rotation_euler", frame=frame)
    for obj in (body, tunic):
        select(obj)
        bpy.ops.viete.bind()
    return body, tunic, cage


def baked_frames_are_those_of_the_program():
    """Bakes 100 frames of body and clothes. Compares every eleventh frame with `viete deform`."""
    body, tunic, cage = clothed_figure()
    checked = range(1, 101, 11)
    engine.write_obj(FOLDER / "rest_cage.obj", np.frombuffer(body[follow.REST], np.float64).reshape(-1, 3), engine.corners_of(cage.data))
    for frame in checked:
        bpy.context.scene.frame_set(frame)
        pose = follow.pose_of(body, bpy.context.evaluated_depsgraph_get())
        engine.write_obj(FOLDER / ("cage_%03d.obj" % frame), pose, engine.corners_of(cage.data))
    for obj in (body, tunic):
        select(obj)
        rest, file = follow.rest_of(obj), FOLDER / "baked.mdd"
        bpy.ops.viete.bake_mdd(filepath=str(file))
        baked = np.frombuffer(file.read_bytes(), ">f4", offset=8 + 4 * 100).reshape(100, -1, 3)
        engine.write_obj(FOLDER / "model.obj", rest, engine.corners_of(obj.data))
        for frame in checked:
            subprocess.run([PROGRAM, "deform", "model.obj", "rest_cage.obj", "--pose", "cage_%03d.obj" % frame, "--deformer", "smooth", "-o",
                            "posed.obj", "--force"], cwd=FOLDER, check=True, capture_output=True)
            lines = (FOLDER / "posed.obj").read_text().splitlines()
            posed = np.array([line.split()[1:4] for line in lines if line.startswith("v ")], float)
            off = np.abs(posed - baked[frame - 1]).max()
            assert off < 2e-5, (obj.name, frame, off)
        assert np.abs(baked[69] - rest).max() > 0.5


def blend_file_keeps_the_binding():
    ball, cage = new_scene()
    bend(cage).value = 0.7
    update()
    before = key_of(ball)
    file = str(FOLDER / "kept.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    bpy.ops.wm.open_mainfile(filepath=file)
    ball = bpy.data.objects["Icosphere"]
    made = len(follow.deformers)
    update()
    assert ball.viete.bound and np.abs(key_of(ball) - before).max() < 1e-6
    ball.viete.cage.data.shape_keys.key_blocks["bent"].value = 0.2
    update()
    assert np.abs(key_of(ball) - before).max() > 0.1
    assert len(follow.deformers) == made  # update() found the cached deformer


def several_objects_share_a_cage_with_masks():
    ball, cage = new_scene()
    bpy.ops.mesh.primitive_cube_add(size=0.8)
    cube = bpy.context.object
    group = cube.vertex_groups.new(name="held")
    group.add([0, 1, 2, 3], 0.0, "REPLACE")
    group.add([4, 5, 6, 7], 1.0, "REPLACE")
    cube.viete.cage, cube.viete.mask = cage, "held"
    bpy.ops.viete.bind()
    bend(cage).value = 1
    update()
    rest, now = follow.rest_of(cube), key_of(cube)
    assert np.abs(now[:4] - rest[:4]).max() < 1e-6 and np.abs(now[4:] - rest[4:]).max() > 0.02
    assert np.abs(key_of(ball) - expected(ball)).max() < 1e-5
    select(cube)
    bpy.ops.viete.unbind()
    assert follow.KEY not in cube.data.shape_keys.key_blocks


def binding_depends_on_faces():
    ball, cage = new_scene()
    before = follow.deformer_of(ball)
    for polygon in cage.data.polygons:
        polygon.flip()
    follow.forget()
    assert follow.deformer_of(ball) is not before
    follow.MOST_KEPT, kept = 2, follow.MOST_KEPT
    for amount in range(6):
        ball.data.shape_keys.reference_key.data[0].co.x += 0.01
        follow.let_go(ball)
        follow.deformer_of(ball)
    follow.MOST_KEPT = kept
    assert len(follow.deformers) <= 4, len(follow.deformers)


def undo_restores_the_deformation():
    ball, cage = new_scene()
    key = bend(cage)
    update()
    rest = follow.rest_of(ball)
    bpy.ops.ed.undo_push(message="before")
    key.value = 1
    update()
    bpy.ops.ed.undo_push(message="bent")
    assert np.abs(key_of(ball) - rest).max() > 0.2
    bpy.ops.ed.undo()
    ball = bpy.data.objects["Icosphere"]
    update()
    assert ball.viete.cage.data.shape_keys.key_blocks["bent"].value == 0
    assert np.abs(key_of(ball) - rest).max() < 1e-5
    bpy.ops.ed.redo()
    ball = bpy.data.objects["Icosphere"]
    update()
    assert np.abs(key_of(ball) - expected(ball)).max() < 1e-5 and np.abs(key_of(ball) - rest).max() > 0.2


def problems_are_reported():
    ball, cage = new_scene()
    cage.modifiers.new("Subdivision", "SUBSURF")
    update()
    assert "had" in ball.viete.problem and "modifier" in ball.viete.problem, ball.viete.problem
    cage.modifiers.clear()
    bend(cage).value = 0.5
    update()
    assert ball.viete.problem == ""
    select(ball)
    bpy.ops.viete.unbind()
    for change, words in ((lambda: setattr(ball.viete, "cage", ball), "its own cage"), (lambda: setattr(ball.viete, "cage", None), "Choose a cage")):
        change()
        try:
            bpy.ops.viete.bind()
            raise AssertionError(words)
        except RuntimeError as error:
            assert words in str(error), error
    ball.viete.cage, ball.viete.mask = cage, "nothing"
    try:
        bpy.ops.viete.bind()
        raise AssertionError("mask")
    except RuntimeError as error:
        assert "group nothing does not exist" in str(error)


def works_with_the_program():
    ball, cage = new_scene()
    bend(cage).value = 0.6
    update()
    by_module, module = key_of(ball), engine.viete
    select(ball)
    bpy.ops.viete.unbind()
    follow.deformers.clear()
    follow.forget()
    engine.viete = None
    try:
        cage.data.shape_keys.key_blocks["bent"].value = 0
        update()
        bpy.ops.viete.bind()
        cage.data.shape_keys.key_blocks["bent"].value = 0.6
        update()
        assert ball.viete.problem == "", ball.viete.problem
        assert np.abs(key_of(ball) - by_module).max() < 1e-4
        select(ball)
        bpy.ops.viete.unbind()
        ball.vertex_groups.new(name="none")
        ball.viete.mask = "none"
        bpy.ops.viete.bind()
        assert np.abs(key_of(ball) - follow.rest_of(ball)).max() < 1e-6
        program = follow.deformer_of(ball).program
        program.kill()  # simulates a crash
        cage.data.shape_keys.key_blocks["bent"].value = 0.1
        update()
        assert "bind again" in ball.viete.problem, ball.viete.problem
    finally:
        engine.viete = module


def edits_are_fast():
    """Compares the time for 50,000 vertices and about 100 triangles with Blender's Mesh Deform."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=250, ring_count=201)
    ball = bpy.context.object
    ball.viete.triangles = 100
    bpy.ops.viete.make_cage()
    cage = ball.viete.cage
    key = bend(cage)

    def edits(count=15):
        times = []
        for i in range(count):
            key.value = 0.03 * i
            begun = time.perf_counter()
            update()
            times.append(time.perf_counter() - begun)
        return 1e3 * float(np.median(times))

    nothing = edits()
    times = []
    for _ in range(15):
        ball.update_tag(refresh={"DATA"})
        begun = time.perf_counter()
        update()
        times.append(time.perf_counter() - begun)
    again = 1e3 * float(np.median(times))
    modifier = ball.modifiers.new("MeshDeform", "MESH_DEFORM")
    modifier.object, modifier.precision = cage, 5
    key.value = 0
    update()
    select(ball)
    bpy.ops.object.meshdeform_bind(modifier=modifier.name)
    theirs = edits() if modifier.is_bound else float("nan")
    ball.modifiers.clear()
    key.value = 0
    update()
    bpy.ops.viete.bind()
    ours = edits()
    out, pose = np.empty((len(ball.data.vertices), 3), np.float32), follow.pose_of(ball, bpy.context.evaluated_depsgraph_get())
    times = []
    for i in range(30):
        begun = time.perf_counter()
        follow.deformer_of(ball).deform(pose * (1 + 1e-3 * i), out)
        times.append(time.perf_counter() - begun)
    print("edit of a cage of %d triangles, %d vertices: nothing bound %.2f ms, the same mesh evaluated again %.2f ms, "
          "Mesh Deform %.2f ms, Viete %.2f ms, of which the deformer %.2f ms"
          % (len(cage.data.polygons), len(ball.data.vertices), nothing, again, theirs, ours, 1e3 * np.median(times)))


TESTS = (it_follows_shape_keys_and_edits, moving_both_objects_deforms_nothing, an_armature_moves_the_cage_over_frames, bakes_to_cache_and_keys,
         baked_frames_are_those_of_the_program, blend_file_keeps_the_binding, several_objects_share_a_cage_with_masks, binding_depends_on_faces,
         undo_restores_the_deformation, problems_are_reported, works_with_the_program, edits_are_fast)
failed = 0
for test in TESTS:
    try:
        test()
        print("passed", test.__name__)
    except Exception:
        traceback.print_exc()
        print("FAILED", test.__name__)
        failed += 1
sys.stdout.flush()
os._exit(1 if failed else 0)
