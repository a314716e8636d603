// From points of the file to pixels of the window.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "scene/document/camera.h"
#include "scene/document/space.h"

namespace viete::scene {

/// Maps points of the file to logical pixels from the top left of the window.
class Projector {
public:
  Projector(const Space& space, const Camera& camera, const Viewport& viewport);

  /// x, y in logical pixels, z the depth in front of the camera; nothing for points behind it.
  std::optional<glm::vec3> operator()(const mesh::Point& p) const;
  /// The part of the segment that is in front of the near plane, both ends like that; nothing if none is.
  std::optional<std::array<glm::vec3, 2>> segment(const mesh::Point& a, const mesh::Point& b) const;

private:
  glm::vec4 clip(const mesh::Point& p) const;
  glm::vec3 on_screen(const glm::vec4& clip) const;

  Space space_;
  glm::mat4 view_, projection_, to_depth_;
  glm::vec2 window_;
};

}  // namespace viete::scene
