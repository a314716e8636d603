// Converts mouse, modifiers and typed characters of a frame into hovering, selecting, transforming and camera
// motion.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>

#include "interact/axis_widget.h"
#include "interact/gizmo.h"
#include "interact/picking.h"
#include "workspace/workspace.h"

namespace viete::workspace {

enum MouseButton { left_button = 0, right_button = 1, middle_button = 2 };

/// The pointer in one frame. Positions in logical pixels from the top left of the window.
struct PointerInput {
  glm::vec2 position{-1, -1};
  std::array<bool, 3> down{};
  bool double_click = false;  ///< second press of a double click of the left button
  float wheel = 0;            ///< steps, positive away from the user
  bool shift = false, ctrl = false, alt = false;
  bool over_view = true;  ///< false while a panel is under the pointer or has captured it
  bool escape = false;    ///< Esc was pressed in this frame
  bool enter = false;     ///< Enter was pressed in this frame
  bool backspace = false;
  std::string typed;  ///< characters typed in this frame
};

/// Arms a selection tool: the next left drag draws its shape, even on vertices and the gizmo. Arming the same
/// shape again disarms it. The brush stays armed after a drag.
void arm(Workspace& workspace, interact::SelectShape shape);
/// Ends the armed tool.
void disarm(Workspace& workspace);

/// The current gizmo of the selection; nullopt if there is no gizmo or the cage is hidden.
std::optional<interact::Gizmo> gizmo_of(const Workspace& workspace);

/// The current grip. Requires a selection.
interact::Grip grip_of(const Workspace& workspace);

/// The axis widget, if it is shown.
std::optional<interact::AxisWidget> axis_widget_of(const Workspace& workspace);

/// The position of a pivot placed by a click: the posed cage's vertex under the cursor, else the point on
/// the model, else at the depth of the camera's target; in file coordinates.
mesh::Point pivot_place(const Workspace& workspace, const glm::vec2& cursor);

/// Caches the Sight of the current view.
class SightCache {
public:
  /// Null if hidden elements can be selected too.
  const interact::Sight* of(const Workspace& workspace);

private:
  struct Picture {
    document::CameraPose camera;
    document::Viewport viewport;
    document::Revisions revisions;
    unsigned long frame;
    const void* vertices;
    bool model;
    std::vector<std::uint32_t> hidden;

    friend bool operator==(const Picture&, const Picture&) = default;
  };
  std::optional<Picture> picture_;
  std::optional<interact::Sight> sight_;
};

/// The state of the pointer between frames: the pressed button and its gesture. A gesture that began in the
/// view continues over panels until the button is released.
class Pointer {
public:
  static constexpr float drag_threshold = 4;  ///< logical pixels before a press becomes a drag

  /// Call once per frame. Left click selects (Shift adds, Ctrl removes). Left drag on a gizmo handle
  /// transforms, on an element moves the selection, elsewhere draws a box. It also draws a box on unselected
  /// faces, on unselected elements too dense to click between, and with Shift (adds) or Ctrl (removes). An
  /// armed tool has priority. Middle, right or Alt+left drag orbits, with Shift pans, with Ctrl zooms; the
  /// wheel zooms to the cursor. Right click requests the context menu. With Tool::paint left drag paints the
  /// mask, with Ctrl the full share; Shift and wheel change the radius. A double click centers the view on
  /// the point under it. Interaction::grab makes the selection follow the cursor until a click, or, if begun
  /// on a shape's handle, until the button is released. During a transform characters set constraint and
  /// amount, Ctrl snaps, Shift slows down, Enter confirms, and Esc or the right button cancels.
  void frame(Workspace& workspace, const PointerInput& input);

  /// True during a gesture that began in the view.
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
  std::optional<interact::Pick> element_under(const Workspace& workspace, const glm::vec2& cursor);
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

  SightCache sight_;
  Gesture gesture_ = Gesture::none;
  int button_ = 0;
  bool travelled_ = false;  // moved farther than drag_threshold
  glm::vec2 press_{0, 0};
  std::optional<interact::Pick> grabbed_;
  std::optional<interact::Constraint> handle_;
  std::optional<interact::SelectShape> shape_;  // armed at the press
  bool crowded_ = false;
  document::SelectMode mode_ = document::SelectMode::replace;
  bool clicked_ = false, again_ = false;  // the last press was a click; this one makes it a double click
  document::Selection selection_before_;
  document::Revision surfaces_ = 0;
  document::Revision cage_ = 0;
  PointerInput last_;
};

}  // namespace viete::workspace
