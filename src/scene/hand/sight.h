// What of the cage can be seen: how near the model and the cage's own faces stand at each place of the view.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>
#include "scene/document/camera.h"

namespace viete::scene {

/// Depths of what hides, on a raster of two logical pixels. A place as near as the surface there, or up to
/// half a percent of the model's diagonal behind it, is seen: the cage's own vertices are, and those a little
/// inside.
class Sight {
public:
  Sight(const Camera& camera, const Viewport& viewport);

  /// Corners as a Projector gives them. O(pixels covered).
  void hide_behind(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
  /// Likewise, in logical pixels, with its depth.
  bool sees(const glm::vec3& at) const;

private:
  // Grows towards the eye, and is linear on screen.
  float nearness(float depth) const;

  bool orthographic_;
  int columns_, rows_;
  std::vector<float> nearest_;
};

}  // namespace viete::scene
