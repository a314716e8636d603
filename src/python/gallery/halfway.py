"""Interpolates halfway between rest and a shape: log space keeps edge lengths, straight lines do not."""
import numpy as np
import viete

folder = "assets/dragon/"
dragon = viete.read(folder + "dragon.ply")
coiled = np.fromfile(folder + "shape_coiled.pc2", "<f4", offset=32).reshape(-1, 3)
space = viete.ShapeSpace(dragon.vertices, dragon.faces, [dragon.vertices, coiled])


def lengths(vertices):
    corners = vertices[dragon.triangles]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)


wanted = np.sqrt(lengths(dragon.vertices) * lengths(coiled))
for straight in (False, True):
    off = np.abs(np.log(lengths(space.between(0.5, straight)) / wanted))
    print("straight lines" if straight else "log space", ": edges are off by a factor of %.3f" % np.exp(np.mean(off)))
