// Models far from the origin.
#pragma once

#include "mesh/surface.h"

namespace viete::test {

/// Moves the surface to coordinates at which floats are 0.5 apart.
inline mesh::Surface far_away(mesh::Surface s) {
  for (mesh::Point& p : s.positions) p = p + mesh::Point{431234.1, 5411987.2, 312.3};
  return s;
}

}  // namespace viete::test
