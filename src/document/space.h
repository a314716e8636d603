// Converts between file coordinates (in double) and view coordinates (in float, near the origin).
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "mesh/surface.h"
#include "mesh/vector.h"

namespace viete::document {

/// view = (file - center) * scale. In view coordinates, float is precise enough for any size and position.
struct Space {
  mesh::Point center{0, 0, 0};
  double scale = 1;

  glm::vec3 to_view(const mesh::Point& p) const {
    return {static_cast<float>((p[0] - center[0]) * scale), static_cast<float>((p[1] - center[1]) * scale),
            static_cast<float>((p[2] - center[2]) * scale)};
  }

  mesh::Point to_file(const glm::dvec3& p) const {
    return {center[0] + p.x / scale, center[1] + p.y / scale, center[2] + p.z / scale};
  }

  /// Returns the model's diagonal in file coordinates. A single point has the diagonal 2.
  double diagonal() const { return 2 / scale; }
};

/// Returns the cell size of the ground grid, about 1/20 of the diagonal: 1, 2 or 5 times a power of ten.
inline double grid_cell(double diagonal) {
  if (!(diagonal > 0) || !std::isfinite(diagonal)) return 1;
  const double wanted = diagonal / 20;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  const double mantissa = wanted / decade;
  return decade * (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10);
}

/// Returns the space in which the diagonal of the box is 2. If the box has no size, the scale is 1.
inline Space space_for(const mesh::Bounds& box) {
  const double diagonal = box.diagonal();
  return {box.center(), diagonal > 0 ? 2.0 / diagonal : 1.0};
}

inline glm::dvec3 vector_of(const mesh::Vec3& p) {
  return {p[0], p[1], p[2]};
}
inline mesh::Vec3 point_of(const glm::dvec3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace viete::document
