#include "mesh/formats/stl.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "mesh/formats/attributes.h"
#include "mesh/formats/byte_order.h"
#include "mesh/formats/surface_builder.h"
#include "mesh/formats/text_cursor.h"
#include "mesh/point_index.h"

namespace viete::mesh {

namespace {

[[noreturn]] void refuse_length(const Source& source, const std::string& problem) {
  throw base::Error(source.name, problem, "it seems to be truncated or damaged: export or copy it again");
}

// Bytes read at a wrong offset give implausible coordinates and normals.
bool makes_sense(const char* triangle) {
  for (std::size_t i = 0; i < 12; ++i) {
    const double size = std::abs(number_of_bytes<float>(triangle + 4 * i));
    if (size != 0 && !(size > 1e-37 && size < (i < 3 ? 1e6 : 1e30))) return false;
  }
  return true;
}

}  // namespace

StlTriangles::StlTriangles(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (bytes.size() < stl_head_bytes)
    refuse_length(source,
                  "a binary STL has at least 84 bytes, this file has " + std::to_string(bytes.size()));
  count_ = number_of_bytes<std::uint32_t>(bytes.data() + 80);
  const std::size_t room = bytes.size() - stl_head_bytes;
  const std::string announced = "the header announces " + std::to_string(count_) + " triangles";
  if (count_ > room / stl_triangle_bytes)
    refuse_length(source, announced + ", the file has room for " + std::to_string(room / stl_triangle_bytes));
  if (count_ == 0 && room > 0)
    refuse_length(source, announced + ", and " + std::to_string(room) + " bytes follow");
  end_ = stl_head_bytes + count_ * stl_triangle_bytes;
  if (end_ == bytes.size() || follow_attributes(bytes) || make_sense(bytes)) return;
  refuse_length(source, announced +
                            ", but the file size matches them neither without nor with the attributes that " +
                            "they count");
}

// True if there are attributes and they lie within the file.
bool StlTriangles::follow_attributes(std::string_view bytes) {
  std::vector<std::size_t> starts;
  std::size_t at = stl_head_bytes;
  for (std::size_t t = 0; t < count_; ++t) {
    if (bytes.size() - at < stl_triangle_bytes) return false;
    starts.push_back(at);
    at += stl_triangle_bytes;
    const std::uint16_t more = number_of_bytes<std::uint16_t>(bytes.data() + at - 2);
    if (bytes.size() - at < more) return false;
    at += more;
  }
  if (at == end_) return false;
  end_ = at;
  starts_ = std::move(starts);
  return true;
}

bool StlTriangles::make_sense(std::string_view bytes) const {
  for (std::size_t t = 0; t < count_; ++t)
    if (!makes_sense(bytes.data() + offset(t))) return false;
  return true;
}

std::string lower_stl_word(std::string_view word) {
  std::string text(word.substr(0, 16));
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

namespace {

std::uint64_t announced_bytes(const Source& source) {
  return stl_head_bytes +
         stl_triangle_bytes * std::uint64_t{number_of_bytes<std::uint32_t>(source.bytes.data() + 80)};
}

bool is_exact_binary(const Source& source) {
  return source.bytes.size() >= stl_head_bytes && source.bytes.size() == announced_bytes(source);
}

bool starts_solid(const Source& source) {
  TextCursor text(source, {});
  return text.next_filled_line() && lower_stl_word(text.word()) == "solid";
}

bool holds_nul(const Source& source) {
  return source.bytes.substr(0, 4096).find('\0') != std::string_view::npos;
}

// True if the file size matches the count, or if the first triangles are plausible with their attributes.
bool begins_stl_triangles(std::string_view beginning, std::uint64_t file_size) {
  if (beginning.size() < stl_head_bytes) return false;
  const std::uint32_t count = number_of_bytes<std::uint32_t>(beginning.data() + 80);
  const std::uint64_t least = stl_head_bytes + std::uint64_t{stl_triangle_bytes} * count;
  if (count == 0 || least >= file_size) return least == file_size;
  std::size_t at = stl_head_bytes;
  for (std::uint32_t t = 0; t < count && at + stl_triangle_bytes <= beginning.size(); ++t) {
    if (!makes_sense(beginning.data() + at)) return false;
    at += stl_triangle_bytes;
    at += number_of_bytes<std::uint16_t>(beginning.data() + at - 2);
  }
  return true;
}

// Merges equal corners.
class CornerJoiner {
public:
  explicit CornerJoiner(SurfaceBuilder& builder) : builder_(builder) {}

  void add(Point p) {
    for (double& x : p) x += 0.0;  // -0 becomes 0
    const std::size_t before = builder_.vertex_count();
    const std::uint32_t vertex = index_.find_or_add(p, builder_.surface().positions);
    if (vertex == before) builder_.position(p);
    builder_.corner(vertex);
  }

private:
  SurfaceBuilder& builder_;
  PointIndex index_;
};

// The two attribute bytes of each facet as a colour, five bits per channel. VisCAM and SolidView set the
// highest bit if there is a colour, with red in the upper bits. Magics declares colours and a default colour
// in the header, and sets the bit if a facet has no colour of its own, with red in the lower bits.
class StlColors {
public:
  explicit StlColors(std::string_view head) {
    constexpr std::string_view mark = "COLOR=";
    const std::size_t at = head.find(mark);
    if (at == std::string_view::npos || at + mark.size() + 4 > head.size()) return;
    by_magics_ = true;
    for (std::size_t i = 0; i < 4; ++i)
      of_all_[i] = static_cast<float>(static_cast<unsigned char>(head[at + mark.size() + i])) / 255;
  }

  void take(const char* bytes) { words_.push_back(number_of_bytes<std::uint16_t>(bytes)); }

  /// Null without colours.
  std::shared_ptr<const Attributes> finish() const {
    const bool any =
        std::ranges::any_of(words_, [&](auto w) { return by_magics_ ? w != 0 : (w & own_) != 0; });
    if (!any && !by_magics_) return nullptr;
    auto found = std::make_shared<Attributes>();
    for (const std::uint16_t word : words_) {
      const bool has_own = any && ((word & own_) != 0) != by_magics_;
      found->polygon_colors.push_back(has_own ? color(word) : of_all_);
    }
    return found;
  }

private:
  static constexpr unsigned own_ = 0x8000;

  Color color(std::uint16_t word) const {
    const auto channel = [&](int shift) { return static_cast<float>(word >> shift & 31) / 31; };
    return by_magics_ ? Color{channel(0), channel(5), channel(10), 1}
                      : Color{channel(10), channel(5), channel(0), 1};
  }

  bool by_magics_ = false;
  Color of_all_ = Material{}.base_color;
  std::vector<std::uint16_t> words_;
};

ReadResult read_binary(const Source& source) {
  const StlTriangles triangles(source);
  SurfaceBuilder builder(source);
  const std::string_view head = source.bytes.substr(0, 80);
  builder.comment(TextWriter::one_line(std::string(head.substr(0, head.find('\0')))));
  CornerJoiner corners(builder);
  StlColors colors(head);
  for (std::size_t t = 0; t < triangles.count(); ++t) {
    const char* const at = source.bytes.data() + triangles.offset(t) + 12;
    for (int c = 0; c < 3; ++c) {
      Point p{};
      for (int i = 0; i < 3; ++i) p[i] = number_of_bytes<float>(at + 12 * c + 4 * i);
      if (!std::isfinite(p[0] + p[1] + p[2])) {
        throw base::Error(source.place("triangle", t), "a coordinate is not a finite number",
                          "repair the triangle");
      }
      corners.add(p);
    }
    builder.end_polygon();
    colors.take(at + 36);
    if (t % 8192 == 0) source.report(static_cast<double>(t) / static_cast<double>(triangles.count()));
  }
  if (triangles.have_attributes()) {
    builder.warn(source.name + ": ignored the attributes of triangles");
  }
  if (const std::size_t behind = source.bytes.size() - triangles.end(); behind > 0) {
    builder.warn(source.name + ": ignored " + std::to_string(behind) + " bytes after the " +
                 std::to_string(triangles.count()) + " triangles that the header announces");
  }
  ReadResult result = builder.finish("STL binary");
  if (!triangles.have_attributes()) result.attributes = colors.finish();
  if (source.owner) result.original = stl_original(source, true);
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
    if (!ended_) builder_.warn(source_.name + ": the last line is not endsolid, the file may be cut short");
    ReadResult result = builder_.finish("STL ascii");
    if (source_.owner) result.original = stl_original(source_, false);
    return result;
  }

private:
  void statement(const std::string& word) {
    if (word == "vertex") {
      const double x = text_.coordinate(), y = text_.coordinate(), z = text_.coordinate();
      if (!in_facet_) text_.fail("vertex outside of a facet", "export the model again");
      corners_.add({x, y, z});
      ++facet_corners_;
    } else if (word == "facet") {
      if (in_facet_) text_.fail("facet within a facet", "export the model again");
      in_facet_ = true;
      facet_corners_ = 0;
    } else if (word == "endfacet") {
      end_facet();
    } else if (word == "solid") {
      builder_.comment(text_.rest_of_line());
    } else if (word == "endsolid") {
      ended_ = true;
    } else if (word != "outer" && word != "endloop") {
      text_.fail(in_quotes(word) + " is not a word of STL", "export the model again");
    }
    if (word != "endsolid") ended_ = false;
  }

  void end_facet() {
    if (!in_facet_ || facet_corners_ != 3) {
      text_.fail("facet with " + std::to_string(facet_corners_) + " corners instead of 3",
                 "export the model again");
    }
    builder_.end_polygon();
    in_facet_ = false;
  }

  const Source& source_;
  TextCursor text_;
  SurfaceBuilder builder_;
  CornerJoiner corners_;
  std::size_t lines_ = 0;
  int facet_corners_ = 0;
  bool in_facet_ = false, ended_ = false;
};

}  // namespace

ReadResult read_stl(const Source& source) {
  if (is_exact_binary(source)) return read_binary(source);
  if (starts_solid(source) && !holds_nul(source)) return StlTextReader(source).read();
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

}  // namespace viete::mesh
