"""Poses the dragon by its cage; alert.ply equals the result of `viete deform`."""
import numpy as np
import viete

folder = "assets/dragon/"
dragon, cage = viete.read(folder + "dragon.ply"), viete.read(folder + "cage.obj")
deformer = viete.Deformer(dragon.vertices, dragon.faces, cage.vertices, cage.faces, way="smooth")
alert = deformer.deform(viete.read(folder + "pose_alert.obj").vertices)
viete.write("alert.ply", dragon, vertices=alert)


def volume(vertices):
    a, b, c = (vertices[dragon.triangles[:, i]] for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


print("volume: %.4f of what it was" % (volume(alert) / volume(dragon.vertices)))
