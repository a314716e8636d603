// Computes the axis lines and the rotation arc that are drawn during a drag, in logical pixels.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "interact/transform_drag.h"

namespace viete::interact {

struct DragGuides {
  glm::vec2 start{0, 0};                   ///< the pivot at the start of the drag
  std::vector<int> axes;                   ///< the axes along which the user moves or scales
  std::vector<glm::vec2> axis_directions;  ///< the direction of each axis on screen, of length 1
  /// The arc of a rotation, without whole turns. Empty for other drags and for rings that are seen edge-on.
  std::vector<glm::vec2> arc;
  int whole_turns = 0;
  std::vector<glm::vec2> circle;  ///< the full circle; before the first whole turn, empty
};

DragGuides drag_guides(const TransformDrag& drag, const document::Space& space,
                       const document::Camera& camera, const document::Viewport& viewport);

}  // namespace viete::interact
