"""Pulls the dragon's snout; other vertices follow example shapes."""
import numpy as np
import viete

folder = "assets/dragon/"
dragon = viete.read(folder + "dragon.ply")
shapes = [np.fromfile(folder + f"shape_{name}.pc2", "<f4", offset=32).reshape(-1, 3) for name in ("coiled", "folded", "sitting")]
space = viete.ShapeSpace(dragon.vertices, dragon.faces, shapes)

snout, tail = int(dragon.vertices[:, 0].argmax()), int(dragon.vertices[:, 0].argmin())
wanted = dragon.vertices[[snout, tail]] + [[-0.2, 0.3, 0], [0, 0, 0]]
pulled, weights = space.pose([snout, tail], wanted)
viete.write("pulled.ply", dragon, vertices=pulled)
print("distance of the snout from its place: %.1e; weights of the shapes: %s" % (
    np.linalg.norm(pulled[snout] - wanted[0]), np.round(weights, 2)))
