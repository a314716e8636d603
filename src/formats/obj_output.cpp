// Writes OBJ: a surface as a new file, or the file that was read, with moved positions.
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "base/text.h"
#include "formats/codecs.h"
#include "formats/file_vectors.h"
#include "formats/obj_file.h"

namespace viete::formats {

namespace {

std::string words_of(const mesh::Vec3& normal, const Printed& printed) {
  std::array<char, 400> room;
  std::string words;
  for (const double x : normal) words.append(printed.print(x, room)).append(1, ' ');
  return words;
}

// The `vn` lines of the deformed file. Several vertices can refer to one original line. If the deformation
// gives these vertices different normals, new lines are added after the block of `vn` lines.
class ObjNormals {
public:
  // For `blocks`, see obj_original(). `attributes` must have normals.
  ObjNormals(const mesh::Surface& rest, const Attributes& attributes, std::span<const std::uint32_t> blocks,
             std::span<const mesh::Point> positions, const Printed& printed) {
    const SpreadNormals spread(rest, attributes);
    std::vector<mesh::Vec3> moved = deformed_normals(rest, positions, spread.normals, spread.of_corner);
    mesh::keep_lengths(spread.normals, moved);
    std::vector<std::uint32_t> value_of(moved.size());
    for (std::size_t n = 0; n < attributes.normals.size(); ++n) {
      const auto begin = spread.first[n], end = spread.first[n + 1];
      first_.push_back(static_cast<std::uint32_t>(values_.size()));
      // If one copy of the normal did not change, the original line stays.
      const auto kept = std::find(moved.begin() + begin, moved.begin() + end, attributes.normals[n]);
      values_.push_back(kept == moved.begin() + end ? moved[begin] : *kept);
      value_of[begin] = first_[n];
      if (end - begin == 1) continue;
      std::map<std::string, std::uint32_t> printed_before = {{words_of(values_.back(), printed), first_[n]}};
      for (auto i = begin; i < end; ++i) {
        const auto next = static_cast<std::uint32_t>(values_.size());
        const auto [at, is_new] = printed_before.emplace(words_of(moved[i], printed), next);
        if (is_new) values_.push_back(moved[i]);
        value_of[i] = at->second;
      }
    }
    first_.push_back(static_cast<std::uint32_t>(values_.size()));
    std::vector<std::uint32_t> value_of_corner = spread.of_corner;
    for (std::uint32_t& v : value_of_corner) v = v == mesh::none ? mesh::none : value_of[v];
    number(blocks, attributes, value_of_corner);
  }

  // Returns the new normal of an original line. An unmoved normal has the same bits as before.
  const mesh::Vec3& of_line(std::size_t line) const { return values_[first_[line]]; }
  // Returns the normals of the `vn` lines that are added after an original `vn` line.
  std::span<const mesh::Vec3> added(std::size_t line) const {
    return std::span(values_).subspan(first_[line] + 1, first_[line + 1] - first_[line] - 1);
  }
  bool adds_lines() const { return values_.size() + 1 > first_.size(); }

  // These functions return indices of `vn` lines in the new file, counted from 0.
  std::uint32_t index_of_line(std::size_t line) const { return index_[line]; }
  std::uint32_t index_of_corner(std::size_t corner) const { return corner_index_[corner]; }

private:
  void number(std::span<const std::uint32_t> blocks, const Attributes& attributes,
              std::span<const std::uint32_t> value_of_corner) {
    std::vector<std::uint32_t> index_of_value(values_.size());
    std::uint32_t next = 0, begin = 0;
    for (const std::uint32_t end : blocks) {
      for (auto n = begin; n < end; ++n) {
        index_of_value[first_[n]] = next;
        index_.push_back(next++);
      }
      for (auto n = begin; n < end; ++n)
        for (auto v = first_[n] + 1; v < first_[n + 1]; ++v) index_of_value[v] = next++;
      begin = end;
    }
    if (!adds_lines()) return;
    corner_index_.resize(attributes.corner_normal.size(), mesh::none);
    for (std::size_t c = 0; c < corner_index_.size(); ++c)
      if (value_of_corner[c] != mesh::none) corner_index_[c] = index_of_value[value_of_corner[c]];
  }

  std::vector<mesh::Vec3> values_;    // for each original line: its normal, then the normals of added lines
  std::vector<std::uint32_t> first_;  // index in values_ of each original line's normal
  std::vector<std::uint32_t> index_;
  std::vector<std::uint32_t> corner_index_;  // empty if no lines are added
};

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

// Returns "\r", "\r\n" or "\n": the line end immediately before this offset.
std::string_view line_end_before(std::string_view bytes, std::size_t place) {
  if (place > 0 && bytes[place - 1] == '\r') return "\r";
  return place > 1 && bytes[place - 2] == '\r' ? "\r\n" : "\n";
}

class ObjRewriter {
public:
  ObjRewriter(const Source& source, const mesh::Surface& rest, std::span<const mesh::Point> positions,
              TextWriter& out)
      : source_(source),
        rest_(rest),
        positions_(positions),
        coordinates_(printed_like(source, ObjWord::vertex, out.digits())),
        text_(source, obj_rules),
        rewriter_(source.bytes, out),
        out_(out) {
    coordinates_.keep(6, mesh::bounds(rest.positions).diagonal());
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

  // Writes the added `vn` lines at the end of the block, at block_end_.
  void add_normals() {
    if (!normals_ || added_ == lines_) return;
    const std::string_view line_end = line_end_before(source_.bytes, block_end_);
    for (; added_ < lines_; ++added_)
      for (const mesh::Vec3& normal : normals_->added(added_)) {
        rewriter_.copy_until(block_end_);
        if (!ends_line(block_end_)) out_.text(line_end);
        out_.text("vn");
        for (const double x : normal) out_.text(" ").text(directions_.print(x, room_));
        if (ends_line(block_end_)) out_.text(line_end);
        ++written_;
      }
  }

  // Returns true if a line end is immediately before this offset. Only the last line can lack a line end.
  bool ends_line(std::size_t place) const {
    return place > 0 && (source_.bytes[place - 1] == '\n' || source_.bytes[place - 1] == '\r');
  }

  void face() {
    indices_.clear();
    while (!text_.at_line_end()) {
      text_.leading_integer("vertex index");
      indices_.push_back(obj_indices(text_.rest_of_word()));
    }
    const bool is_polygon = indices_.size() >= 3;  // the surface has no polygons with fewer corners
    for (const ObjIndices& corner : indices_) {
      const std::uint32_t index =
          is_polygon ? normals_->index_of_corner(corner_++) : index_of_line(corner.normal);
      if (corner.normal == 0 || index == mesh::none) continue;
      const std::int64_t now = corner.normal < 0 ? std::int64_t{index} - written_ : std::int64_t{index} + 1;
      if (now == corner.normal) continue;
      const char* const end = std::to_chars(room_.data(), room_.data() + room_.size(), now).ptr;
      rewriter_.replace(corner.normal_word, {room_.data(), static_cast<std::size_t>(end - room_.data())});
    }
  }

  std::uint32_t index_of_line(std::int64_t as_written) const {
    const std::int64_t line = as_written < 0 ? as_written + std::int64_t(lines_) : as_written - 1;
    const bool is_there = line >= 0 && line < std::int64_t(attributes_->normals.size());
    return is_there ? normals_->index_of_line(static_cast<std::size_t>(line)) : mesh::none;
  }

  const Source& source_;
  const mesh::Surface& rest_;
  std::span<const mesh::Point> positions_;
  Printed coordinates_, directions_;
  TextCursor text_;
  Rewriter rewriter_;
  TextWriter& out_;
  const Attributes* attributes_ = nullptr;
  std::optional<ObjNormals> normals_;
  std::size_t vertices_ = 0, corner_ = 0;
  std::size_t lines_ = 0;     // number of vn lines that have been read
  std::size_t added_ = 0;     // number of original vn lines whose added lines have been written
  std::int64_t written_ = 0;  // number of vn lines that have been written
  std::size_t block_end_ = 0;
  std::vector<ObjIndices> indices_;
  std::array<char, 400> room_;
};

class ObjOriginal final : public Original {
public:
  ObjOriginal(const Source& source, std::shared_ptr<const Attributes> attributes,
              std::vector<std::uint32_t> normal_blocks, MaterialFiles files)
      : Original("OBJ", source),
        attributes_(std::move(attributes)),
        normal_blocks_(std::move(normal_blocks)),
        ignored_(std::move(files.ignored)) {
    companions_ = {source.folder, std::move(files.files)};
  }

  std::vector<std::string> beyond_attributes() const override {
    const Source source = this->source();
    TextCursor text(source, obj_rules);
    std::size_t lines = 0, points = 0, others = 0;
    bool smoothing = false;
    for (; text.next_filled_line(); text.next_line()) {
      const std::string_view word = text.word();
      const ObjWord kind = obj_word(word);
      smoothing |= kind == ObjWord::smoothing;
      if (kind != ObjWord::other && kind != ObjWord::free_form) continue;
      ++(word == "l" || word == "L" ? lines : word == "p" || word == "P" ? points : others);
    }
    std::vector<std::string> found(ignored_.begin(), ignored_.end());
    if (smoothing) found.emplace_back("smoothing groups");
    if (has_comments(bytes_)) found.emplace_back("comments");
    if (lines > 0) found.push_back(base::counted(lines, "line"));
    if (points > 0) found.push_back(base::counted(points, "point"));
    if (others > 0) found.push_back(base::counted(others, "statement") + " of curves, surfaces and display");
    return found;
  }

  std::vector<std::string> write(const Content& content, TextWriter& out) const override {
    const Source source = this->source();
    ObjRewriter rewriter(source, content.surface, content.positions, out);
    if (attributes_ && !attributes_->corner_normal.empty())
      rewriter.with_normals(*attributes_, normal_blocks_);
    rewriter.run();
    return {};
  }

private:
  std::shared_ptr<const Attributes> attributes_;
  std::vector<std::uint32_t> normal_blocks_;
  std::set<std::string> ignored_;  // statements of maps that are not read
};

// Writes the statements before the first polygon of each group that differs from the previous group.
class GroupStatements {
public:
  GroupStatements(const Attributes& attributes, bool with_materials)
      : groups_(attributes.groups), materials_(attributes.materials), with_materials_(with_materials) {}

  void before(std::size_t polygon, TextWriter& out) {
    if (next_ == groups_.size() || groups_[next_].first_polygon != polygon) return;
    const Group& group = groups_[next_++];
    if (group.object != now_.object) out.text("o ").text(name_in_library(group.object)).text("\n");
    if (group.name != now_.name) out.text("g ").text(name_in_library(group.name)).text("\n");
    if (with_materials_ && group.material != now_.material && group.material != mesh::none)
      out.text("usemtl ").text(materials_[group.material].name).text("\n");
    if (group.smooth != now_.smooth) out.text(group.smooth ? "s 1\n" : "s off\n");
    now_ = group;
  }

private:
  const std::vector<Group>& groups_;
  const std::vector<Material>& materials_;
  bool with_materials_;
  std::size_t next_ = 0;
  Group now_;
};

}  // namespace

void write_obj(const Content& content, TextWriter& out) {
  const mesh::Surface& surface = content.surface;
  const Attributes& a = content.given();
  GroupStatements groups(a, !content.library.empty());
  const std::size_t all = content.positions.size() + surface.polygon_count();
  std::size_t done = 0;
  out.comments("# ", content.comments);
  if (!content.library.empty()) out.text("mtllib ").text(content.library).text("\n");
  for (std::size_t v = 0; v < content.positions.size(); ++v) {
    out.text("v ");
    print_point(content.positions[v], out);
    for (std::size_t i = 0; !a.colors.empty() && i < (a.colors[v][3] == 1 ? 3U : 4U); ++i)
      out.text(" ").number(a.colors[v][i]);
    out.text("\n").element_done(++done, all);
  }
  for (const Vec2& t : a.texture_points)
    out.text("vt ").number(t[0]).text(" ").number(t[1]).text("\n").element_done(done, all);
  for (const mesh::Vec3& n : a.normals) out.text("vn ").point(n).text("\n").element_done(done, all);
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    groups.before(p, out);
    out.text("f");
    for (auto c = surface.polygon_starts[p]; c < surface.polygon_starts[p + 1]; ++c) {
      const std::uint32_t texture = a.corner_texture.empty() ? mesh::none : a.corner_texture[c];
      const std::uint32_t normal = a.corner_normal.empty() ? mesh::none : a.corner_normal[c];
      out.text(" ").number(std::uint64_t{surface.corners[c]} + 1);
      if (texture != mesh::none || normal != mesh::none) out.text("/");
      if (texture != mesh::none) out.number(std::uint64_t{texture} + 1);
      if (normal != mesh::none) out.text("/").number(std::uint64_t{normal} + 1);
    }
    out.text("\n").element_done(++done, all);
  }
}

std::shared_ptr<const Original> obj_original(const Source& source,
                                             std::shared_ptr<const Attributes> attributes,
                                             std::vector<std::uint32_t> normal_blocks, MaterialFiles files) {
  return std::make_shared<const ObjOriginal>(source, std::move(attributes), std::move(normal_blocks),
                                             std::move(files));
}

}  // namespace viete::formats
