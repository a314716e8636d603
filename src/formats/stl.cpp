#include "base/file_bytes.h"
#include "formats/codecs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "base/error.h"
#include "formats/file_vectors.h"
#include "formats/surface_builder.h"
#include "mesh/point_index.h"

namespace viete::formats {

namespace {

constexpr std::size_t head_bytes = 84, triangle_bytes = 50;  // sizes in a binary file

// Returns at most 16 letters, in lower case. All keywords are shorter.
std::string lower_stl_word(std::string_view word) {
  return base::lower_case(word.substr(0, 16));
}

// Returns false if the numbers are so large or so small that the bytes are probably not a triangle.
bool is_plausible(const char* triangle) {
  for (std::size_t i = 0; i < 12; ++i) {
    const double size = std::abs(base::number_of_bytes<float>(triangle + 4 * i));
    if (size != 0 && !(size > 1e-37 && size < (i < 3 ? 1e6 : 1e30))) return false;
  }
  return true;
}

std::size_t announced(std::string_view bytes) {
  return base::number_of_bytes<std::uint32_t>(bytes.data() + 80);
}

bool is_exact_binary(const Source& source) {
  return source.bytes.size() >= head_bytes &&
         source.bytes.size() == head_bytes + triangle_bytes * announced(source.bytes);
}

bool starts_solid(const Source& source) {
  TextCursor text(source, {});
  return text.next_filled_line() && lower_stl_word(text.word()) == "solid";
}

bool holds_nul(const Source& source) {
  return source.bytes.substr(0, 4096).find('\0') != std::string_view::npos;
}

// The offsets of triangles in a binary file. In some files, attribute bytes follow each triangle.
struct Layout {
  std::size_t count = 0, end = 0;
  std::vector<std::size_t> starts = {};  // empty if no attribute bytes follow

  std::size_t offset(std::size_t triangle) const {
    return starts.empty() ? head_bytes + triangle_bytes * triangle : starts[triangle];
  }
};

// If triangles have attribute bytes and the file is long enough, sets the offsets and returns true.
bool follow_attributes(std::string_view bytes, Layout& layout) {
  std::vector<std::size_t> starts;
  std::size_t at = head_bytes;
  for (std::size_t t = 0; t < layout.count; ++t) {
    if (bytes.size() - at < triangle_bytes) return false;
    starts.push_back(at);
    at += triangle_bytes;
    const std::uint16_t more = base::number_of_bytes<std::uint16_t>(bytes.data() + at - 2);
    if (bytes.size() - at < more) return false;
    at += more;
  }
  if (at == layout.end) return false;
  layout.end = at;
  layout.starts = std::move(starts);
  return true;
}

// Returns the layout. If the file size does not match the triangle count, throws base::Error.
Layout layout_of(const Source& source) {
  const auto refuse = [&](const std::string& problem) {
    throw base::Error(source.name, problem, "it seems to be truncated or damaged: export or copy it again");
  };
  const std::string_view bytes = source.bytes;
  if (bytes.size() < head_bytes)
    refuse("a binary STL has at least 84 bytes, this file has " + std::to_string(bytes.size()));
  Layout layout{.count = announced(bytes)};
  const std::size_t room = bytes.size() - head_bytes;
  const std::string header = "the header declares " + std::to_string(layout.count) + " triangles";
  if (layout.count > room / triangle_bytes)
    refuse(header + ", the file has room for " + std::to_string(room / triangle_bytes));
  if (layout.count == 0 && room > 0) refuse(header + ", and " + std::to_string(room) + " bytes follow");
  layout.end = head_bytes + layout.count * triangle_bytes;
  if (layout.end == bytes.size() || follow_attributes(bytes, layout)) return layout;
  for (std::size_t t = 0; t < layout.count; ++t)
    if (!is_plausible(bytes.data() + layout.offset(t)))
      refuse(header + ", which does not match the file size with or without attributes");
  return layout;
}

// Adds corners to the builder. Equal corners become one vertex.
class CornerJoiner {
public:
  explicit CornerJoiner(SurfaceBuilder& builder) : builder_(builder) {}

  void add(mesh::Point p) {
    for (double& x : p) x += 0.0;  // -0 becomes 0
    const std::size_t before = builder_.vertex_count();
    const std::uint32_t vertex = index_.find_or_add(p, builder_.surface().positions);
    if (vertex == before) builder_.position(p);
    builder_.corner(vertex);
  }

private:
  SurfaceBuilder& builder_;
  mesh::PointIndex index_;
};

// Describes the corners and normals of facets. The caller sets the places.
VectorFile vectors_of_facets(bool text) {
  VectorFile file{.format = "STL", .text = text};
  file.vectors.push_back({.rows = FileVectors::Rows::corners, .element = "corner"});
  file.vectors.push_back(
      {.kind = FileVectors::Kind::normals, .rows = FileVectors::Rows::faces, .element = "triangle"});
  file.vectors[1].row_of_corner = [](std::size_t corner) { return static_cast<std::uint32_t>(corner / 3); };
  return file;
}

ReadResult read_binary(const Source& source) {
  const auto layout = std::make_shared<const Layout>(layout_of(source));
  const std::size_t triangles = layout->count;
  SurfaceBuilder builder(source);
  const std::string_view head = source.bytes.substr(0, 80);
  builder.comment(TextWriter::one_line(std::string(head.substr(0, head.find('\0')))));
  CornerJoiner corners(builder);
  bool has_attributes = false;
  for (std::size_t t = 0; t < triangles; ++t) {
    const char* const at = source.bytes.data() + layout->offset(t) + 12;
    for (int c = 0; c < 3; ++c) {
      mesh::Point p{};
      for (int i = 0; i < 3; ++i) p[i] = base::number_of_bytes<float>(at + 12 * c + 4 * i);
      if (!std::isfinite(p[0] + p[1] + p[2]))
        throw base::Error(source.place("triangle", t), "a coordinate is not a finite number",
                          "repair the triangle");
      corners.add(p);
    }
    builder.end_polygon();
    has_attributes |= base::number_of_bytes<std::uint16_t>(at + 36) != 0;
    if (t % 8192 == 0) source.report(static_cast<double>(t) / static_cast<double>(triangles));
  }
  if (!layout->starts.empty()) builder.warn("ignored the attributes of triangles");
  const std::size_t behind = source.bytes.size() - layout->end;
  if (behind > 0)
    builder.warn("ignored " + std::to_string(behind) + " bytes after the " + std::to_string(triangles) +
                 " triangles that the header declares");
  ReadResult result = builder.finish("STL binary");
  VectorFile file = vectors_of_facets(false);
  const std::string_view blanks(" \t\r\n\0", 5);
  if (head.find_first_not_of(blanks) != head.npos) file.beyond_attributes.emplace_back("header");
  if (has_attributes) file.beyond_attributes.emplace_back("attributes of triangles");
  for (FileVectors& vectors : file.vectors) {
    const bool normals = vectors.kind == FileVectors::Kind::normals;
    vectors.types.fill(base::NumberType::float32);
    vectors.count = normals ? triangles : 3 * triangles;
    vectors.places = [layout, normals](std::size_t row) {
      const std::size_t at = normals ? layout->offset(row) : layout->offset(row / 3) + 12 + 12 * (row % 3);
      return FileVectors::Places{at, at + 4, at + 8};
    };
  }
  result.original = original_of(source, std::move(file));
  return result;
}

class StlTextReader {
public:
  explicit StlTextReader(const Source& source)
      : source_(source), text_(source, {}), builder_(source), corners_(builder_) {}

  ReadResult read() {
    while (text_.next_filled_line()) {
      statement(lower_stl_word(text_.word()));
      text_.next_line();
      if (++lines_ % 16384 == 0) source_.report(text_.done());
    }
    if (in_facet_)
      text_.fail("the file ends within a facet", "it seems to be truncated: export or copy it again");
    if (!ended_) builder_.warn("the last line is not endsolid, the file may be truncated");
    ReadResult result = builder_.finish("STL ascii");
    VectorFile file = vectors_of_facets(true);
    file.vectors[0].set_places(std::move(corner_places_));
    file.vectors[1].set_places(std::move(normal_places_));
    if (is_named_) file.beyond_attributes.emplace_back("name of the solid");
    result.original = original_of(source_, std::move(file));
    return result;
  }

private:
  void statement(const std::string& word) {
    if (word == "vertex") {
      TextCursor ahead = text_;
      const double x = text_.coordinate(), y = text_.coordinate(), z = text_.coordinate();
      if (!in_facet_) text_.fail("a vertex is outside of a facet");
      corners_.add({x, y, z});
      if (source_.owner) corner_places_.push_back(places_of_three(ahead));
      ++facet_corners_;
    } else if (word == "facet") {
      if (in_facet_) text_.fail("a facet begins within another facet");
      in_facet_ = true;
      facet_corners_ = 0;
      text_.word();  // skips "normal"
      if (source_.owner) normal_places_.push_back(places_of_three(text_));
    } else if (word == "endfacet") {
      end_facet();
    } else if (word == "solid") {
      const std::string_view name = text_.rest_of_line();
      is_named_ |= !name.empty();
      builder_.comment(name);
    } else if (word == "endsolid") {
      ended_ = true;
    } else if (word != "outer" && word != "endloop") {
      text_.fail(in_quotes(word) + " is not an STL keyword");
    }
    if (word != "endsolid") ended_ = false;
  }

  void end_facet() {
    if (!in_facet_ || facet_corners_ != 3)
      text_.fail("a facet has " + std::to_string(facet_corners_) + " corners instead of 3");
    builder_.end_polygon();
    in_facet_ = false;
  }

  const Source& source_;
  TextCursor text_;
  SurfaceBuilder builder_;
  CornerJoiner corners_;
  std::vector<FileVectors::Places> corner_places_, normal_places_;
  std::size_t lines_ = 0;
  int facet_corners_ = 0;
  bool in_facet_ = false, ended_ = false, is_named_ = false;
};

// Returns true if the file size matches the triangle count, or if the file is longer and has plausible
// triangles, perhaps with attribute bytes between triangles.
bool begins_stl_triangles(std::string_view beginning, std::uint64_t file_size) {
  if (beginning.size() < head_bytes) return false;
  const std::size_t count = announced(beginning);
  const std::uint64_t least = head_bytes + triangle_bytes * count;
  if (count == 0 || least >= file_size) return least == file_size;
  std::size_t at = head_bytes;
  for (std::size_t t = 0; t < count && at + triangle_bytes <= beginning.size(); ++t) {
    if (!is_plausible(beginning.data() + at)) return false;
    at += triangle_bytes;
    at += base::number_of_bytes<std::uint16_t>(beginning.data() + at - 2);
  }
  return true;
}

// Returns the unit normal, or 0 0 0 for a triangle without area.
mesh::Point unit_normal(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c) {
  mesh::Point u = b - a, v = c - a;
  const double scale = std::max(mesh::largest_abs(u), mesh::largest_abs(v));
  if (scale == 0) return {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    u[i] /= scale;
    v[i] /= scale;
  }
  mesh::Point n = mesh::cross(u, v);
  const double size = mesh::stable_norm(n);
  if (size == 0) return {0, 0, 0};
  for (double& x : n) x /= size;
  return n;
}

}  // namespace

ReadResult read_stl(const Source& source) {
  if (!is_exact_binary(source) && starts_solid(source) && !holds_nul(source))
    return StlTextReader(source).read();
  return read_binary(source);
}

bool looks_like_stl(const Source& source) {
  return is_exact_binary(source) || starts_solid(source);
}

bool is_certainly_stl(const Beginning& file) {
  const Source source = file.whole_lines();
  if (!starts_solid(source) || holds_nul(source)) return begins_stl_triangles(file.bytes(), file.file_size());
  TextCursor text(source, {});
  std::string word;
  for (; text.next_filled_line(); text.next_line()) {
    word = lower_stl_word(text.word());
    constexpr std::array words{"solid", "facet", "outer", "vertex", "endloop", "endfacet", "endsolid"};
    if (std::ranges::find(words, word) == words.end()) return false;
  }
  return word != "solid";
}

void write_stl(const Content& content, TextWriter& out) {
  const mesh::Surface& surface = content.surface;
  const auto& positions = content.positions;
  const auto& comments = content.comments;
  std::size_t done = 0;
  out.text("solid ").text(comments.empty() ? "surface" : TextWriter::one_line(comments.front())).text("\n");
  for (const mesh::Triangle& t : surface.triangles) {
    const mesh::Point &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
    out.text(" facet normal ").point(unit_normal(a, b, c)).text("\n  outer loop\n");
    for (const mesh::Point& p : {a, b, c}) {
      out.text("   vertex ");
      print_point(p, out);
      out.text("\n");
    }
    out.text("  endloop\n endfacet\n");
    out.element_done(++done, surface.triangles.size());
  }
  out.text("endsolid\n");
}

}  // namespace viete::formats
