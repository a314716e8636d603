// Tools; moving, rotating and scaling vertices about a pivot, exact for the identity and for whole turns; and
// shaping them between two ends.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "document/document.h"

namespace viete::interact {

/// select: no gizmo; the selection moves by dragging one of its elements. paint: paints on the model and
/// moves nothing.
enum class Tool { select, move, rotate, scale, paint };

/// The constraint of a transform, set by a gizmo handle or by typing an axis.
struct Constraint {
  /// free: move in the view plane, rotate about the view direction, scale uniformly. axis: along or about it.
  /// plane: move or scale along the other two axes.
  enum class Kind { free, axis, plane };

  Kind kind = Kind::free;
  int axis = 0;  ///< 0 x, 1 y, 2 z; for a plane its normal

  friend bool operator==(const Constraint&, const Constraint&) = default;
};

/// Scale along axes, then rotate, then translate. Lengths in the file's units.
struct Transform {
  glm::dvec3 pivot{0, 0, 0};
  glm::dvec3 factors{1, 1, 1};
  glm::dmat3 axes{1};        ///< scale axes: columns of length 1, right-handed
  glm::dvec3 axis{0, 0, 1};  ///< rotation axis, of length 1
  double degrees = 0;        ///< right-handed, any number of turns; in degrees, where 90 and 360 are exact
  glm::dvec3 shift{0, 0, 0};
  double amount = 0;  ///< for a shape without an angle

  /// Rotation and scale as a matrix; multiples of 90 degrees about a file axis have entries 0, 1 and -1 only.
  glm::dmat3 linear() const;
};

/// Applies a transform to points; points that map to themselves keep their bits.
class PointMotion {
public:
  explicit PointMotion(const Transform& transform);
  /// About this pivot; ignores the transform's pivot.
  mesh::Point operator()(const mesh::Point& p, const glm::dvec3& pivot) const;

private:
  glm::dmat3 linear_;
  glm::dvec3 shift_;
  bool turns_;
};

/// The largest rotation of one edit: beyond a thousand turns angles lose digits.
inline constexpr double most_degrees = 360000;

/// Shaping between two ends, or by displacements.
enum class Shape { none, bend, twist, taper, smooth, relax };

/// "bend".
std::string_view name(Shape shape);
/// True if the amount is an angle in degrees; otherwise it is a factor.
constexpr bool is_angle(Shape shape) {
  return shape == Shape::bend || shape == Shape::twist;
}

struct Shaping {
  Shape shape = Shape::none;
  /// From the fixed end to the moving end; the amount grows linearly between them. File units.
  glm::dvec3 from{0, 0, 0}, to{0, 0, 0};
  glm::dvec3 hinge{0, 0, 1};  ///< bending axis; of length 1, perpendicular to from-to
  /// For shapes without ends: the displacement of each grip vertex for an amount of 1.
  std::vector<mesh::Vec3> ways;
};

/// The image of a point between the ends, for this amount.
mesh::Point shaped(const Shaping& shaping, double amount, const mesh::Point& p);

}  // namespace viete::interact
