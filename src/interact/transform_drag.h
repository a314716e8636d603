// Moves, rotates or scales the selection, by the mouse or by typed numbers.
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

struct DragInput {
  glm::vec2 cursor;   ///< in logical pixels
  bool snap = false;  ///< rounds to 15 degrees, to a factor of 0.1, or to a tenth of a grid cell
  bool slow = false;  ///< follows the mouse at a tenth of the speed
};

/// One drag, from press to release. Each update starts from the positions at the press, so that errors do not
/// add up. If the cursor circles the pivot twice, rotates by 720 degrees. A typed number replaces the mouse.
class TransformDrag {
public:
  /// Requires a selection. If a move has no constraint, the point at `depth` (in view units) stays under the
  /// cursor.
  TransformDrag(const document::Document& document, Grip grip, Tool tool, Constraint constraint, double depth,
                const glm::vec2& cursor, const document::Camera& camera);

  void update(document::Document& document, const DragInput& input, const document::Camera& camera);

  /// Handles a typed character. If the character has no effect, returns false.
  /// - x, y and z constrain to this axis; X, Y and Z constrain to the plane perpendicular to this axis
  /// - rotations and bends have no plane: X, Y and Z act like x, y and z; other shapes have no constraint
  /// - the same character again removes the constraint
  /// - digits, point, comma and minus enter the amount
  bool type(char c);
  void backspace() { entry_.backspace(); }

  /// Restores the pose at the press. From the next update on, uses the given soft selection.
  void soften(document::Document& document, const document::SoftSelection& soft,
              const document::Mirror* mirror);
  /// Returns the number of calls of soften(). Each call can change vertices().
  int softened() const { return softened_; }

  /// If the selection moved, records the drag as one undoable edit.
  void commit(document::Document& document) const;
  /// Restores the exact pose at the press.
  void cancel(document::Document& document) const;

  Tool tool() const { return tool_; }
  std::span<const std::uint32_t> vertices() const { return vertices_; }
  const Grip& grip() const { return grip_; }
  const Constraint& constraint() const { return constraint_; }
  const Transform& transform() const { return transform_; }
  glm::vec2 press() const { return press_; }
  /// Returns the amount as text, such as "X 0.125", "Z 405.0\u00b0" or "1.20". While the user types a number,
  /// the text ends with an underscore. If the amount is out of range, nothing moves and "too far" is added.
  std::string readout() const;

private:
  void constrain(const Constraint& constraint);
  void bend_about(int axis);
  glm::dvec3 direction() const;
  Transform measured(const DragInput& input, const document::Camera& camera);
  Transform typed(double value) const;
  glm::dvec3 move_by_mouse(const glm::dvec2& cursor, const CursorProjection& projection,
                           const document::Camera& camera) const;
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
  glm::dvec3 view_hinge_;               // the axis for bending in the view plane
  std::optional<int> unbendable_axis_;  // the last typed axis, if no bend about it is possible
  glm::dvec3 pivot_, view_axis_;        // view_axis_: the direction to the eye
  double depth_;
  glm::dvec2 press_, cursor_, lag_{0, 0};  // lag_: slow mode subtracts it from the cursor position
  double turned_ = 0, turn_lag_ = 0;       // turned_: the cursor's angle since the press, in radians
  glm::dvec3 pulled_{0, 0, 0};             // the displacement by the mouse
  NumberEntry entry_;
  Transform transform_;
  bool in_range_ = true;  // false if the last update was out of range
  int softened_ = 0;
};

/// The axis lines and the rotation arc that are drawn during a drag, in logical pixels.
struct DragGuides {
  glm::vec2 start{0, 0};                   ///< the pivot at the start of the drag
  std::vector<int> axes;                   ///< the axes along which the drag moves or scales
  std::vector<glm::vec2> axis_directions;  ///< the direction of each axis on screen, of length 1
  /// The arc of a rotation, without its whole turns. Empty for other drags, and for a ring seen edge-on.
  std::vector<glm::vec2> arc;
  int whole_turns = 0;
  std::vector<glm::vec2> circle;  ///< the full circle; empty before the first whole turn
};

DragGuides drag_guides(const TransformDrag& drag, const document::Space& space,
                       const document::Camera& camera);

/// Transforms the vertices of the grip, or the selected probes, from their pose in `before`. `degrees_seen`
/// is the rotation of the current pose. If Transform::degrees differs much from `degrees_seen`, rotates in
/// small steps to count whole turns. |degrees| must be at most most_degrees. If the result is out of range
/// (document/range.h), restores the pose of `before` and returns false.
bool place(document::Document& document, const document::DocumentState& before, const Grip& grip,
           const Transform& transform, double degrees_seen);

/// Transforms the selection as an undoable edit. Requires a selection. If the result is out of range, changes
/// nothing and returns false.
bool transform_selection(document::Document& document, Tool tool, const Grip& grip,
                         const Transform& transform);

}  // namespace viete::interact
