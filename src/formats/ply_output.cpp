#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "formats/codecs.h"
#include "formats/ply_capture.h"

namespace viete::formats {

namespace {

// If any vertex has several texture points, writes texture points for faces, otherwise for vertices.
class PlyOutput {
public:
  PlyOutput(const Content& content, TextWriter& out)
      : s_(content.surface), positions_(content.positions), a_(content.given()), out_(out) {
    if (!a_.corner_normal.empty()) normals_ = one_a_vertex(s_, a_.corner_normal);
    if (!a_.corner_texture.empty()) texture_ = one_a_vertex(s_, a_.corner_texture);
    faces_textured_ = !a_.corner_texture.empty() && !texture_;
    // The length of a list is one byte. Lists of texture points have two numbers for each corner.
    const std::uint32_t most = faces_textured_ ? 127 : 255;
    for (std::size_t p = 0; p < s_.polygon_count(); ++p)
      large_ |= s_.polygon_starts[p + 1] - s_.polygon_starts[p] > most;
    number_images();
  }

  void header() {
    const char* const length = large_ ? "uint" : "uchar";
    for (const std::uint32_t image : images_)
      out_.text("comment TextureFile ").text(a_.images[image].name).text("\n");
    out_.text("element vertex ").number(std::uint64_t{positions_.size()});
    out_.text("\nproperty double x\nproperty double y\nproperty double z\n");
    if (normals_) out_.text("property float nx\nproperty float ny\nproperty float nz\n");
    if (!a_.colors.empty()) color_header();
    if (texture_) out_.text("property float s\nproperty float t\n");
    out_.text("element face ").number(std::uint64_t{s_.polygon_count()});
    out_.text("\nproperty list ").text(length).text(" uint vertex_indices\n");
    if (faces_textured_) out_.text("property list ").text(length).text(" float texcoord\n");
    if (!a_.polygon_colors.empty()) color_header();
    if (!images_.empty()) out_.text("property int texnumber\n");
    out_.text("end_header\n");
  }

  void vertex(std::size_t v) {
    for (const double x : positions_[v]) out_.little_endian(x);
    if (normals_) floats((*normals_)[v] == mesh::none ? mesh::Vec3{0, 0, 0} : a_.normals[(*normals_)[v]]);
    if (!a_.colors.empty()) color(a_.colors[v]);
    if (texture_) texture_point((*texture_)[v]);
  }

  void face(std::uint32_t p) {
    const std::uint32_t begin = s_.polygon_starts[p], end = s_.polygon_starts[p + 1];
    length(end - begin);
    for (auto c = begin; c < end; ++c) out_.little_endian(s_.corners[c]);
    if (faces_textured_) {
      length(2 * (end - begin));
      for (auto c = begin; c < end; ++c) texture_point(a_.corner_texture[c]);
    }
    if (!a_.polygon_colors.empty()) color(a_.polygon_colors[p]);
    while (group_ + 1 < a_.groups.size() && a_.groups[group_ + 1].first_polygon <= p) ++group_;
    if (!images_.empty()) out_.little_endian(numbers_[group_]);
  }

private:
  // Lists the images that are used. MeshLab writes their numbers to `texnumber`, and -1 for no image.
  void number_images() {
    std::map<std::uint32_t, std::size_t> numbers;
    for (const Group& group : a_.groups) {
      const std::uint32_t image =
          group.material == mesh::none ? mesh::none : a_.materials[group.material].base_color_image;
      const auto [at, is_new] = numbers.try_emplace(image, images_.size());
      if (is_new && image != mesh::none) images_.push_back(image);
      numbers_.push_back(image == mesh::none ? -1 : static_cast<std::int32_t>(at->second));
    }
  }

  void color_header() {
    for (const char* name : {"red", "green", "blue", "alpha"})
      out_.text("property uchar ").text(name).text("\n");
  }

  void color(const Color& color) {
    for (const float x : color) out_.little_endian(color_byte(x));
  }

  template <class Vector>
  void floats(const Vector& vector) {
    for (const double x : vector) out_.little_endian(static_cast<float>(x));
  }

  void texture_point(std::uint32_t t) { floats(t == mesh::none ? Vec2{0, 0} : a_.texture_points[t]); }

  void length(std::uint32_t n) {
    large_ ? out_.little_endian(n) : out_.little_endian(static_cast<std::uint8_t>(n));
  }

  const mesh::Surface& s_;
  std::span<const mesh::Point> positions_;
  const Attributes& a_;
  TextWriter& out_;
  std::optional<std::vector<std::uint32_t>> normals_, texture_;
  bool faces_textured_ = false, large_ = false;
  std::vector<std::uint32_t> images_;  // indices into Attributes::images, in the order of the header
  std::vector<std::int32_t> numbers_;  // for each group the number of its image, or -1
  std::size_t group_ = 0;              // of the current face
};

void write_capture(const Content& content, TextWriter& out) {
  const std::size_t count = content.positions.size(), bands = content.splats->bands();
  out.text("element vertex ").number(std::uint64_t{count}).text("\n");
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    out.text("property float ").text(name).text("\n");
  for (const std::string& name : splat_names(bands, bands)) out.text("property float ").text(name).text("\n");
  out.text("end_header\n");
  const auto columns = splat_columns(*content.splats);
  for (std::size_t v = 0; v < count; ++v) {
    for (const double x : content.positions[v]) out.little_endian(static_cast<float>(x));
    for (int normal = 0; normal < 3; ++normal) out.little_endian(0.0F);
    for (const auto& column : columns) out.little_endian(column[v]);
    out.element_done(v + 1, count);
  }
}

}  // namespace

void write_ply(const Content& content, TextWriter& out) {
  out.text("ply\nformat binary_little_endian 1.0\n").comments("comment ", content.comments);
  if (content.splats && content.surface.polygon_count() == 0) return write_capture(content, out);
  PlyOutput output(content, out);
  output.header();
  const std::size_t polygons = content.surface.polygon_count(), all = content.positions.size() + polygons;
  std::size_t done = 0;
  for (std::size_t v = 0; v < content.positions.size(); ++v) {
    output.vertex(v);
    out.element_done(++done, all);
  }
  for (std::uint32_t p = 0; p < polygons; ++p) {
    output.face(p);
    out.element_done(++done, all);
  }
}

}  // namespace viete::formats
