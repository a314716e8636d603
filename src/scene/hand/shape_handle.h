// The handle of bending, twisting and tapering at the end that goes: where it is on screen, and what a hand
// on it means.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scene/document/camera.h"
#include "scene/document/space.h"
#include "scene/hand/shaping.h"

namespace viete::scene {

/// As it is at one amount. Logical pixels.
struct ShapeHandle {
  std::vector<glm::vec2> way;    ///< from the end that stays to the one that goes, bent where that is bent
  std::vector<glm::vec2> ring;   ///< closed, about the end that goes; of a bend empty
  std::vector<glm::vec2> swept;  ///< of a twist: from where its tick began to where it is
  std::vector<glm::vec2> start;  ///< the way, the tick or the ring (closed) at no amount
  glm::vec2 knob{0, 0};          ///< goes along: the bent end, the end of the tick, a place on the circle

  bool contains(const glm::vec2& cursor) const;
};

/// Nothing of shapes that have no ends, and where an end is behind the camera.
std::optional<ShapeHandle> shape_handle(const Shaping& shaping, double amount, const Space& space,
                                        const Camera& camera, const Viewport& viewport);

/// A hand that has taken the handle.
struct HeldHandle {
  glm::dvec2 press;  ///< logical pixels
  double taken;      ///< the amount at the press
  double amount;     ///< the last one, near which the next one is: turns are counted
};

/// The amount that brings the handle along with the cursor. The shaping has ends, in front of the camera.
double amount_by_handle(const Shaping& shaping, const HeldHandle& held, const glm::dvec2& cursor,
                        const Space& space, const Camera& camera, const Viewport& viewport);

}  // namespace viete::scene
