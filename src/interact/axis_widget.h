// The axis widget at the top right of the view. A click on a ball sets a standard view; dragging orbits.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "document/camera.h"

namespace viete::interact {

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
std::optional<AxisWidget> axis_widget(const document::Camera& camera, const document::Viewport& viewport);

/// Animates the camera to the side of the ball or, if the camera is already there, to the opposite side.
void look_from(document::Camera& camera, const AxisBall& ball);

}  // namespace viete::interact
