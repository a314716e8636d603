#include "render/surface_layer.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/worker_pool.h"
#include "render/upload.h"

namespace viete::render {

namespace {

// Uploads the image and makes mipmaps. On a GPU, also turns on anisotropic filtering if it is supported.
void upload_image(const Gl& gl, const Texture& texture, const Image& image) {
  constexpr GLenum anisotropy = 0x84FE, most_anisotropy = 0x84FF;  // from an extension; part of OpenGL 4.6
  bind_texture(gl, 4, texture);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                image.rgba.data());
  gl.GenerateMipmap(GL_TEXTURE_2D);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  if (gl.software) return;
  GLint most = 1;
  gl.GetIntegerv(most_anisotropy, &most);
  if (gl.GetError() == GL_NO_ERROR && most > 1)
    gl.TexParameteri(GL_TEXTURE_2D, anisotropy, std::min(most, 8));
}

std::size_t material_kind(Paint paint) {
  switch (paint) {
    case Paint::porcelain: return 4;
    case Paint::jade: return 5;
    case Paint::zebra: return 6;
    default: return 0;
  }
}

}  // namespace

SurfaceLayer::SurfaceLayer(const Gl& gl)
    : gl_(gl),
      vertex_array_(gl),
      indices_(gl, GL_R32UI),
      vertices_(gl, GL_RGBA32UI),
      occlusion_(gl, GL_R16),
      scalars_(gl, GL_R32F),
      texture_points_(gl, GL_RG32F),
      colors_(gl, GL_RGBA8),
      palette_(gl) {
  const glm::vec3 grey[] = {glm::vec3(0), glm::vec3(1)};
  set_palette(grey);
  program_for({});
}

void SurfaceLayer::set_triangles(std::span<const Triangle> triangles, std::size_t vertex_count) {
  require_indices("surface triangles", triangles, vertex_count);
  require_texels(gl_, "surface triangles", 3 * triangles.size());
  indices_.buffer.upload(triangles.data(), triangles.size_bytes(), GL_STATIC_DRAW);
  triangle_count_ = triangles.size();
  vertex_count_ = vertex_count;
  has_vertices_ = false;
  set_looks({});
  set_occlusion({});
  set_scalars({});
}

void SurfaceLayer::set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin) {
  require_count("surface vertices", vertices.size(), vertex_count_);
  if (vertices.empty()) return;
  origin_ = origin;
  auto* mapped = static_cast<SurfaceVertex*>(vertices_.buffer.map(vertices.size_bytes()));
  base::for_blocks(
      vertices.size(),
      [&](std::size_t begin, std::size_t end) {
        std::copy(vertices.begin() + begin, vertices.begin() + end, mapped + begin);
      },
      std::size_t{1} << 18);
  vertices_.buffer.unmap();
  has_vertices_ = true;
  if (triangle_count_ > 0) return;
  box_ = {};
  for (const SurfaceVertex& v : vertices) box_.add({v.position[0], v.position[1], v.position[2]});
}

void SurfaceLayer::set_positions(std::span<const Point> positions,
                                 std::span<const base::PackedNormal> normals) {
  require_count("surface positions", positions.size(), vertex_count_);
  require_count("surface normals", normals.size(), vertex_count_);
  if (positions.empty()) return;
  origin_ = origin_of(positions);
  box_ = {};
  auto* vertices =
      static_cast<SurfaceVertex*>(vertices_.buffer.map(positions.size() * sizeof(SurfaceVertex)));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const glm::vec3 p = relative(positions[i], origin_);
    vertices[i] = {{p.x, p.y, p.z}, normals[i]};
    if (triangle_count_ == 0) box_.add(p);
  }
  vertices_.buffer.unmap();
  has_vertices_ = true;
}

void SurfaceLayer::Box::add(const glm::vec3& point) {
  if (!glm::all(glm::lessThan(glm::abs(point), glm::vec3(1e30F)))) return;
  low = glm::min(low, point);
  high = glm::max(high, point);
}

void SurfaceLayer::set_occlusion(std::span<const float> occlusion) {
  if (!occlusion.empty()) require_count("surface occlusion", occlusion.size(), vertex_count_);
  if (vertex_count_ == 0) return;
  auto* values = static_cast<std::uint16_t*>(occlusion_.buffer.map(vertex_count_ * sizeof(std::uint16_t)));
  for (std::size_t i = 0; i < vertex_count_; ++i)
    values[i] = static_cast<std::uint16_t>(
        occlusion.empty() ? 65535 : 65535 * std::clamp(occlusion[i], 0.0F, 1.0F) + 0.5F);
  occlusion_.buffer.unmap();
}

void SurfaceLayer::set_scalars(std::span<const float> scalars) {
  if (!scalars.empty()) require_count("surface scalars", scalars.size(), vertex_count_);
  scalars_.buffer.upload(scalars.data(), scalars.size_bytes(), GL_STATIC_DRAW);
}

void SurfaceLayer::set_palette(std::span<const glm::vec3> colors) {
  if (colors.size() < 2) throw base::Error("palette", "has fewer than 2 colours");
  set_texture(gl_, 2, palette_, static_cast<int>(colors.size()), 1, {GL_RGB8, GL_RGB, GL_FLOAT},
              colors.data());
  palette_size_ = static_cast<float>(colors.size());
}

void SurfaceLayer::set_looks(const SurfaceLooks& looks) {
  if (!looks.texture_points.empty())
    require_count("surface texture points", looks.texture_points.size(), 3 * triangle_count_);
  if (!looks.colors.empty())
    require_count("surface colours", looks.colors.size(),
                  looks.colors_of_corners ? 3 * triangle_count_ : vertex_count_);
  std::size_t triangles = 0;
  for (const SurfaceRun& run : looks.runs) triangles += run.triangles;
  if (!looks.runs.empty()) require_count("surface runs", triangles, triangle_count_);
  runs_ = looks.runs;
  has_texture_points_ = !looks.texture_points.empty();
  has_colors_ = !looks.colors.empty();
  colors_of_corners_ = looks.colors_of_corners;
  const auto upload = [](Buffer& buffer, const auto& all) {
    if (!all.empty()) buffer.upload(all.data(), all.size() * sizeof(all[0]), GL_STATIC_DRAW);
  };
  upload(texture_points_.buffer, looks.texture_points);
  upload(colors_.buffer, looks.colors);
  images_ = std::make_shared<std::vector<Texture>>();
  for (const Image& image : looks.images) upload_image(gl_, images_->emplace_back(gl_), image);
}

const Program& SurfaceLayer::program_for(const SurfaceStyle& style, bool flat) const {
  static constexpr const char* kinds[] = {"",
                                          "#define SCALARS\n",
                                          "#define LOOKS\n",
                                          "#define LOOKS\n#define FLAT\n",
                                          "#define PORCELAIN\n",
                                          "#define JADE\n",
                                          "#define ZEBRA\n"};
  const bool looks = style.takes_looks();
  const bool colors = looks && has_colors_ && style.paint == Paint::file, wired = style.wireframe > 0;
  const std::size_t kind = style.scalars ? 1 : looks ? (flat ? 3 : 2) : material_kind(style.paint);
  auto& program = programs_[4 * kind + (colors ? 2 : 0) + (wired ? 1 : 0)];
  if (!program) {
    program.emplace(gl_, "surface",
                    std::string(kinds[kind]) + (colors ? "#define COLORS\n" : "") +
                        (wired   ? "#define WIREFRAME\n"
                         : looks ? ""
                                 : "#define INDEXED\n"));
  }
  return *program;
}

void SurfaceLayer::draw(const View& view, const Theme& theme, const SurfaceStyle& style) const {
  if (!has_vertices_) return;
  indices_.bind(0);
  vertices_.bind(1);
  occlusion_.bind(3);
  if (style.scalars) scalars_.bind(7);
  bind_texture(gl_, 2, palette_);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  if (style.closed) gl_.Enable(GL_CULL_FACE);
  gl_.BindVertexArray(vertex_array_.id());
  if (triangle_count_ == 0) {
    draw_points(view, theme, style);
  } else if (!style.takes_looks()) {
    use(program_for(style), view, theme, style);
    const auto corners = static_cast<GLsizei>(3 * triangle_count_);
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.buffer.id());
    if (style.wireframe > 0) {
      gl_.DrawArrays(GL_TRIANGLES, 0, corners);
    } else {
      gl_.DrawElements(GL_TRIANGLES, corners, GL_UNSIGNED_INT, nullptr);
    }
  } else {
    draw_runs(view, theme, style);
  }
  gl_.Disable(GL_CULL_FACE);
  gl_.Disable(GL_DEPTH_TEST);
  debug_check_gl(gl_, "surface");
}

void SurfaceLayer::draw_points(const View& view, const Theme& theme, const SurfaceStyle& style) const {
  static constexpr const char* kinds[] = {"", "#define SCALARS\n", "#define COLORS\n"};
  const bool colors = has_colors_ && !colors_of_corners_ && style.paint == Paint::file;
  const std::size_t kind = style.scalars ? 1 : colors ? 2 : 0;
  auto& program = point_programs_[kind];
  if (!program) program.emplace(gl_, "point", kinds[kind]);
  if (colors) colors_.bind(6);
  use(*program, view, theme, style);
  const double per_unit = 0.5 * view.size.y * view.projection[1][1] * glm::length(glm::dvec3(view.view[1]));
  program->set("spacing", static_cast<float>(style.spacing * per_unit));
  program->set("scale", view.scale);
  const glm::mat4 to_eye = eye_matrix(view, origin_);
  const float distance = -(to_eye * glm::vec4(0.5F * (box_.low + box_.high), 1)).z;
  const float reach = 0.3F * glm::length(glm::mat3(to_eye) * (box_.high - box_.low));
  program->set("depth_range", glm::vec2(distance - reach, distance + reach));
  gl_.Enable(GL_PROGRAM_POINT_SIZE);
  gl_.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(vertex_count_));
  gl_.Disable(GL_PROGRAM_POINT_SIZE);
}

void SurfaceLayer::draw_runs(const View& view, const Theme& theme, const SurfaceStyle& style) const {
  if (has_texture_points_) texture_points_.bind(5);
  if (has_colors_) colors_.bind(6);
  std::size_t first = 0;
  const Program* used = nullptr;
  const auto draw_run = [&](const SurfaceRun& run) {
    const Program& program = program_for(style, run.flat);
    if (std::exchange(used, &program) != &program) use(program, view, theme, style);
    program.set("run_color", run.color);
    program.set("has_image", run.image >= 0 && has_texture_points_ ? 1 : 0);
    bind_texture(gl_, 4, run.image >= 0 ? (*images_)[static_cast<std::size_t>(run.image)] : palette_);
    if (run.image >= 0) {
      const GLint wrap = run.repeats ? GL_REPEAT : GL_CLAMP_TO_EDGE;
      gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
      gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
    }
    gl_.DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * first), static_cast<GLsizei>(3 * run.triangles));
    first += run.triangles;
  };
  if (runs_.empty()) draw_run({.triangles = triangle_count_});
  for (const SurfaceRun& run : runs_) draw_run(run);
}

void SurfaceLayer::use(const Program& program, const View& view, const Theme& theme,
                       const SurfaceStyle& style) const {
  program.use();
  program.set("indices", 0);
  program.set("vertices", 1);
  program.set("palette", 2);
  program.set("occlusion", 3);
  program.set("scalars", 7);
  set_camera(program, view, origin_);
  program.set("eye_ray", eye_ray(view));
  program.set("model_color", theme.model);
  program.set("exposure", theme.exposure);
  program.set("wire", glm::vec4(theme.wire, style.wireframe));
  program.set("wire_width", view.scale);
  program.set("occlusion_strength", style.occlusion);
  const float range = style.scalar_high - style.scalar_low;
  program.set("scalar_low", style.scalar_low);
  program.set("scalar_factor", range > 0 ? 1 / range : 0.0F);
  program.set("palette_size", palette_size_);
  program.set("paint", static_cast<int>(style.paint));
  program.set("image", 4);
  program.set("texture_points", 5);
  program.set("colors", 6);
  program.set("colors_of_corners", colors_of_corners_ ? 1 : 0);
  program.set("has_texture_points", has_texture_points_ ? 1 : 0);
}

}  // namespace viete::render
