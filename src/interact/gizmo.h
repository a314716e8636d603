// The gizmo at the selection's pivot, and the axis widget: handles on screen, and hit testing. A click on a
// ball of the axis widget sets a standard view; dragging orbits.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document/camera.h"
#include "interact/transform.h"

namespace viete::interact {

/// The sizes of the gizmo, in logical pixels.
inline constexpr float gizmo_radius = 84;  ///< the radius of the rings; also the distance of the arrow heads
inline constexpr float gizmo_head = 14;    ///< the length of an arrow head
inline constexpr float gizmo_view_ring = 102;  ///< the radius of the ring that rotates in the view plane
inline constexpr float gizmo_center = 9;       ///< the radius of the handle in the middle
inline constexpr float gizmo_tolerance = 7;    ///< the largest distance from the cursor to a handle
inline constexpr float gizmo_reach = 14;       ///< the tolerance if no vertex or probe is under the cursor

/// The handles, in logical pixels. If an arm is seen end-on, or a plane is seen edge-on, it is transparent
/// and cannot be hit.
struct Gizmo {
  struct Arm {
    glm::vec2 base, tip, end;  ///< the shaft is from base to tip, the head from tip to end
    float opacity;             ///< 0 to 1
  };
  struct Plane {
    std::array<glm::vec2, 4> corners;
    float opacity;
  };
  struct RingPoint {
    glm::vec2 at;
    bool front;  ///< true on the near side of the ring
  };

  Tool tool = Tool::move;
  glm::vec2 center{0, 0};
  std::array<Arm, 3> arms;                      ///< used by Move and Scale
  std::array<Plane, 3> planes;                  ///< used by Move and Scale; indexed by the normal's axis
  std::array<std::vector<RingPoint>, 3> rings;  ///< used by Rotate; closed polylines
  std::array<int, 3> far_to_near{0, 1, 2};      ///< the order in which to draw the axes
};

/// Makes the gizmo. `center` is in view units; the columns of `axes` have length 1. If the tool has no gizmo
/// or the center is behind the camera, returns nullopt.
std::optional<Gizmo> make_gizmo(Tool tool, const glm::dvec3& center, const glm::dmat3& axes,
                                const document::Camera& camera);

float distance_to_segment(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b);

/// Returns the handle under the cursor. If `reach` is true, uses the tolerance gizmo_reach, and also hits the
/// far sides of rings. Set `reach` if no vertex or probe is under the cursor.
std::optional<Constraint> pick_handle(const Gizmo& gizmo, const glm::vec2& cursor, bool reach = false);

std::string handle_name(Tool tool, const Constraint& handle);

inline constexpr float axes_radius = 46;  ///< the radius of the widget, in logical pixels

struct AxisBall {
  int axis;  ///< 0 x, 1 y, 2 z
  bool positive;
  glm::vec2 at;    ///< in logical pixels
  float nearness;  ///< from -1 (points away from the viewer) to 1 (points at the viewer)
  float radius;

  document::StandardView view(document::UpAxis up) const;
};

struct AxisWidget {
  glm::vec2 center;
  std::array<AxisBall, 6> balls;  ///< sorted from far to near

  bool contains(const glm::vec2& cursor) const { return glm::distance(cursor, center) <= axes_radius; }
  /// Returns the front ball under the cursor. If there is no ball under the cursor, returns null.
  const AxisBall* ball(const glm::vec2& cursor) const;
};

/// Returns the widget. If the view is too small for the widget, returns nullopt.
std::optional<AxisWidget> axis_widget(const document::Camera& camera);

/// Animates the camera to the side of the ball or, if the camera is already there, to the opposite side.
void look_from(document::Camera& camera, const AxisBall& ball);

}  // namespace viete::interact
