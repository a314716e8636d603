"""Makes a cage around a model, twists the cage, and deforms the model."""
import numpy as np
import viete

dragon = viete.read("assets/dragon/dragon.ply")
vertices, faces = viete.make_cage(dragon.vertices, dragon.faces, triangles=120)
deformer = viete.Deformer(dragon.vertices, dragon.faces, vertices, faces)

# Rotates points about the vertical axis. The angle increases with x.
angle = 0.5 * vertices[:, 0]
bent = vertices.copy()
bent[:, 0] = np.cos(angle) * vertices[:, 0] + np.sin(angle) * vertices[:, 2]
bent[:, 2] = np.cos(angle) * vertices[:, 2] - np.sin(angle) * vertices[:, 0]
viete.write("twisted.ply", dragon, vertices=deformer.deform(bent))
print("a cage of %d triangles moves %d vertices" % (len(faces), len(dragon.vertices)))
