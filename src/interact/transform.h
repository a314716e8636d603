// The tools. Transforms points about a pivot, and shapes points between two ends.
#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "document/document.h"

namespace viete::interact {

/// `select` has no gizmo, but dragging a selected element moves the selection. `paint` paints the mask.
enum class Tool { select, move, rotate, scale, paint };

/// The constraint of a transform. A gizmo handle or an axis key sets it.
struct Constraint {
  /// `free` moves in the view plane, rotates about the view direction, or scales uniformly. `axis` moves or
  /// scales along one axis, or rotates about it. `plane` moves or scales along the other two axes.
  enum class Kind { free, axis, plane };

  Kind kind = Kind::free;
  int axis = 0;  ///< 0 x, 1 y, 2 z; for a plane, the axis of its normal

  friend bool operator==(const Constraint&, const Constraint&) = default;
};

/// A transform: scales along `axes`, then rotates, then moves. Lengths are in the file's units.
struct Transform {
  glm::dvec3 pivot{0, 0, 0};
  glm::dvec3 factors{1, 1, 1};
  glm::dmat3 axes{1};        ///< the scale axes: columns of length 1, right-handed
  glm::dvec3 axis{0, 0, 1};  ///< the rotation axis, of length 1
  double degrees = 0;        ///< right-handed; can be more than one turn
  glm::dvec3 shift{0, 0, 0};
  double amount = 0;  ///< the amount of taper, smooth or relax

  /// Returns the matrix of scale and rotation. Exact for multiples of 90 degrees about axes of the file.
  glm::dmat3 linear() const;
};

/// Applies a transform to points. If a point does not move, keeps its exact coordinates.
class PointMotion {
public:
  explicit PointMotion(const Transform& transform);
  /// Transforms the point about `pivot` instead of the transform's pivot.
  mesh::Point operator()(const mesh::Point& p, const glm::dvec3& pivot) const;

private:
  glm::dmat3 linear_;
  glm::dvec3 shift_;
  bool turns_;
};

/// The largest rotation of one edit: a thousand turns.
inline constexpr double most_degrees = 360000;

enum class Shape { none, bend, twist, taper, smooth, relax };

std::string_view name(Shape shape);
/// True if the amount of this shape is an angle in degrees; false if it is a factor.
constexpr bool is_angle(Shape shape) {
  return shape == Shape::bend || shape == Shape::twist;
}

struct Shaping {
  Shape shape = Shape::none;
  /// The fixed end and the moving end, in file coordinates. The effect grows linearly from `from` to `to`.
  glm::dvec3 from{0, 0, 0}, to{0, 0, 0};
  glm::dvec3 hinge{0, 0, 1};  ///< the bending axis, of length 1, perpendicular to `to - from`
  std::vector<mesh::Vec3>
      displacements;  ///< for smooth and relax: each grip vertex's displacement for the amount 1
};

mesh::Point shaped(const Shaping& shaping, double amount, const mesh::Point& p);

}  // namespace viete::interact
