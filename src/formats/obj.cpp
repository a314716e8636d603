#include "formats/codecs.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"
#include "formats/obj_file.h"

namespace viete::formats {

namespace {

using enum ObjWord;

constexpr std::pair<std::string_view, ObjWord> rarer_words[] = {{"g", group},
                                                                {"o", object},
                                                                {"s", smoothing},
                                                                {"usemtl", use_material},
                                                                {"mtllib", material_library},
                                                                {"curv", free_form},
                                                                {"surf", free_form},
                                                                {"fo", face}};  // `f` before version 3.0

constexpr std::string_view other_words[] = {
    "bevel", "bmat",   "bsp",       "bzp",   "c_interp", "call", "cdc",  "cdp",        "con",
    "csh",   "cstype", "ctech",     "curv2", "d_interp", "deg",  "end",  "hole",       "l",
    "lod",   "maplib", "mg",        "p",     "parm",     "res",  "scrv", "shadow_obj", "sp",
    "stech", "step",   "trace_obj", "trim",  "usemap",   "vp"};

// Reads an index after a slash. If there is no index, leaves `index`. If the text is invalid, returns false.
bool take_index(std::string_view& rest, std::int64_t& index) {
  if (rest.empty() || rest.front() == '/') return true;
  const char* const from = rest.data() + (rest.front() == '+' ? 1 : 0);
  const auto [to, code] = std::from_chars(from, rest.data() + rest.size(), index);
  rest.remove_prefix(static_cast<std::size_t>(to - rest.data()));
  return code == std::errc() && index != 0;
}

constexpr std::size_t most_groups = 100'000, most_libraries = 64, most_name_bytes = 255;

// Collects attributes. An invalid attribute only causes a warning.
class ObjAttributes {
public:
  explicit ObjAttributes(const Source& source) : source_(source) {}

  // Reads the colour after x y z. Ignores fewer than three numbers: a single number is a weight.
  void behind_position(TextCursor& text, std::size_t vertex) {
    std::array<double, 4> values{};
    std::array<bool, 4> are_whole{};
    const std::size_t count = text.numbers(values, are_whole);
    if (count >= 3) colors_.emplace_back(vertex, std::span(values).first(count), are_whole);
  }

  std::size_t normal_count() const { return found_.normals.size(); }
  // Valid after finish().
  const MaterialFiles& files() const { return files_; }

  void texture_point(TextCursor& text) {
    std::array<double, 2> values{};
    bad_numbers_ += text.numbers(values) == 0;
    found_.texture_points.push_back(values);
  }

  void normal(TextCursor& text) {
    mesh::Vec3 values{};
    if (text.numbers(values) < 3) {
      ++bad_numbers_;
      values = {};
    }
    found_.normals.push_back(values);
  }

  // Call this before adding the corner to the builder. `behind_vertex` is the text after the vertex index.
  void corner(std::size_t corner, std::string_view behind_vertex) {
    const ObjIndices indices = obj_indices(behind_vertex);
    bad_indices_ += !indices.readable;
    put(found_.corner_texture, corner, indices.texture_point, found_.texture_points.size());
    put(found_.corner_normal, corner, indices.normal, found_.normals.size());
  }

  // Call this after the builder's end_polygon().
  void end_polygon(const mesh::Surface& surface) {
    const std::size_t corners = surface.corners.size();
    for (auto* indices : {&found_.corner_texture, &found_.corner_normal})
      if (indices->size() > corners) indices->resize(corners);
    const bool made = std::exchange(polygons_, surface.polygon_count()) != surface.polygon_count();
    if (!changed_ || !made) return;
    state_.first_polygon = static_cast<std::uint32_t>(surface.polygon_count() - 1);
    changed_ = false;
    if (found_.groups.size() < most_groups) {
      found_.groups.push_back(state_);
    } else {
      ++groups_left_out_;
    }
  }

  void name(std::string Group::*part, std::string_view name) {
    state_.*part = name.substr(0, most_name_bytes);
    changed_ = true;
  }

  void smoothing(std::string_view value) {
    const bool smooth = value != "off" && value != "0";
    changed_ |= smooth != state_.smooth;
    state_.smooth = smooth;
  }

  void use_material(std::string_view name) {
    auto at = materials_.find(name);
    if (at == materials_.end()) {
      at = materials_.emplace(name, static_cast<std::uint32_t>(found_.materials.size())).first;
      found_.materials.emplace_back().name = name;
    }
    changed_ |= state_.material != at->second;
    state_.material = at->second;
  }

  void library(std::string_view names) {
    if (std::find(libraries_.begin(), libraries_.end(), names) != libraries_.end()) return;
    if (!names.empty() && libraries_.size() < most_libraries) libraries_.emplace_back(names);
  }

  // Reads the material libraries.
  Attributes finish(SurfaceBuilder& builder) {
    check(found_.corner_texture, found_.texture_points.size());
    check(found_.corner_normal, found_.normals.size());
    const std::size_t corners = builder.surface().corners.size();
    for (auto* indices : {&found_.corner_texture, &found_.corner_normal})
      if (!indices->empty()) indices->resize(corners, mesh::none);
    found_.colors = colors_of_elements(colors_, builder.vertex_count(), {1, 1, 1, 1});
    finish_groups();
    files_ = read_materials(source_, libraries_, found_, builder);
    tell_bad(builder);
    return std::move(found_);
  }

private:
  // Stores the corner's index. A negative index counts back from the last of the `count` elements read so
  // far. A positive index can be too large: check() tests all indices at the end of the file.
  void put(std::vector<std::uint32_t>& indices, std::size_t corner, std::int64_t index, std::size_t count) {
    if (index == 0 && indices.empty()) return;
    indices.resize(corner, mesh::none);
    const bool is_none = index == 0;
    if (index < 0) index += static_cast<std::int64_t>(count) + 1;
    const bool good = index > 0 && index < mesh::none;
    bad_indices_ += !good && !is_none;
    indices.push_back(good ? static_cast<std::uint32_t>(index - 1) : mesh::none);
  }

  void check(std::vector<std::uint32_t>& indices, std::size_t count) {
    for (std::uint32_t& i : indices) {
      if (i == mesh::none || i < count) continue;
      i = mesh::none;
      ++bad_indices_;
    }
  }

  void finish_groups() {
    const auto plain = [](const Group& g) {
      return g.object.empty() && g.name.empty() && g.material == mesh::none && g.smooth;
    };
    if (std::all_of(found_.groups.begin(), found_.groups.end(), plain)) found_.groups.clear();
  }

  void tell_bad(SurfaceBuilder& builder) const {
    if (bad_indices_ > 0)
      builder.warn("ignored " + base::counted(bad_indices_, "reference") +
                   " to missing texture coordinates or normals");
    if (bad_numbers_ > 0)
      builder.warn("used 0 for " + base::counted(bad_numbers_, "unreadable line") +
                   " of texture coordinates or normals");
    if (groups_left_out_ > 0)
      builder.warn("more than " + base::counted(most_groups, "group") + ", further groups are merged");
  }

  const Source& source_;
  Attributes found_;
  std::vector<WrittenColor> colors_;
  Group state_;  // the group of the next faces
  bool changed_ = true;
  std::size_t polygons_ = 0;
  std::size_t bad_indices_ = 0, bad_numbers_ = 0, groups_left_out_ = 0;
  std::map<std::string, std::uint32_t, std::less<>> materials_;
  std::vector<std::string> libraries_;
  MaterialFiles files_;
};

class ObjReader {
public:
  explicit ObjReader(const Source& source)
      : source_(source), text_(source, obj_rules), builder_(source), attributes_(source) {}

  ReadResult read() {
    builder_.comments(text_);
    while (text_.next_filled_line()) {
      statement(text_.word());
      text_.next_line();
      if (++lines_ % 8192 == 0) source_.report(text_.done());
    }
    if (highest_ > static_cast<std::int64_t>(builder_.vertex_count())) refuse(highest_line_, highest_);
    refuse_other_content();
    tell_skipped();
    end_normals();
    Attributes attributes = attributes_.finish(builder_);
    ReadResult result = builder_.finish("OBJ", std::move(attributes));
    if (source_.owner)
      result.original =
          obj_original(source_, result.attributes, std::move(normal_blocks_), attributes_.files());
    return result;
  }

private:
  void statement(std::string_view word) {
    const ObjWord kind = obj_word(word);
    if (ends_block(kind)) end_normals();
    switch (kind) {
      case ObjWord::vertex: return position();
      case ObjWord::face: return face();
      case ObjWord::texture_point: return attributes_.texture_point(text_);
      case ObjWord::normal: return attributes_.normal(text_);
      case ObjWord::group: return attributes_.name(&Group::name, text_.rest_of_line());
      case ObjWord::object: return attributes_.name(&Group::object, text_.rest_of_line());
      case ObjWord::smoothing: return attributes_.smoothing(text_.word());
      case ObjWord::use_material: return attributes_.use_material(text_.rest_of_line());
      case ObjWord::material_library: return attributes_.library(text_.rest_of_line());
      case ObjWord::free_form: ++free_forms_; return;
      case ObjWord::other: return;
      case ObjWord::unknown: return skip_unknown(word);
    }
  }

  void end_normals() {
    const std::size_t count = attributes_.normal_count();
    if (count > (normal_blocks_.empty() ? 0 : normal_blocks_.back()))
      normal_blocks_.push_back(static_cast<std::uint32_t>(count));
  }

  void position() {
    const double x = text_.coordinate(), y = text_.coordinate(), z = text_.coordinate();
    if (!text_.at_line_end()) attributes_.behind_position(text_, builder_.vertex_count());
    builder_.position({x, y, z});
  }

  void face() {
    if (text_.at_line_end())
      text_.fail("the face has no vertices", "the file seems to be truncated: export or copy it again");
    do {
      const std::uint32_t v = vertex(text_.leading_integer("vertex index"));
      attributes_.corner(builder_.surface().corners.size(), behind_vertex());
      builder_.corner(v);
    } while (!text_.at_line_end());
    builder_.end_polygon();
    attributes_.end_polygon(builder_.surface());
  }

  std::uint32_t vertex(std::int64_t index) {
    const auto count = static_cast<std::int64_t>(builder_.vertex_count());
    if (index == 0) text_.fail("face refers to vertex 0, but OBJ indices start at 1");
    if (index < -count) refuse(text_.line(), index);
    if (index < 0) return static_cast<std::uint32_t>(count + index);
    if (index > std::numeric_limits<std::uint32_t>::max()) refuse(text_.line(), index);
    if (index > count && index > highest_) {
      highest_ = index;
      highest_line_ = text_.line();
    }
    return static_cast<std::uint32_t>(index - 1);
  }

  std::string_view behind_vertex() {
    const std::string_view rest = text_.rest_of_word();
    if (rest.empty()) return rest;
    if (rest[0] != '/' || rest.find_first_not_of("0123456789/+-") != std::string_view::npos)
      text_.fail("vertex index is followed by " + in_quotes(rest), "write corners as 7, 7/2, 7//3 or 7/2/3");
    return rest;
  }

  [[noreturn]] void refuse(std::size_t line, std::int64_t index) const {
    const std::string count = std::to_string(builder_.vertex_count());
    throw base::Error(text_.place(line),
                      "face refers to vertex " + std::to_string(index) + ", the file has " + count +
                          (index < 0 ? " vertices before this line" : ""),
                      "export the model again");
  }

  void skip_unknown(std::string_view word) {
    if (unknown_++ > 0) return;
    first_unknown_ = in_quotes(word);
    first_unknown_line_ = text_.line();
  }

  void refuse_other_content() const {
    if (builder_.vertex_count() > 0 || unknown_ == 0) return;
    throw base::Error(text_.place(first_unknown_line_),
                      "unknown OBJ keyword " + first_unknown_ + ", and no vertices were found",
                      "export the model again");
  }

  void tell_skipped() {
    if (free_forms_ > 0) builder_.warn(base::counted(free_forms_, "free-form element") + " cannot be shown");
    if (unknown_ > 0)
      builder_.warn_at(text_.place(first_unknown_line_), "ignored " + base::counted(unknown_, "line") +
                                                             " with unknown keywords, the first is " +
                                                             first_unknown_);
  }

  const Source& source_;
  TextCursor text_;
  SurfaceBuilder builder_;
  ObjAttributes attributes_;
  std::vector<std::uint32_t> normal_blocks_;  // see obj_original()
  std::size_t lines_ = 0;
  std::int64_t highest_ = 0;  // largest vertex index of faces that come before their vertices
  std::size_t highest_line_ = 0;
  std::size_t free_forms_ = 0, unknown_ = 0, first_unknown_line_ = 0;
  std::string first_unknown_;
};

}  // namespace

ObjWord small_obj_word(std::string_view word) {
  if (word == "v") return vertex;
  if (word == "f") return face;
  if (word == "vt") return texture_point;
  if (word == "vn") return normal;
  for (const auto& [rarer, kind] : rarer_words)
    if (word == rarer) return kind;
  return std::ranges::find(other_words, word) == std::end(other_words) ? unknown : other;
}

ObjWord obj_word(std::string_view word) {
  const ObjWord found = small_obj_word(word);
  if (found != unknown || word.size() > 10) return found;
  return small_obj_word(base::lower_case(word));
}

ObjIndices obj_indices(std::string_view rest) {
  ObjIndices indices;
  if (rest.empty()) return indices;
  rest.remove_prefix(1);
  bool good = take_index(rest, indices.texture_point);
  if (good && !rest.empty()) {
    rest.remove_prefix(1);
    indices.normal_word = rest;
    good = take_index(rest, indices.normal) && rest.empty();
  }
  return good ? indices : ObjIndices{0, 0, {}, false};
}

ReadResult read_obj(const Source& source) {
  return ObjReader(source).read();
}

bool is_certainly_obj(const Beginning& file) {
  const Source source = file.whole_lines();
  TextCursor text(source, obj_rules);
  std::size_t vertices = 0, statements = 0, unknown = 0;
  const auto numbers = [&](int count) {
    for (int i = 0; i < count; ++i) (void)text.coordinate();
  };
  try {
    for (; text.next_filled_line(); text.next_line(), ++statements) {
      switch (obj_word(text.word())) {
        case ObjWord::vertex:
          numbers(3);
          ++vertices;
          break;
        case ObjWord::normal: numbers(3); break;
        case ObjWord::texture_point: numbers(1); break;
        case ObjWord::face:
          for (; !text.at_line_end(); (void)text.rest_of_word()) (void)text.leading_integer("corner");
          break;
        case ObjWord::unknown: ++unknown; break;
        default: break;
      }
    }
  } catch (const base::Error&) {
    return false;
  }
  return vertices > 0 && 10 * unknown <= statements && !looks_binary(source.bytes);
}

bool looks_like_obj(const Source& source) {
  TextCursor text(source, obj_rules);
  if (!text.next_filled_line()) return false;
  return small_obj_word(text.word()) != ObjWord::unknown;
}

}  // namespace viete::formats
