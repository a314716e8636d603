#include "mesh/off.h"

#include <algorithm>

#include "base/error.h"
#include "mesh/surface_builder.h"
#include "mesh/text_cursor.h"

namespace viete::mesh {

namespace {

constexpr TextRules off_rules{.comment = '#'};

// OFF, behind ST (texture), C (colours), N (normals), 4, n (dimension), in this order.
bool is_off_word(std::string_view word) {
  if (word == "off") return true;
  if (!word.ends_with("OFF")) return false;
  word.remove_suffix(3);
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return word.empty();
}

class OffReader {
public:
  explicit OffReader(const Source& source) : source_(source), text_(source, off_rules), builder_(source) {}

  ReadResult read() {
    head();
    const std::size_t vertices = count("vertex count"), faces = count("face count");
    check_room(vertices, faces);
    text_.next_line();
    builder_.surface().positions.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      row("the last vertex", i);
      vertex();
    }
    for (std::size_t i = 0; i < faces; ++i) {
      row("the last face", i);
      face();
    }
    return builder_.finish("OFF");
  }

private:
  void head() {
    while (!text_.at_end() && text_.at_line_end()) comment_line();
    TextCursor ahead = text_;
    const std::string_view word = ahead.word();
    if (is_off_word(word)) {
      if (word.find_first_of("4n") != std::string_view::npos)
        text_.fail("positions of four or n numbers", "export as OFF");
      text_ = ahead;
      if (ahead.word() == "BINARY") text_.fail("binary OFF is not read", "export as text or as PLY");
    }
    while (!text_.at_end() && text_.at_line_end()) comment_line();
    text_.need_word("the counts");
  }

  void comment_line() {
    builder_.comment(text_.rest_of_line());
    text_.next_line();
  }

  std::size_t count(std::string_view what) {
    const std::int64_t value = text_.integer(what);
    if (value < 0)
      text_.fail(std::string(what) + " " + std::to_string(value) + " is negative", "export the model again");
    return static_cast<std::size_t>(value);
  }

  // A vertex takes six bytes at least, a face two.
  void check_room(std::size_t vertices, std::size_t faces) const {
    const std::size_t left = text_.bytes_left() + 1;
    if (vertices <= left / 6 && faces <= (left - 6 * vertices) / 2) return;
    text_.fail(std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                   " faces do not fit into the " + std::to_string(text_.bytes_left()) + " bytes that follow",
               "the file seems to be cut short: export or copy it again");
  }

  void row(std::string_view what, std::size_t index) {
    text_.need_word(what);
    if (index % 8192 == 0) source_.report(text_.done());
  }

  void vertex() {
    const double x = text_.coordinate(), y = text_.coordinate(), z = text_.coordinate();
    builder_.position({x, y, z});
    text_.next_line();
  }

  void face() {
    const std::size_t corners = count("corner count");
    for (std::size_t i = 0; i < corners; ++i) {
      const std::int64_t index = text_.integer("vertex index");
      if (index < 0 || static_cast<std::size_t>(index) >= builder_.vertex_count()) {
        text_.fail("face refers to vertex " + std::to_string(index) + " (from 0), the file has " +
                       std::to_string(builder_.vertex_count()),
                   "export the model again");
      }
      builder_.corner(static_cast<std::uint32_t>(index));
    }
    builder_.end_polygon();
    text_.next_line();
  }

  const Source& source_;
  TextCursor text_;
  SurfaceBuilder builder_;
};

}  // namespace

ReadResult read_off(const Source& source) {
  return OffReader(source).read();
}

bool looks_like_off(const Source& source) {
  TextCursor text(source, off_rules);
  return text.next_filled_line() && is_off_word(text.word());
}

void write_off(const Content& content, TextWriter& out) {
  const Surface& surface = content.surface;
  const auto& positions = content.positions;
  const auto& comments = content.comments;
  const std::size_t all = positions.size() + surface.polygon_count();
  std::size_t done = 0;
  out.text("OFF\n").comments("# ", comments);
  out.number(std::uint64_t{positions.size()}).text(" ");
  out.number(std::uint64_t{surface.polygon_count()}).text(" 0\n");
  for (const Point& p : positions) {
    out.point(p).text("\n");
    out.element_done(++done, all);
  }
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    const std::uint32_t begin = surface.polygon_starts[p], end = surface.polygon_starts[p + 1];
    out.number(std::uint64_t{end - begin});
    for (auto c = begin; c < end; ++c) out.text(" ").number(std::uint64_t{surface.corners[c]});
    out.text("\n");
    out.element_done(++done, all);
  }
}

}  // namespace viete::mesh
