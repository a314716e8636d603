#include "render/face_layer.h"

#include "render/upload.h"

namespace viete::render {

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
  program_.set("eye_from_model", eye_matrix(view, origin_));
  program_.set("clip_from_eye", glm::mat4(view.projection));
  program_.set("perspective", view.projection[3][3] == 0 ? 1.0F : 0.0F);
  program_.set("color", style.color);
  program_.set("opacity", style.opacity);
  program_.set("rim", style.rim);
  gl_.BindVertexArray(vertex_array_.id());
  const BlendScope blend(gl_);
  if (style.opacity > 0 || style.rim > 0) draw_triangles();
  if (style.occlude) draw_depth();
  debug_check_gl(gl_, "faces");
}

void FaceLayer::draw_triangles() const {
  gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangle_count_), GL_UNSIGNED_INT, nullptr);
}

// Pushed back a little, so that the faces do not hide their own edges.
void FaceLayer::draw_depth() const {
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_.DepthMask(GL_TRUE);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(1, 4);
  draw_triangles();
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace viete::render
