// Writes PLY: any surface, and a file that was read as it was.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "base/error.h"
#include "mesh/formats/conversion.h"
#include "mesh/formats/ply.h"
#include "mesh/formats/printed.h"
#include "mesh/formats/rewriter.h"
#include "mesh/normals.h"

namespace viete::mesh {

namespace {

// Positions in double; vertex normals, colours, and texture points of vertices or, if these have several, of
// faces.
class PlyOutput {
public:
  PlyOutput(const Content& content, TextWriter& out)
      : s_(content.surface), positions_(content.positions), a_(content.given()), out_(out) {
    if (!a_.corner_normal.empty()) normals_ = one_a_vertex(s_, a_.corner_normal);
    if (!a_.corner_texture.empty()) texture_ = one_a_vertex(s_, a_.corner_texture);
    faces_textured_ = !a_.corner_texture.empty() && !texture_;
    const std::uint32_t most = faces_textured_ ? 127 : 255;  // for list lengths of one byte
    for (std::size_t p = 0; p < s_.polygon_count(); ++p)
      large_ |= s_.polygon_starts[p + 1] - s_.polygon_starts[p] > most;
  }

  void header() {
    const char* const length = large_ ? "uint" : "uchar";
    out_.text("element vertex ").number(std::uint64_t{positions_.size()});
    out_.text("\nproperty double x\nproperty double y\nproperty double z\n");
    if (normals_) out_.text("property float nx\nproperty float ny\nproperty float nz\n");
    if (!a_.colors.empty()) color_header();
    if (texture_) out_.text("property float s\nproperty float t\n");
    out_.text("element face ").number(std::uint64_t{s_.polygon_count()});
    out_.text("\nproperty list ").text(length).text(" uint vertex_indices\n");
    if (faces_textured_) out_.text("property list ").text(length).text(" float texcoord\n");
    if (!a_.polygon_colors.empty()) color_header();
    out_.text("end_header\n");
  }

  void vertex(std::size_t v) {
    for (const double x : positions_[v]) out_.little_endian(x);
    if (normals_) floats((*normals_)[v] == none ? Vec3{0, 0, 0} : a_.normals[(*normals_)[v]]);
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
  }

private:
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

  void texture_point(std::uint32_t t) { floats(t == none ? Vec2{0, 0} : a_.texture_points[t]); }

  void length(std::uint32_t n) {
    large_ ? out_.little_endian(n) : out_.little_endian(static_cast<std::uint8_t>(n));
  }

  const Surface& s_;
  std::span<const Point> positions_;
  const Attributes& a_;
  TextWriter& out_;
  std::optional<std::vector<std::uint32_t>> normals_, texture_;
  bool faces_textured_ = false, large_ = false;
};

// Three properties of an element that form a vector: original and new values.
struct PlyVectors {
  std::array<std::size_t, 3> at;  // property indices
  std::vector<Vec3> before, now;  // one per row
  Printed printed;

  // 0, 1 or 2; 3 for other properties.
  std::size_t axis(std::size_t property) const {
    return static_cast<std::size_t>(std::find(at.begin(), at.end(), property) - at.begin());
  }
};

std::optional<PlyVectors> vectors_named(const PlyElement& element, const char* x, const char* y,
                                        const char* z, Digits digits) {
  PlyVectors vectors{{element.find(x), element.find(y), element.find(z)}, {}, {}, Printed(digits)};
  for (const std::size_t p : vectors.at) {
    if (p == element.properties.size() || element.properties[p].list_size) return std::nullopt;
  }
  return vectors;
}

// A value in the file's format; empty if out of the type's range.
std::optional<std::string_view> ply_form(PlyHeader::Format format, PlyType type, double value,
                                         const Printed& printed, std::span<char> room) {
  return with_type(type, [&](auto number) -> std::optional<std::string_view> {
    using Number = decltype(number);
    constexpr bool whole = std::is_integral_v<Number>;
    if (whole) {
      value = std::round(value);
      const double beyond = std::ldexp(1.0, std::numeric_limits<Number>::digits);
      if (!(value >= double(std::numeric_limits<Number>::lowest()) && value < beyond)) return std::nullopt;
    }
    number = static_cast<Number>(value);
    if (!std::isfinite(static_cast<double>(number))) return std::nullopt;
    if (format == PlyHeader::Format::ascii) {
      if (!whole) return printed.print(value, room);
      const char* const end = std::to_chars(room.data(), room.data() + room.size(), number).ptr;
      return std::string_view(room.data(), static_cast<std::size_t>(end - room.data()));
    }
    const bool little = format == PlyHeader::Format::little_endian;
    std::ranges::copy(bytes_of_number(number, little ? std::endian::little : std::endian::big), room.begin());
    return std::string_view(room.data(), sizeof number);
  });
}

// A face element with normals, and the polygon of each row (or none).
struct PlyFaceNormals {
  const PlyElement* element;
  PlyVectors vectors;
  std::vector<std::uint32_t> polygon_of_row;
};

// Walks the body twice: to read the dependent vectors, and to write it.
template <class Values>
class PlyRewriter {
public:
  PlyRewriter(const PlyHeader& header, const Source& source, Values values, const Surface& rest,
              std::span<const Point> positions, TextWriter& out)
      : header_(header),
        source_(source),
        start_(values),
        values_(values),
        rest_(rest),
        positions_(positions),
        out_(out) {}

  void run() {
    find_elements();
    if (ascii() || vertex_vectors_.size() > 1 || !face_normals_.empty()) learn();
    follow();
    Rewriter rewriter(source_.bytes, out_);
    values_ = start_;
    walk([&](const PlyElement& element, std::size_t row, std::size_t p, std::string_view place) {
      for (PlyVectors* vectors : vectors_of(element)) replace(element, *vectors, row, p, place, rewriter);
    });
    rewriter.finish();
  }

private:
  bool ascii() const { return header_.format == PlyHeader::Format::ascii; }

  void find_elements() {
    const Digits digits = out_.digits();
    bool behind_strips = false;  // the number of polygons made by strips is not known here
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex" && !vertices_ && element.count > 0) {
        vertices_ = &element;
        for (const auto& [x, y, z] : {std::array{"x", "y", "z"}, {"nx", "ny", "nz"}, {"tx", "ty", "tz"}}) {
          if (auto found = vectors_named(element, x, y, z, digits)) {
            is_tangent_.push_back(x[0] == 't');
            vertex_vectors_.push_back(std::move(*found));
          }
        }
      } else if (element.name == "face" && !behind_strips) {
        auto vectors = vectors_named(element, "nx", "ny", "nz", digits);
        if (vectors) face_normals_.push_back({&element, std::move(*vectors), {}});
      }
      behind_strips |= element.name == "tristrips";
    }
    vertex_vectors_.front().before = rest_.positions;
    vertex_vectors_.front().printed.keep(6, bounds(rest_.positions).diagonal());
  }

  std::vector<PlyVectors*> vectors_of(const PlyElement& element) {
    std::vector<PlyVectors*> all;
    if (&element == vertices_) {
      for (PlyVectors& v : vertex_vectors_) all.push_back(&v);
    }
    for (PlyFaceNormals& faces : face_normals_) {
      if (&element == faces.element) all.push_back(&faces.vectors);
    }
    return all;
  }

  // Calls use(element, row, property, place) for the scalar values that may change.
  template <class Use>
  void walk(const Use& use) {
    const PlyElement* const last = face_normals_.empty() ? vertices_ : face_normals_.back().element;
    const PlyElement* behind = header_.elements.data();
    while (behind <= vertices_ || behind <= last) ++behind;
    for (const PlyElement* element = header_.elements.data(); element != behind; ++element) {
      if (element->properties.empty()) continue;
      for (std::size_t row = 0; row < element->count; ++row) {
        values_.start_row(element->name, row);
        for (std::size_t p = 0; p < element->properties.size(); ++p) {
          const PlyProperty& property = element->properties[p];
          if (property.list_size) {
            skip_list(*element, p);
          } else {
            use(*element, row, p, values_.skip(property.type));
          }
        }
        values_.end_row();
      }
    }
  }

  void skip_list(const PlyElement& element, std::size_t p) {
    const PlyProperty& property = element.properties[p];
    const std::int64_t length = values_.integer(*property.list_size);
    for (std::int64_t i = 0; i < length; ++i) values_.skip(property.type);
    if (element.name != "face" || p != element.find("vertex_indices", "vertex_index")) return;
    const std::uint32_t polygon = length >= 3 ? polygons_++ : none;
    for (PlyFaceNormals& faces : face_normals_) {
      if (&element == faces.element) faces.polygon_of_row.push_back(polygon);
    }
  }

  void learn() {
    walk([&](const PlyElement& element, std::size_t row, std::size_t p, std::string_view place) {
      for (PlyVectors* vectors : vectors_of(element)) {
        const std::size_t axis = vectors->axis(p);
        if (axis == 3) continue;
        constexpr std::size_t enough = 10'000;
        if (ascii() && row < enough) vectors->printed.learn(place);
        if (vectors == &vertex_vectors_.front()) continue;
        vectors->before.resize(element.count);
        vectors->before[row][axis] = values_.value_of(element.properties[p].type, place);
      }
    });
  }

  void follow() {
    vertex_vectors_.front().now.assign(positions_.begin(), positions_.end());
    const std::vector<std::uint32_t> own = every_vertex(rest_);
    for (std::size_t i = 1; i < vertex_vectors_.size(); ++i) {
      PlyVectors& vectors = vertex_vectors_[i];
      vectors.printed.keep(5, 1);
      const auto follow_surface = is_tangent_[i] ? deformed_tangents : deformed_normals;
      vectors.now = follow_surface(rest_, positions_, vectors.before, rest_.corners, own);
      keep_lengths(vectors.before, vectors.now);
    }
    for (PlyFaceNormals& faces : face_normals_) follow(faces);
  }

  void follow(PlyFaceNormals& faces) {
    PlyVectors& vectors = faces.vectors;
    vectors.printed.keep(5, 1);
    std::vector<std::uint32_t> row_of_corner(rest_.corners.size(), none);
    for (std::uint32_t row = 0; row < faces.polygon_of_row.size(); ++row) {
      const std::uint32_t p = faces.polygon_of_row[row];
      if (p == none) continue;
      for (auto c = rest_.polygon_starts[p]; c < rest_.polygon_starts[p + 1]; ++c) row_of_corner[c] = row;
    }
    vectors.before.resize(faces.element->count);
    vectors.now = deformed_normals(rest_, positions_, vectors.before, row_of_corner);
    keep_lengths(vectors.before, vectors.now);
  }

  void replace(const PlyElement& element, const PlyVectors& vectors, std::size_t row, std::size_t p,
               std::string_view place, Rewriter& rewriter) {
    const std::size_t axis = vectors.axis(p);
    if (axis == 3) return;
    const double before = vectors.before[row][axis], now = vectors.now[row][axis];
    if (before == now || !changed(vectors.before[row], vectors.now[row])) return;
    const PlyType type = element.properties[p].type;
    std::array<char, 400> room_before, room;
    const auto words = ply_form(header_.format, type, now, vectors.printed, room);
    if (!words) {
      throw base::Error(source_.place(element.name, row), "a position does not fit into the file's type",
                        "write another format, or scale the model");
    }
    if (ply_form(header_.format, type, before, vectors.printed, room_before) != words)
      rewriter.replace(place, *words);
  }

  const PlyHeader& header_;
  const Source& source_;
  Values start_, values_;
  const Surface& rest_;
  std::span<const Point> positions_;
  TextWriter& out_;
  const PlyElement* vertices_ = nullptr;
  std::vector<PlyVectors> vertex_vectors_;  // positions, then normals and tangents
  std::vector<char> is_tangent_;
  std::vector<PlyFaceNormals> face_normals_;
  std::uint32_t polygons_ = 0;
};

class PlyOriginal final : public Original {
public:
  PlyOriginal(const Source& source, PlyHeader header, std::size_t body, Companions companions)
      : Original("PLY", source),
        header_(std::move(header)),
        body_(body),
        companions_(std::move(companions)) {}

  std::vector<std::string> beyond_attributes() const override {
    constexpr std::string_view of_vertices =
        " x y z nx ny nz red green blue alpha diffuse_red diffuse_green diffuse_blue s t u v texture_u "
        "texture_v texture_s texture_t ";
    constexpr std::string_view of_faces =
        " vertex_indices vertex_index red green blue alpha texcoord texnumber ";
    std::vector<std::string> found;
    for (const PlyElement& element : header_.elements) {
      if (element.count == 0) continue;
      const bool vertices = element.name == "vertex";
      if (!vertices && element.name != "face" && element.name != "tristrips") {
        found.push_back("element " + element.name);
        continue;
      }
      for (const PlyProperty& p : element.properties) {
        if ((vertices ? of_vertices : of_faces).find(" " + p.name + " ") == std::string_view::npos)
          found.push_back("property " + p.name + " of " + element.name);
      }
    }
    return found;
  }

  Companions companions() const override { return companions_; }

  std::vector<std::string> write(const Surface& rest, std::span<const Point> positions,
                                 TextWriter& out) const override {
    const Source source = this->source();
    if (header_.format == PlyHeader::Format::ascii) {
      const Source body{name_, "ply", bytes_.substr(body_)};
      PlyRewriter(header_, source, PlyTextValues({body, {}}), rest, positions, out).run();
    } else {
      const bool little = header_.format == PlyHeader::Format::little_endian;
      const PlyBinaryValues values(source, body_, little ? std::endian::little : std::endian::big);
      PlyRewriter(header_, source, values, rest, positions, out).run();
    }
    return {};
  }

private:
  PlyHeader header_;
  std::size_t body_;
  Companions companions_;
};

}  // namespace

void write_ply(const Content& content, TextWriter& out) {
  out.text("ply\nformat binary_little_endian 1.0\n").comments("comment ", content.comments);
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

std::shared_ptr<const Original> ply_original(const Source& source, PlyHeader header, std::size_t body,
                                             Companions companions) {
  return std::make_shared<const PlyOriginal>(source, std::move(header), body, std::move(companions));
}

}  // namespace viete::mesh
