#include "mesh/formats/obj_original.h"

#include <array>
#include <charconv>
#include <optional>

#include "base/text.h"
#include "mesh/formats/mtl.h"
#include "mesh/formats/obj_normals.h"
#include "mesh/formats/obj_words.h"
#include "mesh/formats/printed.h"
#include "mesh/formats/rewriter.h"

namespace viete::mesh {

namespace {

// Like the first lines of this kind.
Printed printed_like(const Source& source, ObjWord kind, Digits digits) {
  constexpr std::size_t enough = 10'000;
  Printed printed(digits);
  TextCursor text(source, obj_rules);
  for (std::size_t lines = 0; lines < enough && text.next_filled_line(); text.next_line()) {
    if (obj_word(text.word()) != kind) continue;
    for (const std::string_view word : three_words(text)) printed.learn(word);
    ++lines;
  }
  return printed;
}

// The end of the line that ends before this place.
std::string_view line_end_before(std::string_view bytes, std::size_t place) {
  if (place > 0 && bytes[place - 1] == '\r') return "\r";
  return place > 1 && bytes[place - 2] == '\r' ? "\r\n" : "\n";
}

class ObjRewriter {
public:
  ObjRewriter(const Source& source, const Surface& rest, std::span<const Point> positions, TextWriter& out)
      : source_(source),
        rest_(rest),
        positions_(positions),
        coordinates_(printed_like(source, ObjWord::vertex, out.digits())),
        text_(source, obj_rules),
        rewriter_(source.bytes, out),
        out_(out) {
    coordinates_.keep(6, bounds(rest.positions).diagonal());
  }

  void with_normals(const Attributes& attributes, std::span<const std::uint32_t> blocks) {
    directions_ = printed_like(source_, ObjWord::normal, out_.digits());
    directions_.keep(5, 1);
    attributes_ = &attributes;
    normals_.emplace(rest_, attributes, blocks, positions_, directions_);
  }

  void run() {
    while (text_.next_filled_line()) {
      const ObjWord kind = obj_word(text_.word());
      if (ends_block(kind)) add_normals();
      statement(kind);
      text_.next_line();
      if (kind == ObjWord::vertex || kind == ObjWord::normal) block_end_ = text_.offset();
    }
    add_normals();
    rewriter_.finish();
  }

private:
  void statement(ObjWord kind) {
    if (kind == ObjWord::vertex) {
      const std::size_t v = vertices_++;
      rewriter_.replace(three_words(text_), rest_.positions[v], positions_[v], coordinates_);
    } else if (kind == ObjWord::normal && normals_) {
      const std::size_t n = lines_++;
      rewriter_.replace(three_words(text_), attributes_->normals[n], normals_->of_line(n), directions_);
      written_ = std::int64_t{normals_->index_of_line(n)} + 1;
    } else if (kind == ObjWord::face && normals_ && normals_->adds_lines()) {
      face();
    }
  }

  // For the lines of the block that ends here.
  void add_normals() {
    if (!normals_ || added_ == lines_) return;
    const std::string_view line_end = line_end_before(source_.bytes, block_end_);
    for (; added_ < lines_; ++added_) {
      for (const Vec3& normal : normals_->added(added_)) {
        rewriter_.copy_until(block_end_);
        if (!ends_line(block_end_)) out_.text(line_end);
        out_.text("vn");
        for (const double x : normal) out_.text(" ").text(directions_.print(x, room_));
        if (ends_line(block_end_)) out_.text(line_end);
        ++written_;
      }
    }
  }

  // False only at the end of a file whose last line lacks it.
  bool ends_line(std::size_t place) const {
    return place > 0 && (source_.bytes[place - 1] == '\n' || source_.bytes[place - 1] == '\r');
  }

  void face() {
    indices_.clear();
    while (!text_.at_line_end()) {
      text_.leading_integer("vertex index");
      indices_.push_back(obj_indices(text_.rest_of_word()));
    }
    const bool is_polygon = indices_.size() >= 3;  // others are none of the surface's
    for (const ObjIndices& corner : indices_) {
      const std::uint32_t index =
          is_polygon ? normals_->index_of_corner(corner_++) : index_of_line(corner.normal);
      if (corner.normal == 0 || index == none) continue;
      const std::int64_t now = corner.normal < 0 ? std::int64_t{index} - written_ : std::int64_t{index} + 1;
      if (now == corner.normal) continue;
      const char* const end = std::to_chars(room_.data(), room_.data() + room_.size(), now).ptr;
      rewriter_.replace(corner.normal_word, {room_.data(), static_cast<std::size_t>(end - room_.data())});
    }
  }

  std::uint32_t index_of_line(std::int64_t as_written) const {
    const std::int64_t line = as_written < 0 ? as_written + std::int64_t(lines_) : as_written - 1;
    const bool is_there = line >= 0 && line < std::int64_t(attributes_->normals.size());
    return is_there ? normals_->index_of_line(static_cast<std::size_t>(line)) : none;
  }

  const Source& source_;
  const Surface& rest_;
  std::span<const Point> positions_;
  Printed coordinates_, directions_;
  TextCursor text_;
  Rewriter rewriter_;
  TextWriter& out_;
  const Attributes* attributes_ = nullptr;
  std::optional<ObjNormals> normals_;
  std::size_t vertices_ = 0, corner_ = 0;
  std::size_t lines_ = 0, added_ = 0;  // vn of the file so far, and up to which lines were added for them
  std::int64_t written_ = 0;           // vn of the new file so far
  std::size_t block_end_ = 0;
  std::vector<ObjIndices> indices_;
  std::array<char, 400> room_;
};

}  // namespace

std::vector<std::string> ObjOriginal::beyond_attributes() const {
  const Source source{"", "obj", bytes_};
  TextCursor text(source, obj_rules);
  std::size_t lines = 0, points = 0, others = 0;
  for (; text.next_filled_line(); text.next_line()) {
    const std::string_view word = text.word();
    const ObjWord kind = obj_word(word);
    if (kind != ObjWord::other && kind != ObjWord::free_form) continue;
    ++(word == "l" || word == "L" ? lines : word == "p" || word == "P" ? points : others);
  }
  std::vector<std::string> found;
  if (lines > 0) found.push_back(base::counted(lines, "line"));
  if (points > 0) found.push_back(base::counted(points, "point"));
  if (others > 0) found.push_back(base::counted(others, "statement") + " of curves, surfaces and display");
  return found;
}

Companions ObjOriginal::companions() const {
  if (folder_.empty()) return {};
  const Source source{"", "obj", bytes_};
  TextCursor text(source, obj_rules);
  std::vector<std::string> libraries;
  for (; text.next_filled_line() && libraries.size() < 64; text.next_line()) {
    if (obj_word(text.word()) == ObjWord::material_library) libraries.emplace_back(text.rest_of_line());
  }
  return {folder_, files_of_libraries(folder_, libraries)};
}

std::vector<std::string> ObjOriginal::write(const Surface& rest, std::span<const Point> positions,
                                            TextWriter& out) const {
  const Source source{"", "obj", bytes_};
  ObjRewriter rewriter(source, rest, positions, out);
  if (attributes_ && !attributes_->corner_normal.empty()) rewriter.with_normals(*attributes_, normal_blocks_);
  rewriter.run();
  return {};
}

}  // namespace viete::mesh
