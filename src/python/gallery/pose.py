"""Poses the dragon by its cage. The file alert.ply has the same bytes as the result of `viete deform`."""
import numpy as np
import viete

folder = "assets/dragon/"
dragon, cage = viete.read(folder + "dragon.ply"), viete.read(folder + "cage.obj")
deformer = viete.Deformer(dragon.vertices, dragon.faces, cage.vertices, cage.faces, deformer="smooth")
alert = deformer.deform(viete.read(folder + "pose_alert.obj").vertices)
viete.write("alert.ply", dragon, vertices=alert)


def volume(vertices):
    a, b, c = (vertices[corners] for corners in np.asarray(dragon.faces).T)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


print("the volume is %.4f times the volume at rest" % (volume(alert) / volume(dragon.vertices)))
