#include "formats/codecs.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "base/text.h"
#include "formats/file_vectors.h"
#include "formats/surface_builder.h"

namespace viete::formats {

namespace {

constexpr TextRules off_rules{.comment = '#'};

// The kinds of values after the position of each vertex.
struct OffForm {
  bool normals = false, colors = false, texture = false;
  bool more_axes = false;     // true for 4OFF and nOFF
  bool colors_first = false;  // true if four colour components come before the normal, as in MeshLab's files

  std::size_t numbers() const { return (normals ? 3U : 0U) + (colors ? 4U : 0U) + (texture ? 2U : 0U); }
};

// Parses the keyword OFF with prefixes: ST (texture), C (colours), N (normals), 4 or n (dimension).
std::optional<OffForm> off_form(std::string_view word) {
  OffForm form;
  if (word == "off") return form;
  if (!word.ends_with("OFF")) return std::nullopt;
  word.remove_suffix(3);
  const std::pair<std::string_view, bool OffForm::*> prefixes[] = {{"ST", &OffForm::texture},
                                                                   {"C", &OffForm::colors},
                                                                   {"N", &OffForm::normals},
                                                                   {"4", &OffForm::more_axes},
                                                                   {"n", &OffForm::more_axes}};
  while (!word.empty()) {
    const auto prefix =
        std::ranges::find_if(prefixes, [&](const auto& p) { return word.starts_with(p.first); });
    if (prefix == std::end(prefixes)) return std::nullopt;
    form.*prefix->second = true;
    word.remove_prefix(prefix->first.size());
  }
  return form;
}

class OffReader {
public:
  explicit OffReader(const Source& source) : source_(source), text_(source, off_rules), builder_(source) {}

  ReadResult read() {
    head();
    const std::size_t vertices = count("number of vertices"), faces = count("number of faces");
    check_room(vertices, faces);
    text_.next_line();
    if (form_.normals && form_.colors) form_.colors_first = colors_come_first(vertices);
    builder_.surface().positions.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      row("the last vertex", i);
      vertex();
    }
    for (std::size_t i = 0; i < faces; ++i) {
      row("the last face", i);
      face();
    }
    finish_attributes();
    ReadResult result = builder_.finish("OFF", std::move(found_));
    VectorFile file{.format = "OFF", .vectors = {{.element = "vertex"}}};
    file.vectors[0].set_places(std::move(positions_));
    if (form_.normals) {
      file.vectors.push_back({.kind = FileVectors::Kind::normals, .element = "vertex"});
      file.vectors[1].set_places(std::move(normals_));
    }
    if (has_comments(source_.bytes)) file.beyond_attributes.emplace_back("comments");
    result.original = original_of(source_, std::move(file));
    return result;
  }

private:
  void head() {
    builder_.comments(text_);
    TextCursor ahead = text_;
    const std::string_view word = ahead.word();
    if (const auto form = off_form(word)) {
      if (form->more_axes)
        text_.fail(in_quotes(word) + " is not supported: positions must have three coordinates",
                   "export as OFF");
      text_ = ahead;
      form_ = *form;
      if (ahead.word() == "BINARY") text_.fail("binary OFF is not supported", "export as OFF text or as PLY");
    }
    builder_.comments(text_);
    text_.need_word("the number of vertices");
  }

  std::size_t count(std::string_view what) {
    const std::int64_t value = text_.integer(what);
    if (value < 0) text_.fail(std::string(what) + " " + std::to_string(value) + " is negative");
    return static_cast<std::size_t>(value);
  }

  // Compares the counts with the file size. A vertex has six or more bytes, a face has two or more bytes.
  void check_room(std::size_t vertices, std::size_t faces) const {
    const std::size_t left = text_.bytes_left() + 1;
    if (vertices <= left / 6 && faces <= (left - 6 * vertices) / 2) return;
    text_.fail(std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                   " faces do not fit into the " + std::to_string(text_.bytes_left()) + " bytes that follow",
               "the file seems to be truncated: export or copy it again");
  }

  // Returns true if an integer above 1 comes before the first fraction: it must be a colour, not a normal.
  bool colors_come_first(std::size_t vertices) const {
    TextCursor ahead = text_;
    for (std::size_t v = 0; v < vertices && ahead.next_filled_line(); ++v, ahead.next_line()) {
      for (int i = 0; i < 3; ++i) ahead.word();
      for (int i = 0; i < 3; ++i) {
        const std::string_view word = ahead.word();
        const bool whole = word.find_first_of(".eE") == word.npos;
        if (!whole || number_in(word).value_or(0) > 1) return whole;
      }
    }
    return false;
  }

  void row(std::string_view what, std::size_t index) {
    text_.need_word(what);
    if (index % 8192 == 0) source_.report(text_.done());
  }

  void vertex() {
    TextCursor ahead = text_;
    const double x = text_.coordinate(), y = text_.coordinate(), z = text_.coordinate();
    builder_.position({x, y, z});
    if (source_.owner) {
      positions_.push_back(places_of_three(ahead));
      for (int i = 0; form_.colors_first && i < 4; ++i) ahead.word();
      if (form_.normals) normals_.push_back(places_of_three(ahead));
    }
    behind_position();
    text_.next_line();
  }

  // Reads at most `most` numbers of the row into numbers_. Later elements become 0. Returns the count.
  std::size_t numbers(std::size_t most) {
    numbers_.fill(0);
    return text_.numbers(std::span(numbers_).first(most), are_whole_);
  }

  WrittenColor color(std::size_t element, std::size_t first, std::size_t count) const {
    return {element, std::span(numbers_).subspan(first, count), std::span(are_whole_).subspan(first, count)};
  }

  // Reads the normal, colour (three or four numbers) and texture point that the keyword declares.
  void behind_position() {
    if (form_.numbers() == 0) return unnamed();
    const std::size_t count = numbers(form_.numbers());
    std::size_t at = form_.colors_first ? 4 : 0;
    if (form_.normals) {
      found_.normals.push_back({numbers_[at], numbers_[at + 1], numbers_[at + 2]});
      at += 3;
    }
    if (form_.colors) {
      const std::size_t left = count - std::min(at, count), behind = form_.texture && left >= 2 ? 2 : 0;
      const std::size_t components = std::min<std::size_t>(4, form_.colors_first ? count : left - behind);
      colors_.push_back(color(builder_.vertex_count() - 1, form_.colors_first ? 0 : at, components));
      if (!form_.colors_first) at += components;
    }
    if (form_.texture) found_.texture_points.push_back({numbers_[at], numbers_[at + 1]});
  }

  // Reads values that the keyword does not declare. Three or four non-negative numbers are a colour.
  void unnamed() {
    if (text_.at_line_end()) return;
    const std::size_t count = numbers(5);
    const bool is_color =
        (count == 3 || count == 4) && std::ranges::all_of(numbers_, [](double x) { return x >= 0; });
    if (!is_color) ++unknown_rows_;
    if (is_color) colors_.push_back(color(builder_.vertex_count() - 1, 0, count));
  }

  void finish_attributes() {
    const Color missing = Material{}.base_color;
    if (unknown_rows_ > 0) {
      builder_.warn("ignored undeclared values after the positions of " +
                    base::counted(unknown_rows_, "vertex row"));
    } else {
      found_.colors = colors_of_elements(colors_, builder_.vertex_count(), missing);
    }
    found_.polygon_colors = colors_of_elements(face_colors_, builder_.surface().polygon_count(), missing);
    if (form_.normals) found_.corner_normal = builder_.surface().corners;
    if (form_.texture) found_.corner_texture = builder_.surface().corners;
  }

  void face() {
    const std::size_t corners = count("number of corners");
    for (std::size_t i = 0; i < corners; ++i) {
      text_.need_word("the last face");  // the next index can be on the next line
      const std::int64_t index = text_.integer("vertex index");
      if (index < 0 || static_cast<std::size_t>(index) >= builder_.vertex_count())
        text_.fail("face refers to vertex " + std::to_string(index) + ", the file has " +
                   std::to_string(builder_.vertex_count()) + ", counted from 0");
      builder_.corner(static_cast<std::uint32_t>(index));
    }
    builder_.end_polygon();
    if (corners >= 3) {
      const std::size_t colors = numbers(4);  // a single number is an index into a colour map: ignored
      if (colors >= 3) face_colors_.push_back(color(builder_.surface().polygon_count() - 1, 0, colors));
    }
    text_.next_line();
  }

  const Source& source_;
  TextCursor text_;
  SurfaceBuilder builder_;
  std::vector<FileVectors::Places> positions_, normals_;
  OffForm form_;
  std::array<double, 9> numbers_{};  // numbers of the current row
  std::array<bool, 9> are_whole_{};
  std::vector<WrittenColor> colors_, face_colors_;  // of vertices, of polygons
  std::size_t unknown_rows_ = 0;
  Attributes found_;
};

}  // namespace

ReadResult read_off(const Source& source) {
  return OffReader(source).read();
}

bool looks_like_off(const Source& source) {
  TextCursor text(source, off_rules);
  return text.next_filled_line() && off_form(text.word()).has_value();
}

bool is_certainly_off(const Beginning& file) {
  const Source source = file.whole_lines();
  TextCursor text(source, off_rules);
  if (!text.next_filled_line()) return false;
  TextCursor ahead = text;
  if (off_form(ahead.word())) text = ahead;
  double counts[2] = {};
  std::size_t numbers = 0;
  for (; text.next_filled_line(); ++numbers) {
    const auto number = number_in(text.word());
    if (!number) return false;
    if (numbers < 2) counts[numbers] = *number;
  }
  const double least = 3 + 3 * counts[0] + counts[1];
  return counts[0] >= 0 && counts[1] >= 0 && numbers > 2 &&
         (!file.is_whole_file() || static_cast<double>(numbers) >= least);
}

void write_off(const Content& content, TextWriter& out) {
  const mesh::Surface& surface = content.surface;
  const auto& positions = content.positions;
  const std::size_t all = positions.size() + surface.polygon_count();
  const auto &colors = content.given().colors, &face_colors = content.given().polygon_colors;
  const auto color = [&](const Color& c) {
    for (const float x : c) out.text(" ").number(std::uint64_t{color_byte(x)});
  };
  std::size_t done = 0;
  out.text(colors.empty() ? "OFF\n" : "COFF\n").comments("# ", content.comments);
  out.number(std::uint64_t{positions.size()}).text(" ");
  out.number(std::uint64_t{surface.polygon_count()}).text(" 0\n");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    print_point(positions[v], out);
    if (!colors.empty()) color(colors[v]);
    out.text("\n").element_done(++done, all);
  }
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    const std::uint32_t begin = surface.polygon_starts[p], end = surface.polygon_starts[p + 1];
    out.number(std::uint64_t{end - begin});
    for (auto c = begin; c < end; ++c) out.text(" ").number(std::uint64_t{surface.corners[c]});
    if (!face_colors.empty()) color(face_colors[p]);
    out.text("\n").element_done(++done, all);
  }
}

}  // namespace viete::formats
