// Ways of shaping what is between two ends: numbers, and what they make of a point.
#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "mesh/surface.h"

namespace viete::scene {

enum class Shape { none, bend, twist, taper, push, smooth, relax, flatten };

/// "bend".
std::string_view name(Shape shape);
/// True if the amount is an angle in degrees; else a factor or share, or, of push, a length in the file's
/// units.
constexpr bool is_angle(Shape shape) {
  return shape == Shape::bend || shape == Shape::twist;
}

struct Shaping {
  Shape shape = Shape::none;
  /// From the end that stays to the one that goes; in between the amount grows evenly. File units.
  glm::dvec3 from{0, 0, 0}, to{0, 0, 0};
  glm::dvec3 hinge{0, 0, 1};     ///< about which it bends; of length 1, across the way
  std::vector<mesh::Vec3> ways;  ///< of each vertex of the grip, by an amount of 1; of what has no ends
};

/// A point between the ends, at this amount.
mesh::Point shaped(const Shaping& shaping, double amount, const mesh::Point& p);

}  // namespace viete::scene
