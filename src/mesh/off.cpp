#include "mesh/off.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>

#include "base/error.h"
#include "mesh/conversion.h"
#include "mesh/off_original.h"
#include "mesh/printed.h"
#include "mesh/surface_builder.h"
#include "mesh/text_cursor.h"

namespace viete::mesh {

namespace {

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
    const std::size_t body = text_.offset();
    builder_.surface().positions.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      row("the last vertex", i);
      vertex();
    }
    for (std::size_t i = 0; i < faces; ++i) {
      row("the last face", i);
      face();
    }
    auto attributes = finished_attributes();
    ReadResult result = builder_.finish("OFF");
    if (source_.owner) {
      result.original = std::make_shared<const OffOriginal>(source_.bytes, source_.owner, body, has_normals_);
    }
    result.attributes = std::move(attributes);
    return result;
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
      has_normals_ = word.find('N') != std::string_view::npos;
      has_colors_ = word.find('C') != std::string_view::npos;
      has_texture_ = word.starts_with("ST");
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
    if (has_normals_ || has_colors_ || has_texture_) behind_position();
    text_.next_line();
  }

  // A normal, a colour of three or four numbers, and a texture point, as far as they are there.
  void behind_position() {
    std::array<double, 9> values{};
    std::size_t count = 0, at = 0;
    for (; count < values.size() && !text_.at_line_end(); ++count) {
      const auto value = number_in(text_.word());
      if (!value) break;
      values[count] = *value;
    }
    const auto next = [&] { return at < count ? values[at++] : 0; };
    if (has_normals_) found_.normals.push_back({next(), next(), next()});
    if (has_colors_) {
      const std::size_t channels = count - std::min(count, at) - (has_texture_ && count >= at + 2 ? 2 : 0);
      Color& color = found_.colors.emplace_back(Color{0, 0, 0, 1});
      for (std::size_t i = 0; i < std::min<std::size_t>(channels, 4); ++i)
        color[i] = static_cast<float>(std::clamp(next(), 0.0, 255.0));
    }
    if (has_texture_) found_.texture_points.push_back({next(), next()});
  }

  // In [0, 1], or from 0 to 255 where one is larger than 1.
  static void to_unit_range(std::span<Color> colors) {
    const auto large = [](const Color& c) { return *std::max_element(c.begin(), c.end()) > 1; };
    if (std::none_of(colors.begin(), colors.end(), large)) return;
    for (Color& c : colors) {
      for (std::size_t i = 0; i < 4; ++i) c[i] = i == 3 && c[i] == 1 ? 1 : c[i] / 255;
    }
  }

  std::shared_ptr<const Attributes> finished_attributes() {
    to_unit_range(found_.colors);
    if (!face_colors_.empty()) {
      std::vector<Color> colors;
      for (const auto& [polygon, color] : face_colors_) colors.push_back(color);
      to_unit_range(colors);
      found_.polygon_colors.assign(builder_.surface().polygon_count(), Material{}.base_color);
      for (std::size_t i = 0; i < colors.size(); ++i)
        found_.polygon_colors[face_colors_[i].first] = colors[i];
    }
    if (has_normals_) found_.corner_normal = builder_.surface().corners;
    if (has_texture_) found_.corner_texture = builder_.surface().corners;
    if (found_.empty()) return nullptr;
    return std::make_shared<const Attributes>(std::move(found_));
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
    if (corners >= 3) face_color(builder_.surface().polygon_count() - 1);
    text_.next_line();
  }

  // Three or four numbers behind the corners; a single one is the index of a list that is in no file.
  void face_color(std::size_t polygon) {
    Color color{0, 0, 0, 1};
    std::size_t count = 0;
    for (; count < 4 && !text_.at_line_end(); ++count) {
      const auto value = number_in(text_.word());
      if (!value) break;
      color[count] = static_cast<float>(std::clamp(*value, 0.0, 255.0));
    }
    if (count >= 3) face_colors_.emplace_back(polygon, color);
  }

  const Source& source_;
  TextCursor text_;
  SurfaceBuilder builder_;
  bool has_normals_ = false, has_colors_ = false, has_texture_ = false;
  std::vector<std::pair<std::size_t, Color>>
      face_colors_;  // of the polygons that have one, as they are written
  Attributes found_;
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
  const std::size_t all = positions.size() + surface.polygon_count();
  const bool colored = content.attributes && !content.attributes->colors.empty();
  const bool faces_colored = content.attributes && !content.attributes->polygon_colors.empty();
  const auto color = [&](const Color& c) {
    for (const float x : c) out.text(" ").number(std::uint64_t{color_byte(x)});
  };
  std::size_t done = 0;
  out.text(colored ? "COFF\n" : "OFF\n").comments("# ", content.comments);
  out.number(std::uint64_t{positions.size()}).text(" ");
  out.number(std::uint64_t{surface.polygon_count()}).text(" 0\n");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    print_point(positions[v], out);
    if (colored) color(content.attributes->colors[v]);
    out.text("\n");
    out.element_done(++done, all);
  }
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    const std::uint32_t begin = surface.polygon_starts[p], end = surface.polygon_starts[p + 1];
    out.number(std::uint64_t{end - begin});
    for (auto c = begin; c < end; ++c) out.text(" ").number(std::uint64_t{surface.corners[c]});
    if (faces_colored) color(content.attributes->polygon_colors[p]);
    out.text("\n");
    out.element_done(++done, all);
  }
}

}  // namespace viete::mesh
