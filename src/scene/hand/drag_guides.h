// What a drag shows besides its handle: the lines it follows and the angle it has swept, in logical pixels.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "scene/hand/transform_drag.h"

namespace viete::scene {

struct DragGuides {
  glm::vec2 start{0, 0};                   ///< where the centre of the selection was at the press
  std::vector<int> axes;                   ///< along which the drag goes
  std::vector<glm::vec2> axis_directions;  ///< theirs on screen, of length 1
  /// The arc that the turn has swept beyond its whole turns, from the press on; with `start` it is a sector.
  /// Empty if it is not a turn, or one that is seen edge-on.
  std::vector<glm::vec2> arc;
  int whole_turns = 0;
  std::vector<glm::vec2> circle;  ///< the line of a whole turn, if there was one
};

DragGuides drag_guides(const TransformDrag& drag, const Space& space, const Camera& camera,
                       const Viewport& viewport);

}  // namespace viete::scene
