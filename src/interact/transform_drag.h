// Moving, rotating or scaling the selection with the mouse and typed numbers, from press to release or
// cancel.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "document/camera.h"
#include "document/document.h"
#include "interact/cursor_projection.h"
#include "interact/grip.h"
#include "interact/number_entry.h"
#include "interact/transform.h"

namespace viete::interact {

/// The cursor in one frame of a drag.
struct DragInput {
  glm::vec2 cursor;   ///< logical pixels
  bool snap = false;  ///< to 15 degrees, 0.1 of scale, a tenth of the grid cell
  bool slow = false;  ///< a tenth of the speed
};

/// One drag. Each update recomputes the selection from its positions at the press, so errors do not
/// accumulate. Rotations count turns: circling the pivot twice is 720 degrees. A typed number overrides the
/// mouse until it is deleted.
class TransformDrag {
public:
  /// Moves the vertices of the grip along its axes; a free move keeps the point at `depth` (view units) under
  /// the cursor. Requires a selection.
  TransformDrag(const document::Document& document, Grip grip, Tool tool, Constraint constraint, double depth,
                const glm::vec2& cursor, const document::Camera& camera);

  void update(document::Document& document, const DragInput& input, const document::Camera& camera,
              const document::Viewport& viewport);

  /// x y z: constrain to that axis; again: release; capital: constrain to the plane perpendicular to it.
  /// Among the shapes only bend uses an axis: its component perpendicular to from-to. Digits, point and
  /// minus: the amount. Returns true if the character was used; the next update shows it.
  bool type(char c);
  void backspace() { entry_.backspace(); }

  /// Changes the soft selection; the next update uses it.
  void soften(document::Document& document, const document::SoftSelection& soft,
              const document::Mirror* mirror);
  /// The number of calls of soften(): vertices() may change with each.
  int softened() const { return softened_; }

  /// Ends the drag as one history entry; records nothing if nothing moved.
  void commit(document::Document& document) const;
  /// Ends it and restores exactly the pose at the press.
  void cancel(document::Document& document) const;

  Tool tool() const { return tool_; }
  /// The cage vertices that it moves.
  std::span<const std::uint32_t> vertices() const { return vertices_; }
  const Grip& grip() const { return grip_; }
  const Constraint& constraint() const { return constraint_; }
  /// The selection's current transform.
  const Transform& transform() const { return transform_; }
  glm::vec2 press() const { return press_; }
  /// The amount as a text: "X 0.125", "Z 405.0\u00b0", "1.20"; a number being typed ends with an underscore.
  /// Ends with "too far" if the amount exceeds the range of a pose; then nothing moves.
  std::string readout() const;

private:
  void constrain(const Constraint& constraint);
  void bend_about(int axis);
  glm::dvec3 direction() const;
  Transform measured(const DragInput& input, const document::Camera& camera,
                     const document::Viewport& viewport);
  Transform typed(double value) const;
  glm::dvec3 move_by_mouse(const glm::dvec2& cursor, const document::Camera& camera,
                           const document::Viewport& viewport) const;
  double turn_by_mouse(const DragInput& input, const CursorProjection& projection);
  glm::dvec3 scale_by_mouse(const glm::dvec2& cursor, const CursorProjection& projection) const;
  glm::dvec3 factors(double value) const;
  glm::dvec3 snapped_shift(const glm::dvec3& shift) const;
  Transform still() const;
  Transform shaped_by(double amount, bool snap) const;
  double amount_by_way(double pixels) const;
  std::string shaped_amount() const;
  std::string label() const;
  std::string amounts() const;
  std::string axis_names() const;

  document::DocumentState before_;
  Grip grip_;
  std::vector<std::uint32_t> vertices_;
  document::Space space_;
  Tool tool_;
  Constraint constraint_;
  glm::dvec3 view_hinge_;         // axis of a bend in the view plane
  std::optional<int> along_way_;  // the last requested axis, if it is parallel to from-to
  glm::dvec3 pivot_, view_axis_;  // file units; towards the eye at the press
  double depth_;
  glm::dvec2 press_, cursor_, lag_{0, 0};  // lag: distance withheld by slow movement
  double turned_ = 0, turn_lag_ = 0;       // angle of the cursor around the pivot since the press, radians
  glm::dvec3 pulled_{0, 0, 0};             // unconstrained displacement of the mouse
  NumberEntry entry_;
  Transform transform_;
  bool in_range_ = true;  // the last update stayed in range
  int softened_ = 0;
};

}  // namespace viete::interact
