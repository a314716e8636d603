#include "mesh/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/error.h"
#include "mesh/conversion.h"
#include "mesh/ply_attributes.h"
#include "mesh/ply_header.h"
#include "mesh/ply_original.h"
#include "mesh/ply_values.h"
#include "mesh/surface_builder.h"
#include "mesh/text_cursor.h"

namespace viete::mesh {

namespace {

template <class Values>
class PlyBody {
public:
  PlyBody(const PlyHeader& header, const Source& source, SurfaceBuilder& builder, PlyAttributes& attributes,
          Values values)
      : header_(header), source_(source), builder_(builder), attributes_(attributes), values_(values) {
    const PlyElement* vertices = header.find("vertex");
    vertex_count_ = vertices ? vertices->count : 0;
  }

  void read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex" && builder_.vertex_count() == 0) {
        vertices(element);
      } else if (element.name == "face") {
        lists(element, element.find("vertex_indices", "vertex_index"), [this](std::size_t n) { polygon(n); });
      } else if (element.name == "tristrips") {
        lists(element, element.find("vertex_indices", "vertex_index"), [this](std::size_t n) { strips(n); });
      } else {
        rows(element, [this](const PlyProperty& property, std::size_t) { skip(property); });
      }
    }
  }

private:
  template <class Read>
  void rows(const PlyElement& element, Read read) {
    if (element.properties.empty()) return;
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.start_row(element.name, i);
      for (std::size_t p = 0; p < element.properties.size(); ++p) read(element.properties[p], p);
      values_.end_row();
      if (i % 8192 == 0) source_.report(values_.done());
    }
  }

  void vertices(const PlyElement& element) {
    const std::array<std::size_t, 3> axes = {element.find("x"), element.find("y"), element.find("z")};
    for (const std::size_t axis : axes) {
      if (axis == element.properties.size() || element.properties[axis].list_size) {
        throw base::Error(source_.name, "element vertex lacks x, y or z", "export the model again");
      }
    }
    builder_.surface().positions.reserve(element.count);
    PlyAttributes& attributes = attributes_.begin(element);
    Point point{};
    rows(element, [&](const PlyProperty& property, std::size_t p) {
      const auto axis = static_cast<std::size_t>(std::find(axes.begin(), axes.end(), p) - axes.begin());
      if (axis < 3) {
        point[axis] = values_.coordinate(property.type);
      } else if (property.list_size || !attributes.wants(p)) {
        skip(property);
      } else {
        attributes.take(p, values_.value_of(property.type, values_.skip(property.type)));
      }
      if (p + 1 != element.properties.size()) return;
      builder_.position(point);
      attributes.end_row();
    });
  }

  template <class Take>
  void lists(const PlyElement& element, std::size_t wanted, Take take) {
    if (element.count > 0 && (wanted == element.properties.size() || !element.properties[wanted].list_size)) {
      throw base::Error(source_.name, "element " + element.name + " has no list vertex_indices",
                        "export the model again");
    }
    rows(element, [&](const PlyProperty& property, std::size_t p) {
      if (p != wanted) return skip(property);
      const std::size_t length = list_length(property);
      index_type_ = property.type;
      take(length);
    });
  }

  std::size_t list_length(const PlyProperty& property) {
    const std::int64_t length = values_.integer(*property.list_size);
    if (length < 0 || static_cast<std::size_t>(length) > values_.most_values(property.type)) {
      values_.fail("a list announces " + std::to_string(length) + " values, the file has room for " +
                       std::to_string(values_.most_values(property.type)),
                   "the file is damaged or cut short: export or copy it again");
    }
    return static_cast<std::size_t>(length);
  }

  void skip(const PlyProperty& property) {
    const std::size_t count = property.list_size ? list_length(property) : 1;
    for (std::size_t i = 0; i < count; ++i) values_.skip(property.type);
  }

  std::uint32_t checked(std::int64_t index) {
    if (index < 0 || static_cast<std::size_t>(index) >= vertex_count_) {
      values_.fail("face refers to vertex " + std::to_string(index) + " (from 0), the file has " +
                       std::to_string(vertex_count_),
                   "export the model again");
    }
    return static_cast<std::uint32_t>(index);
  }

  void polygon(std::size_t corners) {
    for (std::size_t i = 0; i < corners; ++i) builder_.corner(checked(values_.integer(index_type_)));
    builder_.end_polygon();
  }

  // Strips of triangles, ended by -1; every second triangle runs the other way round. Repeated corners only
  // join strips.
  void strips(std::size_t length) {
    std::uint32_t a = 0, b = 0;
    std::size_t run = 0;
    for (std::size_t i = 0; i < length; ++i) {
      const std::int64_t index = values_.integer(index_type_);
      if (index == -1) {
        run = 0;
        continue;
      }
      const std::uint32_t c = checked(index);
      if (run >= 2 && a != b && b != c && a != c) triangle(run % 2 == 0 ? a : b, run % 2 == 0 ? b : a, c);
      a = b;
      b = c;
      ++run;
    }
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t v : {a, b, c}) builder_.corner(v);
    builder_.end_polygon();
  }

  const PlyHeader& header_;
  const Source& source_;
  SurfaceBuilder& builder_;
  PlyAttributes& attributes_;
  Values values_;
  std::size_t vertex_count_ = 0;
  PlyType index_type_ = PlyType::int32;
};

template <class T>
void write_little_endian(TextWriter& out, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  out.text({raw.data(), raw.size()});
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
    if (colored_) {
      for (const char* name : {"red", "green", "blue", "alpha"})
        out.text("property uchar ").text(name).text("\n");
    }
    if (texture_) out.text("property float s\nproperty float t\n");
  }

  void row(std::size_t v, TextWriter& out) const {
    for (const double x : positions_[v]) write_little_endian(out, x);
    if (normals_) {
      const std::uint32_t n = (*normals_)[v];
      for (const double x : n == none ? Vec3{0, 0, 0} : a_->normals[n])
        write_little_endian(out, static_cast<float>(x));
    }
    if (colored_) {
      for (const float x : a_->colors[v]) write_little_endian(out, color_byte(x));
    }
    if (texture_) {
      const std::uint32_t t = (*texture_)[v];
      for (const double x : t == none ? Vec2{0, 0} : a_->texture_points[t])
        write_little_endian(out, static_cast<float>(x));
    }
  }

private:
  std::span<const Point> positions_;
  const Attributes* a_;
  std::optional<std::vector<std::uint32_t>> normals_, texture_;
  bool colored_ = false;
};

}  // namespace

ReadResult read_ply(const Source& source) {
  if (!looks_like_ply(source))
    throw base::Error(source.name, "does not start with the word ply", "check the extension");
  SurfaceBuilder builder(source);
  TextCursor text(source, {});
  PlyHeader header = read_ply_header(text, source, builder);
  const std::size_t body = text.offset();
  PlyAttributes attributes;
  std::string format = "PLY ascii";
  if (header.format == PlyHeader::Format::ascii) {
    PlyBody(header, source, builder, attributes, PlyTextValues(text)).read();
  } else {
    const bool little = header.format == PlyHeader::Format::little_endian;
    const auto order = little ? std::endian::little : std::endian::big;
    PlyBody(header, source, builder, attributes, PlyBinaryValues(source, body, order)).read();
    format = little ? "PLY binary little-endian" : "PLY binary big-endian";
  }
  ReadResult result = builder.finish(std::move(format));
  result.attributes = attributes.finish(result.surface);
  if (source.owner) {
    result.original =
        std::make_shared<const PlyOriginal>(source.name, source.bytes, source.owner, std::move(header), body);
  }
  return result;
}

bool looks_like_ply(const Source& source) {
  std::string_view bytes = source.bytes;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // as TextCursor does
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
}

void write_ply(const Content& content, TextWriter& out) {
  const Surface& surface = content.surface;
  const PlyVertexOutput vertices(content);
  const std::uint64_t polygons = surface.polygon_count();
  bool large = false;  // a polygon of more than 255 corners
  for (std::size_t p = 0; p < polygons; ++p)
    large |= surface.polygon_starts[p + 1] - surface.polygon_starts[p] > 255;
  out.text("ply\nformat binary_little_endian 1.0\n").comments("comment ", content.comments);
  vertices.header(out);
  out.text("element face ").number(polygons);
  out.text(large ? "\nproperty list uint uint" : "\nproperty list uchar uint")
      .text(" vertex_indices\nend_header\n");
  const std::size_t all = content.positions.size() + polygons;
  std::size_t done = 0;
  for (std::size_t v = 0; v < content.positions.size(); ++v) {
    vertices.row(v, out);
    out.element_done(++done, all);
  }
  for (std::size_t p = 0; p < polygons; ++p) {
    const std::uint32_t begin = surface.polygon_starts[p], end = surface.polygon_starts[p + 1];
    if (large) {
      write_little_endian(out, end - begin);
    } else {
      write_little_endian(out, static_cast<std::uint8_t>(end - begin));
    }
    for (auto c = begin; c < end; ++c) write_little_endian(out, surface.corners[c]);
    out.element_done(++done, all);
  }
}

}  // namespace viete::mesh
