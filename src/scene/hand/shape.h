// Shaping between two ends: its parameters, and its effect on a point.
#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "mesh/surface.h"

namespace viete::scene {

enum class Shape { none, bend, twist, taper, push, smooth, relax, flatten };

/// "bend".
std::string_view name(Shape shape);
/// True if the amount is an angle in degrees; otherwise it is a factor, or for push a length in the file's
/// units.
constexpr bool is_angle(Shape shape) {
  return shape == Shape::bend || shape == Shape::twist;
}

struct Shaping {
  Shape shape = Shape::none;
  /// From the fixed end to the moving end; the amount grows linearly between them. File units.
  glm::dvec3 from{0, 0, 0}, to{0, 0, 0};
  glm::dvec3 hinge{0, 0, 1};  ///< bending axis; of length 1, perpendicular to from-to
  std::vector<mesh::Vec3>
      ways;  ///< displacement of each grip vertex for an amount of 1; of shapes without ends
};

/// The image of a point between the ends, for this amount.
mesh::Point shaped(const Shaping& shaping, double amount, const mesh::Point& p);

}  // namespace viete::scene
