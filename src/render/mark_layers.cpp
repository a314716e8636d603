#include "render/mark_layers.h"

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
  set_camera(program_, view, origin_);
  program_.set("viewport", glm::vec2(view.size));
  program_.set("scale", view.scale);
  program_.set("outline_color", style.outline);
  program_.set("ring_color", style.ring);
  points_.bind(0);
  looks_.bind(1);
  gl_.BindVertexArray(vertex_array_.id());
  draw_hidden_then_visible(
      gl_, style.hidden_opacity, 1, [&](float opacity) { program_.set("opacity", opacity); },
      [&] { gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * point_count_)); });
  debug_check_gl(gl_, "discs");
}

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
  set_camera(program_, view, origin_);
  program_.set("viewport", glm::vec2(view.size));
  segments_.bind(0);
  points_.bind(1);
  colors_.bind(2);
  gl_.BindVertexArray(vertex_array_.id());
  const auto draw_all = [&] { gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * segment_count_)); };
  const auto set_opacity = [&](float opacity) { program_.set("opacity", opacity); };
  constexpr float halo_width = 1.0F;  // in logical pixels, on each side
  // Draws the halos first, so that they do not cover lines.
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

FaceLayer::FaceLayer(const Gl& gl)
    : gl_(gl), program_(gl, "face"), vertex_array_(gl), indices_(gl), points_(gl) {}

void FaceLayer::set_triangles(std::span<const Triangle> triangles, std::size_t point_count) {
  require_indices("faces", triangles, point_count);
  indices_.upload(triangles.data(), triangles.size_bytes(), GL_STATIC_DRAW);
  triangle_count_ = triangles.size();
  point_count_ = point_count;
  has_positions_ = false;
}

void FaceLayer::set_positions(std::span<const Point> positions) {
  require_count("face positions", positions.size(), point_count_);
  if (positions.empty()) return;
  origin_ = origin_of(positions);
  upload_points(points_, positions, origin_);
  gl_.BindVertexArray(vertex_array_.id());
  gl_.BindBuffer(GL_ARRAY_BUFFER, points_.id());
  gl_.EnableVertexAttribArray(0);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec4), nullptr);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  has_positions_ = true;
}

void FaceLayer::draw(const View& view, const FaceStyle& style) const {
  if (!has_positions_ || triangle_count_ == 0) return;
  program_.use();
  set_camera(program_, view, origin_);
  program_.set("perspective", view.projection[3][3] == 0 ? 1.0F : 0.0F);
  program_.set("color", style.color);
  program_.set("opacity", style.opacity);
  program_.set("rim", style.rim);
  gl_.BindVertexArray(vertex_array_.id());
  const BlendScope blend(gl_);
  const auto draw_triangles = [&] {
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangle_count_), GL_UNSIGNED_INT, nullptr);
  };
  if (style.opacity > 0 || style.rim > 0) draw_triangles();
  if (style.occlude) {  // offsets the depth, so that faces do not hide their own edges
    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl_.DepthMask(GL_TRUE);
    gl_.Enable(GL_POLYGON_OFFSET_FILL);
    gl_.PolygonOffset(1, 4);
    draw_triangles();
    gl_.Disable(GL_POLYGON_OFFSET_FILL);
    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  debug_check_gl(gl_, "faces");
}

}  // namespace viete::render
