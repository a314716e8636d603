"""Deforms a model in float32, always into the same array, and measures the time of a frame."""
import time

import numpy as np
import viete

folder = "assets/dragon/"
dragon, cage = viete.read(folder + "dragon.ply"), viete.read(folder + "cage.obj")
deformer = viete.Deformer(dragon.vertices, dragon.faces, cage.vertices, cage.faces, dtype="float32")
flight = viete.read(folder + "pose_flight.obj").vertices
poses = viete.PoseSpace(cage.vertices, cage.faces, [cage.vertices, flight])

out = np.empty((len(dragon.vertices), 3), np.float32)
times = []
for wing in 0.5 - 0.5 * np.cos(np.linspace(0, 20 * np.pi, 1000)):
    pose = poses.between(wing)
    begun = time.perf_counter()
    deformer.deform(pose, out=out)
    times.append(time.perf_counter() - begun)
print("a frame of %d vertices takes %.2f ms" % (len(out), 1e3 * np.median(times)))
