// Mouse and keyboard input in the view: hovering, selecting, transforming and camera motion.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>

#include "interact/gizmo.h"
#include "interact/picking.h"
#include "workspace/workspace.h"

namespace viete::workspace {

enum MouseButton { left_button = 0, right_button = 1, middle_button = 2 };

/// The input since the last picture. Positions are in logical pixels from the top left of the window.
struct PointerInput {
  glm::vec2 position{-1, -1};
  std::array<bool, 3> down{};
  bool double_click = false;  ///< second press of a double click of the left button
  float wheel = 0;            ///< steps, positive away from the user
  bool shift = false, ctrl = false, alt = false;
  bool over_view = true;  ///< false while a panel is under the pointer or uses the mouse
  bool escape = false, enter = false, backspace = false;  ///< pressed since the last picture
  std::string typed;                                      ///< characters typed since the last picture
};

/// Arms a selection tool: the next left drag draws `shape`, even from a vertex or the gizmo. If this tool is
/// armed already, disarms the tool. The brush stays armed after a drag.
void arm(Workspace& workspace, interact::SelectShape shape);
void disarm(Workspace& workspace);

/// The gizmo; nullopt without a visible selection, for locked probes, and for tools without a gizmo.
std::optional<interact::Gizmo> gizmo_of(const Workspace& workspace);

/// The input for a transform of the selection, which must not be empty.
interact::Grip grip_of(const Workspace& workspace);

/// The axis widget, if it is shown.
std::optional<interact::AxisWidget> axis_widget_of(const Workspace& workspace);

/// The point of the posed model under the cursor, in file coordinates.
std::optional<mesh::Point> model_under(const Workspace& workspace, const glm::vec2& cursor);

/// The pivot for a click, in file coordinates: the cage vertex under the cursor. If there is no vertex, the
/// model's point under the cursor. If there is no point, a point at the depth of the camera's target.
mesh::Point pivot_place(const Workspace& workspace, const glm::vec2& cursor);

/// Caches which elements are visible in the current view.
class SightCache {
public:
  /// Null if the option select_visible is off: then all elements can be selected.
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

/// The pressed button and its gesture. A gesture that began in the view continues over panels until the
/// button is released.
class Pointer {
public:
  static constexpr float drag_threshold = 4;  ///< logical pixels before a press becomes a drag

  /// Call once per drawn picture. An armed tool has priority over these gestures:
  /// - Left click: selects. Shift adds, Ctrl removes. A double click centers the view.
  /// - Left drag from a gizmo handle: transforms. From an element: moves the selection.
  /// - Left drag elsewhere, or with Shift or Ctrl: draws a box. An unselected face or dense vertices count as
  /// elsewhere.
  /// - Left drag with Tool::paint: paints the mask. Ctrl erases. Shift+wheel changes the radius.
  /// - Middle, right or Alt+left drag: orbits. With Shift: pans. With Ctrl: zooms. The wheel zooms too.
  /// - Right click: requests the context menu.
  /// - With Interaction::grab, the selection follows the cursor until a click.
  /// - During a transform, characters set constraint and amount. Ctrl snaps, Shift slows, Enter confirms. Esc
  ///   or the right button cancels.
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
  std::optional<interact::SelectShape> shape_;  // the armed tool at the press
  bool crowded_ = false;
  document::SelectMode mode_ = document::SelectMode::replace;
  bool clicked_ = false, again_ = false;  // the last press was: a click, a double click
  document::Selection selection_before_;
  document::Revision surfaces_ = 0;
  document::Revision cage_ = 0;
  PointerInput last_;
};

}  // namespace viete::workspace
