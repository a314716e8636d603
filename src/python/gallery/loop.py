"""Computes the frames of a session, as `viete animate` writes them."""
import numpy as np
import viete

session = viete.Session("assets/dragon/loop.viete")
first, last = session.range
snout = int(session.vertices[:, 0].argmax())
way = np.array([session.frame(frame)[snout] for frame in range(first, last + 1, 5)])
print("in frames %d to %d the snout goes %.2f along, %.2f up, %.2f across" % (first, last, *np.ptp(way, axis=0)))
