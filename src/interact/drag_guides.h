// The lines and the swept angle that a drag shows besides its handle, in logical pixels.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "interact/transform_drag.h"

namespace viete::interact {

struct DragGuides {
  glm::vec2 start{0, 0};                   ///< the selection's center at the press
  std::vector<int> axes;                   ///< axes of the drag
  std::vector<glm::vec2> axis_directions;  ///< their directions on screen, of length 1
  /// The arc swept by a rotation, without whole turns, from the press; with `start` it forms a sector. Empty
  /// for other drags and for a rotation seen edge-on.
  std::vector<glm::vec2> arc;
  int whole_turns = 0;
  std::vector<glm::vec2> circle;  ///< the full circle, after a whole turn
};

DragGuides drag_guides(const TransformDrag& drag, const document::Space& space,
                       const document::Camera& camera, const document::Viewport& viewport);

}  // namespace viete::interact
