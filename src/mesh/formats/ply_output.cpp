// Any surface as a PLY file, with what a file said of it besides.
#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>

#include "mesh/formats/conversion.h"
#include "mesh/formats/ply.h"

namespace viete::mesh {

namespace {

template <class T>
void write_little_endian(TextWriter& out, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  out.text({raw.data(), raw.size()});
}

void write_texture_point(const Vec2& point, TextWriter& out) {
  for (const double x : point) write_little_endian(out, static_cast<float>(x));
}

void write_color(const Color& color, TextWriter& out) {
  for (const float x : color) write_little_endian(out, color_byte(x));
}

void color_header(TextWriter& out) {
  for (const char* name : {"red", "green", "blue", "alpha"})
    out.text("property uchar ").text(name).text("\n");
}

// Positions in double; normals, colours and texture points where there is one a vertex.
class PlyVertexOutput {
public:
  explicit PlyVertexOutput(const Content& content) : positions_(content.positions), a_(content.attributes) {
    if (!a_) return;
    if (!a_->corner_normal.empty()) normals_ = one_a_vertex(content.surface, a_->corner_normal);
    if (!a_->corner_texture.empty()) texture_ = one_a_vertex(content.surface, a_->corner_texture);
    colored_ = !a_->colors.empty();
  }

  void header(TextWriter& out) const {
    out.text("element vertex ").number(std::uint64_t{positions_.size()});
    out.text("\nproperty double x\nproperty double y\nproperty double z\n");
    if (normals_) out.text("property float nx\nproperty float ny\nproperty float nz\n");
    if (colored_) color_header(out);
    if (texture_) out.text("property float s\nproperty float t\n");
  }

  void row(std::size_t v, TextWriter& out) const {
    for (const double x : positions_[v]) write_little_endian(out, x);
    if (normals_) {
      const std::uint32_t n = (*normals_)[v];
      for (const double x : n == none ? Vec3{0, 0, 0} : a_->normals[n])
        write_little_endian(out, static_cast<float>(x));
    }
    if (colored_) write_color(a_->colors[v], out);
    if (texture_) {
      const std::uint32_t t = (*texture_)[v];
      write_texture_point(t == none ? Vec2{0, 0} : a_->texture_points[t], out);
    }
  }

private:
  std::span<const Point> positions_;
  const Attributes* a_;
  std::optional<std::vector<std::uint32_t>> normals_, texture_;
  bool colored_ = false;
};

// Corners; colours, and texture points where vertices have several.
class PlyFaceOutput {
public:
  explicit PlyFaceOutput(const Content& content) : s_(content.surface), a_(content.attributes) {
    if (a_) {
      colored_ = !a_->polygon_colors.empty();
      textured_ = !a_->corner_texture.empty() && !one_a_vertex(s_, a_->corner_texture);
    }
    const std::uint32_t most = textured_ ? 127 : 255;  // whose lists have lengths of one byte
    for (std::size_t p = 0; p < s_.polygon_count(); ++p)
      large_ |= s_.polygon_starts[p + 1] - s_.polygon_starts[p] > most;
  }

  void header(TextWriter& out) const {
    const char* const length = large_ ? "uint" : "uchar";
    out.text("element face ").number(std::uint64_t{s_.polygon_count()});
    out.text("\nproperty list ").text(length).text(" uint vertex_indices\n");
    if (textured_) out.text("property list ").text(length).text(" float texcoord\n");
    if (colored_) color_header(out);
  }

  void row(std::uint32_t p, TextWriter& out) {
    const std::uint32_t begin = s_.polygon_starts[p], end = s_.polygon_starts[p + 1];
    length(end - begin, out);
    for (auto c = begin; c < end; ++c) write_little_endian(out, s_.corners[c]);
    if (textured_) {
      length(2 * (end - begin), out);
      for (auto c = begin; c < end; ++c) {
        const std::uint32_t t = a_->corner_texture[c];
        write_texture_point(t == none ? Vec2{0, 0} : a_->texture_points[t], out);
      }
    }
    if (colored_) write_color(a_->polygon_colors[p], out);
  }

private:
  void length(std::uint32_t n, TextWriter& out) const {
    large_ ? write_little_endian(out, n) : write_little_endian(out, static_cast<std::uint8_t>(n));
  }

  const Surface& s_;
  const Attributes* a_;
  bool colored_ = false, textured_ = false, large_ = false;
};

}  // namespace

void write_ply(const Content& content, TextWriter& out) {
  const PlyVertexOutput vertices(content);
  PlyFaceOutput faces(content);
  out.text("ply\nformat binary_little_endian 1.0\n").comments("comment ", content.comments);
  vertices.header(out);
  faces.header(out);
  out.text("end_header\n");
  const std::size_t polygons = content.surface.polygon_count(), all = content.positions.size() + polygons;
  std::size_t done = 0;
  for (std::size_t v = 0; v < content.positions.size(); ++v) {
    vertices.row(v, out);
    out.element_done(++done, all);
  }
  for (std::uint32_t p = 0; p < polygons; ++p) {
    faces.row(p, out);
    out.element_done(++done, all);
  }
}

}  // namespace viete::mesh
