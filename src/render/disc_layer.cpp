#include "render/disc_layer.h"

#include <vector>

#include "render/upload.h"

namespace viete::render {

DiscLayer::DiscLayer(const Gl& gl)
    : gl_(gl), program_(gl, "disc"), vertex_array_(gl), points_(gl, GL_RGBA32F), looks_(gl, GL_RGBA32F) {}

void DiscLayer::set_discs(std::span<const Disc> discs) {
  require_texels(gl_, "discs", 2 * discs.size());
  std::vector<glm::vec4> looks;
  looks.reserve(2 * discs.size());
  for (const Disc& disc : discs) {
    looks.push_back(disc.color);
    looks.emplace_back(disc.radius, disc.ring ? 1 : 0, 0, 0);
  }
  looks_.buffer.upload(looks.data(), looks.size() * sizeof(glm::vec4), GL_DYNAMIC_DRAW);
  disc_count_ = discs.size();
}

void DiscLayer::set_positions(std::span<const Point> positions) {
  point_count_ = positions.size();
  origin_ = origin_of(positions);
  upload_points(points_.buffer, positions, origin_);
}

void DiscLayer::draw(const View& view, const DiscStyle& style) const {
  require_count("discs", disc_count_, point_count_);
  if (point_count_ == 0) return;
  program_.use();
  program_.set("points", 0);
  program_.set("looks", 1);
  program_.set("eye_from_model", eye_matrix(view, origin_));
  program_.set("clip_from_eye", glm::mat4(view.projection));
  program_.set("viewport", glm::vec2(view.size));
  program_.set("scale", view.scale);
  program_.set("outline_color", style.outline);
  program_.set("ring_color", style.ring);
  points_.bind(0);
  looks_.bind(1);
  gl_.BindVertexArray(vertex_array_.id());
  draw_hidden_then_visible(
      gl_, style.opacity * style.hidden_opacity, style.opacity,
      [&](float opacity) { program_.set("opacity", opacity); },
      [&] { gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * point_count_)); });
  debug_check_gl(gl_, "discs");
}

}  // namespace viete::render
