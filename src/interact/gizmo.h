// The gizmo at the selection's center: its handles on screen, and hit testing.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document/camera.h"
#include "interact/transform.h"

namespace viete::interact {

/// Sizes in logical pixels, independent of the distance.
inline constexpr float gizmo_radius = 84;      ///< ring radius; also the start of the arrow heads
inline constexpr float gizmo_head = 14;        ///< length of an arrow's head
inline constexpr float gizmo_view_ring = 102;  ///< radius of the ring that rotates about the view direction
inline constexpr float gizmo_center = 9;       ///< radius of the handle in the middle
inline constexpr float gizmo_tolerance = 7;    ///< maximum distance of the cursor to a line
inline constexpr float gizmo_reach = 14;       ///< the same if no small element is under the cursor

/// The shapes to draw and to hit, in logical pixels. Handles that point at the viewer fade out and cannot be
/// hit.
struct Gizmo {
  struct Arm {
    glm::vec2 base, tip, end;  ///< shaft from base to tip, head from tip to end
    float opacity;             ///< 0 to 1
  };
  struct Plane {
    std::array<glm::vec2, 4> corners;
    float opacity;
  };
  struct RingPoint {
    glm::vec2 at;
    bool front;  ///< on the side of the viewer
  };

  Tool tool = Tool::move;
  glm::vec2 center{0, 0};
  std::array<Arm, 3> arms;                      ///< move and scale
  std::array<Plane, 3> planes;                  ///< move and scale; indexed by normal axis
  std::array<std::vector<RingPoint>, 3> rings;  ///< rotate; closed, by axis
  std::array<int, 3> far_to_near{0, 1, 2};      ///< drawing order of the axes
};

/// `center` in view units, axes as columns of length 1. Nullopt for tools without a gizmo, and if the center
/// is behind the camera.
std::optional<Gizmo> make_gizmo(Tool tool, const glm::dvec3& center, const glm::dmat3& axes,
                                const document::Camera& camera, const document::Viewport& viewport);

float distance_to_segment(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b);

/// The handle under the cursor. `reach` uses the larger tolerance and includes the far side of rings; use
/// it if no small element is under the cursor.
std::optional<Constraint> pick_handle(const Gizmo& gizmo, const glm::vec2& cursor, bool reach = false);

/// "Move along X".
std::string handle_name(Tool tool, const Constraint& handle);

}  // namespace viete::interact
