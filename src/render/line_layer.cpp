#include "render/line_layer.h"

#include "render/upload.h"

namespace viete::render {

LineLayer::LineLayer(const Gl& gl)
    : gl_(gl),
      program_(gl, "line"),
      vertex_array_(gl),
      segments_(gl, GL_RG32UI),
      points_(gl, GL_RGBA32F),
      colors_(gl, GL_RGBA32F) {}

void LineLayer::set_segments(std::span<const Segment> segments, std::size_t point_count) {
  require_indices("line segments", segments, point_count);
  require_texels(gl_, "line ends", 2 * segments.size());
  require_texels(gl_, "line points", point_count);
  segments_.buffer.upload(segments.data(), segments.size_bytes(), GL_STATIC_DRAW);
  segment_count_ = segments.size();
  point_count_ = point_count;
  has_positions_ = false;
  set_color(glm::vec4(1));
}

void LineLayer::set_positions(std::span<const Point> positions) {
  require_count("line positions", positions.size(), point_count_);
  origin_ = origin_of(positions);
  upload_points(points_.buffer, positions, origin_);
  has_positions_ = true;
}

void LineLayer::set_colors(std::span<const glm::vec4> colors) {
  require_count("line colours", colors.size(), segment_count_);
  std::vector<glm::vec4> ends;
  ends.reserve(2 * colors.size());
  for (const glm::vec4& color : colors) ends.insert(ends.end(), 2, color);
  set_end_colors(ends);
}

void LineLayer::set_end_colors(std::span<const glm::vec4> colors) {
  require_count("colours of line ends", colors.size(), 2 * segment_count_);
  colors_.buffer.upload(colors.data(), colors.size_bytes(), GL_DYNAMIC_DRAW);
}

void LineLayer::set_color(const glm::vec4& color) {
  const std::vector<glm::vec4> colors(2 * segment_count_, color);
  set_end_colors(colors);
}

void LineLayer::draw(const View& view, const LineStyle& style) const {
  if (!has_positions_ || segment_count_ == 0) return;
  program_.use();
  program_.set("segments", 0);
  program_.set("points", 1);
  program_.set("colors", 2);
  program_.set("eye_from_model", eye_matrix(view, origin_));
  program_.set("clip_from_eye", glm::mat4(view.projection));
  program_.set("viewport", glm::vec2(view.size));
  segments_.bind(0);
  points_.bind(1);
  colors_.bind(2);
  gl_.BindVertexArray(vertex_array_.id());
  const auto draw_all = [&] { gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * segment_count_)); };
  const auto set_opacity = [&](float opacity) { program_.set("opacity", opacity); };
  constexpr float halo_width = 1.0F;  // logical pixels on each side
  // Before all lines: the halo of one does not cut another in two.
  if (style.halo.a > 0) {
    program_.set("width", (style.width + 2 * halo_width) * view.scale);
    program_.set("halo", style.halo);
    draw_hidden_then_visible(gl_, 0, style.opacity, set_opacity, draw_all);
  }
  program_.set("width", style.width * view.scale);
  program_.set("halo", glm::vec4(0));
  draw_hidden_then_visible(gl_, style.opacity * style.hidden_opacity, style.opacity, set_opacity, draw_all);
  debug_check_gl(gl_, "lines");
}

}  // namespace viete::render
