// The tools that move what is selected, and the directions in which a drag may go.
#pragma once

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

}  // namespace viete::scene
