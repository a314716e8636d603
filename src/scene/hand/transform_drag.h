// Moving, rotating or scaling the selection by the mouse and by typed numbers, from press to release or to
// "as it was".
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/document/camera.h"
#include "scene/document/document.h"
#include "scene/hand/cursor_projection.h"
#include "scene/hand/grip.h"
#include "scene/hand/number_entry.h"
#include "scene/hand/transform.h"

namespace viete::scene {

/// The cursor of one frame of a drag.
struct DragInput {
  glm::vec2 cursor;   ///< logical pixels
  bool snap = false;  ///< to 15 degrees, a tenth of scale, a tenth of the grid's cell
  bool slow = false;  ///< a tenth of the speed
};

/// One drag. Each update places the selection anew from where it was at the press, so that nothing
/// accumulates. Turns are counted: going round the pivot twice is 720 degrees. A typed number replaces what
/// the mouse says until it is deleted.
class TransformDrag {
public:
  /// The grip is what moves, along its axes; `depth` (view units) is that of the point which a free move
  /// keeps under the cursor. Requires a selection.
  TransformDrag(const Document& document, Grip grip, Tool tool, Constraint constraint, double depth,
                const glm::vec2& cursor, const Camera& camera);

  void update(Document& document, const DragInput& input, const Camera& camera, const Viewport& viewport);

  /// x y z: along or about that axis, the same again: freely as at first; capital: in the plane across it.
  /// Of the shapes only a bend has such an axis: about it, as far as that is across the way. Digits, point
  /// and minus: the amount. Says whether the character meant something; the next update shows it.
  bool type(char c);
  void backspace() { entry_.backspace(); }

  /// Other shares of what is near the selection; the next update moves it so.
  void soften(Document& document, const SoftSelection& soft, const Mirror* mirror);
  /// How often that was asked for: vertices() may be others since.
  int softened() const { return softened_; }

  /// Ends the drag as one entry of the history; nothing is recorded if nothing moved.
  void commit(Document& document) const;
  /// Ends it with exactly the pose of the press.
  void cancel(Document& document) const;

  Tool tool() const { return tool_; }
  /// Of the cage: those that it moves, and no others.
  std::span<const std::uint32_t> vertices() const { return vertices_; }
  const Grip& grip() const { return grip_; }
  const Constraint& constraint() const { return constraint_; }
  /// What the selection has gone through so far.
  const Transform& transform() const { return transform_; }
  glm::vec2 press() const { return press_; }
  /// The amount as people read it: "X 0.125", "Z 405.0\u00b0", "1.20"; what is being typed ends with an
  /// underscore. What would leave the range of a pose, and so moves nothing, is said to.
  std::string readout() const;

private:
  void constrain(const Constraint& constraint);
  void bend_about(int axis);
  glm::dvec3 direction() const;
  Transform measured(const DragInput& input, const Camera& camera, const Viewport& viewport);
  Transform typed(double value) const;
  glm::dvec3 move_by_mouse(const glm::dvec2& cursor, const Camera& camera, const Viewport& viewport) const;
  double turn_by_mouse(const DragInput& input, const CursorProjection& projection);
  glm::dvec3 scale_by_mouse(const glm::dvec2& cursor, const CursorProjection& projection) const;
  glm::dvec3 factors(double value) const;
  glm::dvec3 snapped_shift(const glm::dvec3& shift) const;
  Transform still() const;
  Transform shaped_by(double amount, bool snap) const;
  double amount_by_way(double pixels, const CursorProjection& projection) const;
  bool said_in_percent() const;
  std::string shaped_amount() const;
  std::string label() const;
  std::string amounts() const;
  std::string axis_names() const;

  DocumentState before_;
  Grip grip_;
  std::vector<std::uint32_t> vertices_;
  Space space_;
  Tool tool_;
  Constraint constraint_;
  glm::dvec3 view_hinge_;         // of a bend in the plane of the view
  std::optional<int> along_way_;  // the axis that was asked for last, if nothing bends about it
  glm::dvec3 pivot_, view_axis_;  // file units; towards the eye at the press
  double depth_;
  glm::dvec2 press_, cursor_, lag_{0, 0};  // lag: what slow movement has held back
  double turned_ = 0, turn_lag_ = 0;       // radians that the cursor has gone round since the press
  glm::dvec3 pulled_{0, 0, 0};             // the move that the mouse alone would make
  NumberEntry entry_;
  Transform transform_;
  bool in_range_ = true;  // of the last update
  int softened_ = 0;
};

}  // namespace viete::scene
