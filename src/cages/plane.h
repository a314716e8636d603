// A plane.
#pragma once

#include "mesh/vector.h"

namespace viete::cages {

/// Points p with dot(normal, p) = offset; normal is a unit vector.
struct Plane {
  mesh::Vec3 normal{1, 0, 0};
  double offset = 0;

  friend bool operator==(const Plane&, const Plane&) = default;
};

}  // namespace viete::cages
