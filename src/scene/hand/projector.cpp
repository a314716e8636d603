#include "scene/hand/projector.h"

namespace viete::scene {

Projector::Projector(const Space& space, const Camera& camera, const Viewport& viewport)
    : space_(space),
      view_(camera.view()),
      projection_(camera.projection(viewport)),
      window_(viewport.window) {
  to_depth_ = glm::inverse(projection_);
}

glm::vec4 Projector::clip(const mesh::Point& p) const {
  return projection_ * (view_ * glm::vec4(space_.to_view(p), 1));
}

glm::vec3 Projector::on_screen(const glm::vec4& clip) const {
  const glm::vec2 ndc = glm::vec2(clip) / clip.w;
  return {(0.5f + 0.5f * ndc.x) * window_.x, (0.5f - 0.5f * ndc.y) * window_.y, -(to_depth_ * clip).z};
}

std::optional<glm::vec3> Projector::operator()(const mesh::Point& p) const {
  const glm::vec4 at = clip(p);
  if (!(at.w > 0)) return std::nullopt;
  return on_screen(at);
}

std::optional<std::array<glm::vec3, 2>> Projector::segment(const mesh::Point& a, const mesh::Point& b) const {
  glm::vec4 from = clip(a), to = clip(b);
  const float front_a = from.z + from.w, front_b = to.z + to.w;
  if (!(front_a > 0 || front_b > 0)) return std::nullopt;
  if (front_a < 0) from = glm::mix(from, to, front_a / (front_a - front_b));
  if (front_b < 0) to = glm::mix(to, from, front_b / (front_b - front_a));
  if (!(from.w > 0 && to.w > 0)) return std::nullopt;
  return std::array{on_screen(from), on_screen(to)};
}

}  // namespace viete::scene
