// Mouse, modifiers and typed characters of one frame turned into hovering, selecting, transforming and camera
// work.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>

#include "scene/hand/axis_widget.h"
#include "scene/hand/gizmo.h"
#include "scene/hand/picking.h"
#include "scene/workspace/sight_keeper.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

enum MouseButton { left_button = 0, right_button = 1, middle_button = 2 };

/// The pointer in one frame. Positions in logical pixels from the top left of the window.
struct PointerInput {
  glm::vec2 position{-1, -1};
  std::array<bool, 3> down{};
  bool double_click = false;  ///< the left button went down for the second time
  float wheel = 0;            ///< steps, positive away from the user
  bool shift = false, ctrl = false, alt = false;
  bool over_view = true;  ///< false while a panel is under the pointer or owns it
  bool escape = false;    ///< Esc went down in this frame
  bool enter = false;     ///< and Enter
  bool backspace = false;
  std::string typed;  ///< characters of this frame
};

/// The next left drag draws this wherever it begins, also on vertices and on the gizmo; what is armed
/// already is put away. The brush stays until it is put away.
void arm(Workspace& workspace, SelectShape shape);
/// Nothing is drawn any more.
void disarm(Workspace& workspace);

/// The gizmo of what is selected, as it is now; nothing while there is none, and while the cage is hidden.
std::optional<Gizmo> gizmo_of(const Workspace& workspace);

/// What moves with the hand now, and how. Requires a selection.
Grip grip_of(const Workspace& workspace);

/// The axis widget, if it is shown.
std::optional<AxisWidget> axis_widget_of(const Workspace& workspace);

/// Keeps what the pointer did from frame to frame: which button was pressed where, and what that began. A
/// gesture that began in the view goes on over panels until its button is released.
class Pointer {
public:
  static constexpr float drag_threshold = 4;  ///< logical pixels before a press becomes a drag

  /// Called once a frame. Left click selects (Shift adds, Ctrl removes); left drag on a handle of the gizmo
  /// uses it, on an element moves the selection, elsewhere draws a box. With Shift or Ctrl it always draws
  /// one, which adds or removes; so it does on an element that is not selected yet where that is a face, or
  /// where elements are so close that there is no place between them. What is armed comes before all that;
  /// middle, right or Alt+left drag orbits, with Shift pans, with Ctrl zooms; wheel zooms to the cursor. A
  /// right click asks for the menu, of what is under the cursor or selected.
  /// With Tool::paint left drag paints on the model, with Ctrl what follows in full, and Shift and wheel
  /// change the brush. A double click brings the place under it to the middle of the view, about which it
  /// turns. What Interaction::grab asks for follows the cursor until a click, or, pressed on the
  /// handle of a shape, the handle does until the button is released. While something is being moved
  /// characters constrain it and set the amount, Ctrl snaps, Shift slows, Enter keeps it, and Esc or the
  /// right button puts everything back as it was.
  void frame(Workspace& workspace, const PointerInput& input);

  /// True while a button is held in a gesture that began in the view.
  bool active() const { return gesture_ != Gesture::none; }

private:
  enum class Gesture {
    none,
    pressed,
    on_axes,
    moving,
    grabbed,
    boxing,
    lassoing,
    brushing,
    painting,
    orbiting,
    panning,
    zooming,
    ignored
  };

  void hover(Workspace& workspace, const PointerInput& input);
  std::optional<Pick> element_under(const Workspace& workspace, const glm::vec2& cursor);
  void turn_wheel(Workspace& workspace, const PointerInput& input);
  void press(Workspace& workspace, const PointerInput& input);
  void press_left(Workspace& workspace, const PointerInput& input);
  void move(Workspace& workspace, const PointerInput& input);
  Gesture camera_gesture(const Workspace& workspace, int button, const PointerInput& input) const;
  void begin_grab(Workspace& workspace, const PointerInput& input);
  void end_grab(Workspace& workspace, const PointerInput& input);
  void begin_left_drag(Workspace& workspace, const PointerInput& input);
  void begin_transform(Workspace& workspace);
  void press_armed(Workspace& workspace, const PointerInput& input);
  void brush_on(Workspace& workspace, const PointerInput& input);
  void select_inside(Workspace& workspace, const PointerInput& input);
  void paint(Workspace& workspace, const PointerInput& input);
  void transform(Workspace& workspace, const PointerInput& input);
  static bool soften_by_wheel(Workspace& workspace, float steps);
  void release(Workspace& workspace, const PointerInput& input);
  void commit_drag(Workspace& workspace);
  void click(Workspace& workspace);
  void ask_for_menu(Workspace& workspace);
  void finish(Workspace& workspace, Gesture next);
  void cancel(Workspace& workspace);
  bool pressed_now(const PointerInput& input, int button) const {
    return input.down[button] && !last_.down[button];
  }
  bool draws_box(const Workspace& workspace) const;

  SightKeeper sight_;
  Gesture gesture_ = Gesture::none;
  int button_ = 0;
  bool travelled_ = false;  // by more than a hand trembles
  glm::vec2 press_{0, 0};
  std::optional<Pick> grabbed_;
  std::optional<Constraint> handle_;
  std::optional<SelectShape> shape_;  // was armed when the button went down
  bool crowded_ = false;
  SelectMode mode_ = SelectMode::replace;
  bool clicked_ = false, again_ = false;  // the last press was a click; this one is the second of two
  Selection selection_before_;
  Revision surfaces_ = 0;
  Revision cage_ = 0;
  PointerInput last_;
};

}  // namespace viete::scene
