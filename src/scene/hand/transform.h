// Tools, and moving, turning and scaling the selected vertices about a pivot: exact where nothing or whole
// turns are asked for.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/document/document.h"

namespace viete::scene {

/// select: no gizmo; the selection is then moved by dragging one of its elements. paint: nothing is moved,
/// but painted on the model.
enum class Tool { select, move, rotate, scale, paint };

/// One handle of a gizmo, or what was typed instead of grabbing it.
struct Constraint {
  /// free: move in the view plane, rotate about the view direction, scale evenly. axis: along or about it.
  /// plane: move or scale in both other axes.
  enum class Kind { free, axis, plane };

  Kind kind = Kind::free;
  int axis = 0;  ///< 0 x, 1 y, 2 z; of a plane its normal

  friend bool operator==(const Constraint&, const Constraint&) = default;
};

/// Scaled along axes, turned, then moved. Lengths in the file's units.
struct Transform {
  glm::dvec3 pivot{0, 0, 0};
  glm::dvec3 factors{1, 1, 1};
  glm::dmat3 axes{1};        ///< that the factors are along: columns of length 1, right-handed
  glm::dvec3 axis{0, 0, 1};  ///< of length 1
  double degrees = 0;  ///< right-handed, any number of turns; degrees, because 90 and 360 are exact in them
  glm::dvec3 shift{0, 0, 0};
  double amount = 0;  ///< of a grip that shapes without an angle

  /// Turn and scale as a matrix; multiples of 90 degrees about a file axis have entries 0, 1 and -1 only.
  glm::dmat3 linear() const;
};

/// A transform as it acts on points; whatever maps to itself keeps its bits.
class PointMotion {
public:
  explicit PointMotion(const Transform& transform);
  /// About this pivot, whatever the transform's is.
  mesh::Point operator()(const mesh::Point& p, const glm::dvec3& pivot) const;

private:
  glm::dmat3 linear_;
  glm::dvec3 shift_;
  bool turns_;
};

/// The largest turn that can be asked for at once: beyond a thousand turns angles lose digits.
inline constexpr double most_degrees = 360000;

}  // namespace viete::scene
