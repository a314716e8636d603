// Bending, twisting and tapering what is selected between two ends, and pushing, smoothing, relaxing and
// flattening it: one amount, by which each vertex goes its own way.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "mesh/surface.h"

namespace viete::scene {

class Camera;
struct Document;
struct Grip;

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

/// Of the pose as it is. The end that stays is the pivot, unless that is the median: then the joint with the
/// rest. The other one is the active element, or else the far end of the selection. It bends in the plane of
/// the view. Nothing to be done, Shape::none, where both ends are one.
Shaping shaping_of(const Document& document, Shape shape, const Grip& grip, bool at_median,
                   const Camera& camera);

/// Across the way, as near to this direction as can be, of length 1; nothing where that is along the way.
std::optional<glm::dvec3> hinge_near(const Shaping& shaping, const glm::dvec3& direction);

}  // namespace viete::scene
