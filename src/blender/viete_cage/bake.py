"""Bakes the deformation of an object to shape keys or a point cache."""
import os
import struct

import bpy
import numpy as np

from . import engine, follow
from .operators import OnMesh


def frames_of(context, obj):
    """Yields (frame, vertices) for every frame of the scene, then restores the current frame."""
    if not obj.viete.bound:
        raise engine.Error("Bind the object first")
    scene, now = context.scene, context.scene.frame_current
    try:
        for frame in range(scene.frame_start, scene.frame_end + 1):
            scene.frame_set(frame)
            yield frame, follow.deformed(obj, context.evaluated_depsgraph_get())
    finally:
        scene.frame_set(now)


def chosen(frames, tolerance):
    """The frames for shape keys. Linear interpolation gives all other frames within the tolerance."""
    def between(a, b):
        if b - a < 2:
            return []
        shares = (np.arange(a + 1, b) - a) / (b - a)
        off = [np.abs(frames[a] + t * (frames[b] - frames[a]) - frames[i]).max() for t, i in zip(shares, range(a + 1, b))]
        worst = int(np.argmax(off))
        if off[worst] <= tolerance:
            return []
        middle = a + 1 + worst
        return between(a, middle) + [middle] + between(middle, b)
    return [0] + between(0, len(frames) - 1) + ([len(frames) - 1] if len(frames) > 1 else [])


class VIETE_OT_bake_keys(OnMesh):
    """Bake all frames of the scene to animated shape keys, as few as the tolerance allows, and unbind"""

    bl_idname, bl_label = "viete.bake_keys", "Bake to shape keys"

    def act(self, context, obj):
        first = context.scene.frame_start
        frames = [vertices for _, vertices in frames_of(context, obj)]
        rest = follow.rest_of(obj)
        kept = chosen(frames, 0.01 * obj.viete.tolerance * np.linalg.norm(np.ptp(rest, axis=0)))
        follow.unbind(obj)
        if not obj.data.shape_keys:
            obj.shape_key_add(name="Basis")
        for place, index in enumerate(kept):
            key = obj.shape_key_add(name="Frame %d" % (first + index), from_mix=False)
            key.data.foreach_set("co", frames[index].ravel())
            for neighbour, value in ((place - 1, 0), (place, 1), (place + 1, 0)):
                if 0 <= neighbour < len(kept):
                    key.value = value
                    key.keyframe_insert("value", frame=first + kept[neighbour])
        for curve in obj.data.shape_keys.animation_data.action.fcurves:
            for point in curve.keyframe_points:
                point.interpolation = "LINEAR"
        self.report({"INFO"}, "Baked %d frames to %d shape keys" % (len(frames), len(kept)))


class VIETE_OT_bake_mdd(OnMesh):
    """Bake all frames of the scene to an MDD file for the Mesh Cache modifier and other programs"""

    bl_idname, bl_label = "viete.bake_mdd", "Bake to point cache (MDD)"
    filepath: bpy.props.StringProperty(subtype="FILE_PATH")
    filter_glob: bpy.props.StringProperty(default="*.mdd", options={"HIDDEN"})

    def invoke(self, context, _event):
        self.filepath = bpy.path.ensure_ext(context.object.name, ".mdd")
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def act(self, context, obj):
        scene = context.scene
        rate = scene.render.fps / scene.render.fps_base
        frames = [vertices for _, vertices in frames_of(context, obj)]
        times = np.arange(len(frames)) / rate
        whole = bpy.path.abspath(self.filepath)
        part = whole + ".part"  # when complete, replaces an existing file
        try:
            with open(part, "wb") as file:
                file.write(struct.pack(">ii", len(frames), len(obj.data.vertices)))
                file.write(times.astype(">f4").tobytes())
                for vertices in frames:
                    file.write(vertices.astype(">f4").tobytes())
            os.replace(part, whole)
        except OSError as error:
            if os.path.exists(part):
                os.remove(part)
            raise engine.Error("%s: %s; choose another file" % (self.filepath, error.strerror)) from error
        self.report({"INFO"}, "Saved %d frames to %s" % (len(frames), self.filepath))


classes = (VIETE_OT_bake_keys, VIETE_OT_bake_mdd)
