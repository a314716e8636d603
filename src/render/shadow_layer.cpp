#include "render/shadow_layer.h"

#include "render/upload.h"

namespace viete::render {

namespace {

// 1 where one looks down on the ground, 0 from below it; it fades where the ground becomes a line.
float from_above(const View& view, const ShadowStyle& style) {
  const glm::dvec4 center = view.view * glm::dvec4(style.center[0], style.center[1], style.center[2], 1);
  const glm::dvec3 up(glm::normalize(glm::dvec3(view.view[style.up])));
  const bool perspective = view.projection[3][3] == 0;
  const glm::dvec3 to_eye = perspective ? -glm::normalize(glm::dvec3(center)) : glm::dvec3(0, 0, 1);
  return static_cast<float>(glm::smoothstep(0.0, 0.12, glm::dot(to_eye, up)));
}

}  // namespace

ShadowLayer::ShadowLayer(const Gl& gl)
    : gl_(gl), program_(gl, "shadow"), vertex_array_(gl), darkness_(gl), squares_(gl, GL_RG32UI) {}

void ShadowLayer::set_triangles(std::span<const Triangle> triangles, std::span<const Point> positions) {
  require_indices("shadow", triangles, positions.size());
  spread_ = SpreadPoints(triangles, positions);
  vertex_count_ = positions.size();
  set_positions(positions);
}

void ShadowLayer::set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin) {
  require_count("shadow vertices", vertices.size(), vertex_count_);
  points_.clear();
  for (const auto& place : spread_.places()) {
    glm::vec3 p(0);
    for (std::size_t k = 0; k < 3; ++k) {
      const float* corner = vertices[place.corners[k]].position;
      p += place.shares[k] * glm::vec3(corner[0], corner[1], corner[2]);
    }
    if (glm::all(glm::lessThan(glm::abs(p), glm::vec3(1e30F)))) points_.push_back(p);
  }
  origin_ = origin;
  moved_ = true;
}

void ShadowLayer::set_positions(std::span<const Point> positions) {
  require_count("shadow positions", positions.size(), vertex_count_);
  const Point origin = origin_of(positions);
  std::vector<SurfaceVertex> vertices(positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::vec3 p = relative(positions[i], origin);
    vertices[i] = {{p.x, p.y, p.z}, 0, {0, 0, 1}, 0};
  }
  set_vertices(vertices, origin);
}

// In units of the model's size, so that very large and very small ones stay within floats.
void ShadowLayer::cast(const ShadowStyle& style) {
  const int across = (style.up + 1) % 3, along = (style.up + 2) % 3;
  const auto per_size = static_cast<float>(1 / style.size);
  glm::vec3 shift;
  for (int i = 0; i < 3; ++i) shift[i] = static_cast<float>((origin_[i] - style.center[i]) / style.size);
  over_ground_.clear();
  for (const auto& p : points_) {
    const glm::vec3 q = per_size * p + shift;
    over_ground_.emplace_back(q[across], q[along], q[style.up]);
  }
  shadow_ = ground_shadow(over_ground_, 1);
  cast_on_ = style;
  moved_ = false;
  if (shadow_.squares.empty()) return;
  squares_.buffer.upload(shadow_.squares.data(), shadow_.squares.size() * sizeof(shadow_.squares[0]),
                         GL_STREAM_DRAW);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, darkness_.id());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, shadow_.width, shadow_.height, 0, GL_RED, GL_UNSIGNED_BYTE,
                 shadow_.darkness.data());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
}

void ShadowLayer::draw(const View& view, const Theme& theme, const ShadowStyle& style) {
  if (moved_ || !(style == cast_on_)) cast(style);
  if (shadow_.squares.empty()) return;
  const int across = (style.up + 1) % 3, along = (style.up + 2) % 3;
  glm::mat4 axes(0);
  axes[0][across] = axes[1][along] = axes[2][style.up] = static_cast<float>(style.size);
  axes[3][3] = 1;
  const float seen = from_above(view, style);
  if (seen <= 0) return;
  const glm::vec2 extent = shadow_.cell * glm::vec2(shadow_.width, shadow_.height);
  program_.use();
  program_.set("darkness", 0);
  program_.set("squares", 1);
  program_.set("eye_from_ground", eye_matrix(view, style.center) * axes);
  program_.set("clip_from_eye", glm::mat4(view.projection));
  program_.set("place", glm::vec4(shadow_.low, extent));
  program_.set("share", static_cast<float>(GroundShadow::square) / glm::vec2(shadow_.width, shadow_.height));
  program_.set("color", glm::vec4(glm::vec3(theme.shadow), seen * theme.shadow.a));
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, darkness_.id());
  squares_.bind(1);
  const BlendScope blend(gl_);
  gl_.BindVertexArray(vertex_array_.id());
  gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * shadow_.squares.size()));
  debug_check_gl(gl_, "shadow");
}

}  // namespace viete::render
