#include "render/surface_layer.h"

#include <cstring>

#include "base/error.h"
#include "render/upload.h"

namespace viete::render {

namespace {

static_assert(sizeof(SurfaceVertex) == 8 * sizeof(float));

}  // namespace

SurfaceLayer::SurfaceLayer(const Gl& gl)
    : gl_(gl),
      programs_{Program(gl, "surface"), Program(gl, "surface", "#define WIREFRAME\n"),
                Program(gl, "surface", "#define SCALARS\n"),
                Program(gl, "surface", "#define WIREFRAME\n#define SCALARS\n")},
      vertex_array_(gl),
      indices_(gl, GL_R32UI),
      vertices_(gl, GL_RGBA32F),
      looks_(gl, GL_RG32F),
      palette_(gl) {
  const glm::vec3 grey[] = {glm::vec3(0), glm::vec3(1)};
  set_palette(grey);
}

void SurfaceLayer::set_triangles(std::span<const Triangle> triangles, std::size_t vertex_count) {
  require_indices("surface triangles", triangles, vertex_count);
  require_texels(gl_, "surface triangles", 3 * triangles.size());
  require_texels(gl_, "surface vertices", 2 * vertex_count);
  indices_.buffer.upload(triangles.data(), triangles.size_bytes(), GL_STATIC_DRAW);
  triangle_count_ = triangles.size();
  vertex_count_ = vertex_count;
  occlusion_.clear();
  scalars_.clear();
  has_vertices_ = false;
  upload_looks();
}

void SurfaceLayer::set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin) {
  require_count("surface vertices", vertices.size(), vertex_count_);
  if (vertices.empty()) return;
  origin_ = origin;
  std::memcpy(vertices_.buffer.map(vertices.size_bytes()), vertices.data(), vertices.size_bytes());
  vertices_.buffer.unmap();
  has_vertices_ = true;
}

void SurfaceLayer::set_positions(std::span<const Point> positions, std::span<const Point> normals) {
  require_count("surface positions", positions.size(), vertex_count_);
  require_count("surface normals", normals.size(), vertex_count_);
  const Point origin = origin_of(positions);
  std::vector<SurfaceVertex> vertices(positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::vec3 p = relative(positions[i], origin), n = relative(normals[i], {0, 0, 0});
    vertices[i] = {{p.x, p.y, p.z}, 0, {n.x, n.y, n.z}, 0};
  }
  set_vertices(vertices, origin);
}

void SurfaceLayer::set_occlusion(std::span<const float> occlusion) {
  if (!occlusion.empty()) require_count("surface occlusion", occlusion.size(), vertex_count_);
  occlusion_.assign(occlusion.begin(), occlusion.end());
  upload_looks();
}

void SurfaceLayer::set_scalars(std::span<const float> scalars) {
  if (!scalars.empty()) require_count("surface scalars", scalars.size(), vertex_count_);
  scalars_.assign(scalars.begin(), scalars.end());
  upload_looks();
}

void SurfaceLayer::upload_looks() {
  if (vertex_count_ == 0) return;
  auto* looks = static_cast<glm::vec2*>(looks_.buffer.map(vertex_count_ * sizeof(glm::vec2)));
  for (std::size_t i = 0; i < vertex_count_; ++i)
    looks[i] = {occlusion_.empty() ? 1.0F : occlusion_[i], scalars_.empty() ? 0.0F : scalars_[i]};
  looks_.buffer.unmap();
}

void SurfaceLayer::set_palette(std::span<const glm::vec3> colors) {
  if (colors.size() < 2) throw base::Error("palette", "has fewer than 2 colours");
  gl_.ActiveTexture(GL_TEXTURE2);
  gl_.BindTexture(GL_TEXTURE_2D, palette_.id());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, static_cast<GLsizei>(colors.size()), 1, 0, GL_RGB, GL_FLOAT,
                 colors.data());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  palette_size_ = static_cast<float>(colors.size());
}

void SurfaceLayer::draw(const View& view, const Theme& theme, const SurfaceStyle& style) const {
  if (!has_vertices_ || triangle_count_ == 0) return;
  const Program& program = programs_[(style.wireframe > 0 ? 1 : 0) + (style.scalars ? 2 : 0)];
  program.use();
  set_view(program, view);
  set_looks(program, view, theme, style);
  indices_.bind(0);
  vertices_.bind(1);
  looks_.bind(3);
  gl_.ActiveTexture(GL_TEXTURE2);
  gl_.BindTexture(GL_TEXTURE_2D, palette_.id());
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  if (style.closed) gl_.Enable(GL_CULL_FACE);
  gl_.BindVertexArray(vertex_array_.id());
  gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * triangle_count_));
  gl_.Disable(GL_CULL_FACE);
  gl_.Disable(GL_DEPTH_TEST);
  debug_check_gl(gl_, "surface");
}

void SurfaceLayer::set_view(const Program& program, const View& view) const {
  program.set("indices", 0);
  program.set("vertices", 1);
  program.set("palette", 2);
  program.set("looks", 3);
  program.set("eye_from_model", eye_matrix(view, origin_));
  program.set("clip_from_eye", glm::mat4(view.projection));
  program.set("eye_ray", eye_ray(view));
}

void SurfaceLayer::set_looks(const Program& program, const View& view, const Theme& theme,
                             const SurfaceStyle& style) const {
  program.set("model_color", theme.model);
  program.set("exposure", theme.exposure);
  program.set("wire", glm::vec4(theme.wire, style.wireframe));
  program.set("wire_width", style.wire_width * view.scale);
  program.set("occlusion_strength", style.occlusion);
  const float range = style.scalar_high - style.scalar_low;
  program.set("scalar_low", style.scalar_low);
  program.set("scalar_factor", range > 0 ? 1 / range : 0.0F);
  program.set("palette_size", palette_size_);
}

}  // namespace viete::render
