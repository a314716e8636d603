// The axis widget at the top right of the view: a click on a ball sets a standard view, a drag orbits.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "document/camera.h"

namespace viete::interact {

inline constexpr float axes_radius = 46;  ///< radius of the disc that reacts to the mouse, logical pixels

struct AxisBall {
  int axis;  ///< 0 x, 1 y, 2 z
  bool positive;
  glm::vec2 at;    ///< logical pixels
  float nearness;  ///< 1 points at the viewer, -1 away
  float radius;

  document::StandardView view(document::UpAxis up) const;  ///< view from this side
};

struct AxisWidget {
  glm::vec2 center;
  std::array<AxisBall, 6> balls;  ///< far to near

  bool contains(const glm::vec2& cursor) const { return glm::distance(cursor, center) <= axes_radius; }
  /// The nearest ball under the cursor.
  const AxisBall* ball(const glm::vec2& cursor) const;
};

/// Nullopt if the view is too small for it.
std::optional<AxisWidget> axis_widget(const document::Camera& camera, const document::Viewport& viewport);

/// Looks from the side of the ball, animated; if the camera is there already, from the opposite side.
void look_from(document::Camera& camera, const AxisBall& ball);

}  // namespace viete::interact
