"""Computes frames of a session, as `viete animate` writes them, and follows a vertex."""
import numpy as np
import viete

session = viete.Session("assets/dragon/loop.viete")
first, last = session.range
snout = int(session.vertices[:, 0].argmax())
path = np.array([session.frame(frame)[snout] for frame in range(first, last + 1, 5)])
print("from frame %d to %d the snout moves %.2f in x, %.2f in y, %.2f in z" % (first, last, *np.ptp(path, axis=0)))
