// The little vector algebra that this room needs on Point.
#pragma once

#include <cmath>

#include "mesh/surface.h"

namespace viete::mesh {

inline Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// No square leaves the range of double.
inline double length(const Point& a) {
  return std::hypot(a[0], a[1], a[2]);
}

}  // namespace viete::mesh
