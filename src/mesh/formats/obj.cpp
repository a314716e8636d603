#include "mesh/formats/obj.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "mesh/formats/foreign_content.h"
#include "mesh/formats/obj_attributes.h"
#include "mesh/formats/obj_original.h"
#include "mesh/formats/obj_words.h"
#include "mesh/formats/surface_builder.h"
#include "mesh/formats/text_cursor.h"

namespace viete::mesh {

namespace {

class ObjReader {
public:
  explicit ObjReader(const Source& source)
      : source_(source), text_(source, obj_rules), builder_(source), attributes_(source) {}

  ReadResult read() {
    head_comments();
    while (text_.next_filled_line()) {
      statement(text_.word());
      text_.next_line();
      if (++lines_ % 8192 == 0) source_.report(text_.done());
    }
    check_highest();
    refuse_other_content();
    tell_skipped();
    end_normals();
    auto attributes = attributes_.finish(builder_);
    ReadResult result = builder_.finish("OBJ");
    if (source_.owner)
      result.original = std::make_shared<const ObjOriginal>(source_.bytes, source_.owner, attributes,
                                                            std::move(normal_blocks_), source_.folder);
    result.attributes = std::move(attributes);
    return result;
  }

private:
  void head_comments() {
    while (!text_.at_end() && text_.at_line_end()) {
      builder_.comment(text_.rest_of_line());
      text_.next_line();
    }
  }

  void statement(std::string_view word) {
    const ObjWord kind = obj_word(word);
    if (ends_block(kind)) end_normals();
    switch (kind) {
      case ObjWord::vertex: return position();
      case ObjWord::face: return face();
      case ObjWord::texture_point: return attributes_.texture_point(text_);
      case ObjWord::normal: return attributes_.normal(text_);
      case ObjWord::group: return attributes_.group(text_.rest_of_line());
      case ObjWord::object: return attributes_.object(text_.rest_of_line());
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
      text_.fail("face without vertices", "the file may be cut short: export it again");
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
    if (index == 0) text_.fail("face refers to vertex 0, OBJ counts from 1", "export the model again");
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
    if (rest[0] != '/' || rest.find_first_not_of("0123456789/+-") != std::string_view::npos) {
      text_.fail("vertex index is followed by " + in_quotes(rest), "write corners as 7, 7/2, 7//3 or 7/2/3");
    }
    return rest;
  }

  void check_highest() const {
    if (highest_ > static_cast<std::int64_t>(builder_.vertex_count())) refuse(highest_line_, highest_);
  }

  [[noreturn]] void refuse(std::size_t line, std::int64_t index) const {
    const std::string count = std::to_string(builder_.vertex_count());
    throw base::Error(text_.place(line),
                      "face refers to vertex " + std::to_string(index) + ", the file has " + count +
                          (index < 0 ? " before it" : ""),
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
                      "OBJ has no lines that start with " + first_unknown_ + ", and no vertices were found",
                      "export the model again");
  }

  void tell_skipped() {
    if (free_forms_ > 0) {
      builder_.warn(source_.name + ": " + base::counted(free_forms_, "free-form element") +
                    " cannot be shown");
    }
    if (unknown_ > 0) {
      builder_.warn(text_.place(first_unknown_line_) + ": passed over " + base::counted(unknown_, "line") +
                    " that OBJ does not know, the first starts with " + first_unknown_);
    }
  }

  const Source& source_;
  TextCursor text_;
  SurfaceBuilder builder_;
  ObjAttributes attributes_;
  std::vector<std::uint32_t> normal_blocks_;  // lines vn up to the end of each block of them
  std::size_t lines_ = 0;
  std::int64_t highest_ = 0;  // of the indices that ran ahead of the vertices read so far
  std::size_t highest_line_ = 0;
  std::size_t free_forms_ = 0, unknown_ = 0, first_unknown_line_ = 0;
  std::string first_unknown_;
};

}  // namespace

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
        case ObjWord::vertex: numbers(3), ++vertices; break;
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

}  // namespace viete::mesh
