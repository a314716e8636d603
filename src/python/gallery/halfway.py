"""Interpolates halfway between two shapes. Compares edge lengths in log space and with linear interpolation."""
import numpy as np
import viete

folder = "assets/dragon/"
dragon = viete.read(folder + "dragon.ply")
coiled = np.fromfile(folder + "shape_coiled.pc2", "<f4", offset=32).reshape(-1, 3)
space = viete.ShapeSpace(dragon.vertices, dragon.faces, [dragon.vertices, coiled])


def lengths(vertices):
    corners = vertices[dragon.faces]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)


expected = np.sqrt(lengths(dragon.vertices) * lengths(coiled))
for linear in (False, True):
    off = np.abs(np.log(lengths(space.between(0.5, linear)) / expected))
    print("%s: edge lengths are wrong by a factor of %.3f" % ("linear" if linear else "log space", np.exp(np.mean(off))))
