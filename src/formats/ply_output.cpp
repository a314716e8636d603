// Writes PLY: a surface or capture as a new file, or the capture that was read, with other splats.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/error.h"
#include "formats/codecs.h"
#include "formats/file_vectors.h"
#include "formats/ply_file.h"

namespace viete::formats {

namespace {

// If any vertex has several texture points, writes texture points for faces, otherwise for vertices.
class PlyOutput {
public:
  PlyOutput(const Content& content, TextWriter& out)
      : s_(content.surface), positions_(content.positions), a_(content.given()), out_(out) {
    if (!a_.corner_normal.empty()) normals_ = one_a_vertex(s_, a_.corner_normal);
    if (!a_.corner_texture.empty()) texture_ = one_a_vertex(s_, a_.corner_texture);
    faces_textured_ = !a_.corner_texture.empty() && !texture_;
    // The length of a list is one byte. Lists of texture points have two numbers for each corner.
    const std::uint32_t most = faces_textured_ ? 127 : 255;
    for (std::size_t p = 0; p < s_.polygon_count(); ++p)
      large_ |= s_.polygon_starts[p + 1] - s_.polygon_starts[p] > most;
    number_images();
  }

  void header() {
    const char* const length = large_ ? "uint" : "uchar";
    for (const std::uint32_t image : images_)
      out_.text("comment TextureFile ").text(a_.images[image].name).text("\n");
    out_.text("element vertex ").number(std::uint64_t{positions_.size()});
    out_.text("\nproperty double x\nproperty double y\nproperty double z\n");
    if (normals_) out_.text("property float nx\nproperty float ny\nproperty float nz\n");
    if (!a_.colors.empty()) color_header();
    if (texture_) out_.text("property float s\nproperty float t\n");
    out_.text("element face ").number(std::uint64_t{s_.polygon_count()});
    out_.text("\nproperty list ").text(length).text(" uint vertex_indices\n");
    if (faces_textured_) out_.text("property list ").text(length).text(" float texcoord\n");
    if (!a_.polygon_colors.empty()) color_header();
    if (!images_.empty()) out_.text("property int texnumber\n");
    out_.text("end_header\n");
  }

  void vertex(std::size_t v) {
    for (const double x : positions_[v]) out_.little_endian(x);
    if (normals_) floats((*normals_)[v] == mesh::none ? mesh::Vec3{0, 0, 0} : a_.normals[(*normals_)[v]]);
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
    while (group_ + 1 < a_.groups.size() && a_.groups[group_ + 1].first_polygon <= p) ++group_;
    if (!images_.empty()) out_.little_endian(numbers_[group_]);
  }

private:
  // Lists the images that are used. MeshLab writes their numbers to `texnumber`, and -1 for no image.
  void number_images() {
    std::map<std::uint32_t, std::size_t> numbers;
    for (const Group& group : a_.groups) {
      const std::uint32_t image =
          group.material == mesh::none ? mesh::none : a_.materials[group.material].base_color_image;
      const auto [at, is_new] = numbers.try_emplace(image, images_.size());
      if (is_new && image != mesh::none) images_.push_back(image);
      numbers_.push_back(image == mesh::none ? -1 : static_cast<std::int32_t>(at->second));
    }
  }

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

  void texture_point(std::uint32_t t) { floats(t == mesh::none ? Vec2{0, 0} : a_.texture_points[t]); }

  void length(std::uint32_t n) {
    large_ ? out_.little_endian(n) : out_.little_endian(static_cast<std::uint8_t>(n));
  }

  const mesh::Surface& s_;
  std::span<const mesh::Point> positions_;
  const Attributes& a_;
  TextWriter& out_;
  std::optional<std::vector<std::uint32_t>> normals_, texture_;
  bool faces_textured_ = false, large_ = false;
  std::vector<std::uint32_t> images_;  // indices into Attributes::images, in the order of the header
  std::vector<std::int32_t> numbers_;  // for each group the number of its image, or -1
  std::size_t group_ = 0;              // of the current face
};

void write_capture(const Content& content, TextWriter& out) {
  const std::size_t count = content.positions.size(), bands = content.splats->bands();
  out.text("element vertex ").number(std::uint64_t{count}).text("\n");
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    out.text("property float ").text(name).text("\n");
  for (const std::string& name : splat_names(bands, bands)) out.text("property float ").text(name).text("\n");
  out.text("end_header\n");
  const auto columns = splat_columns(*content.splats);
  for (std::size_t v = 0; v < count; ++v) {
    for (const double x : content.positions[v]) out.little_endian(static_cast<float>(x));
    for (int normal = 0; normal < 3; ++normal) out.little_endian(0.0F);
    for (const auto& column : columns) out.little_endian(column[v]);
    out.element_done(v + 1, count);
  }
}

// A capture to write again.
struct CaptureFile {
  PlyHeader header;
  std::size_t first_row;  // the offset of the first vertex in the file
  std::shared_ptr<const mesh::Splats> splats;
};

// The rows of the vertices in the file.
class Rows {
public:
  Rows(const PlyElement& vertices, bool is_text, std::size_t first_row, std::string_view bytes)
      : bytes_(bytes),
        first_(first_row),
        row_bytes_(vertices.row_bytes()),
        end_(first_row + vertices.count * row_bytes_) {
    if (!is_text) return;
    TextCursor text(bytes.substr(first_));
    for (std::size_t row = 0; row < vertices.count; ++row) {
      text.next_filled_line();
      starts_.push_back(first_ + text.offset());
      for (std::size_t p = 0; p < vertices.properties.size(); ++p) {
        text.next_filled_line();
        text.word();
      }
      text.next_line();
    }
    end_ = first_ + text.offset();
    starts_.push_back(end_);
  }

  std::string_view operator[](std::size_t row) const {
    if (starts_.empty()) return bytes_.substr(first_ + row * row_bytes_, row_bytes_);
    return bytes_.substr(starts_[row], starts_[row + 1] - starts_[row]);
  }
  std::size_t end() const { return end_; }

private:
  std::string_view bytes_;
  std::size_t first_, row_bytes_, end_;
  std::vector<std::size_t> starts_;  // of text
};

// A number of the posed capture.
struct Change {
  std::size_t property;
  double value;
  bool is_position;
};

// Writes rows of vertices with changed numbers.
class RowWriter {
public:
  RowWriter(const CaptureFile& file, const Source& source, const Content& content, TextWriter& out)
      : file_(file),
        source_(source),
        vertices_(*file.header.find("vertex")),
        is_text_(file.header.format == PlyHeader::Format::ascii),
        rows_(vertices_, is_text_, file.first_row, source.bytes),
        content_(content),
        out_(out),
        printed_(out.digits()),
        columns_(PlySplats(vertices_).properties) {
    for (const char* axis : {"x", "y", "z"}) axes_.push_back(vertices_.find(axis));
    for (std::size_t p = 0; p < vertices_.properties.size(); ++p)
      offsets_.push_back(vertices_.bytes_before(p));
    if (content.splats) now_ = splat_columns(*content.splats);
    before_ = splat_columns(*file.splats);
    printed_.keep(6, mesh::bounds(content.surface.positions).diagonal());
    if (is_text_) learn();
  }

  void write_all() {
    const std::size_t count = content_.positions.size();
    for (std::size_t v = 0; v < count; ++v) {
      const std::size_t source = content_.sources.empty() ? v : content_.sources[v];
      find_changes(v, source);
      const std::string_view row = rows_[source];
      is_text_ ? write_text(row, source) : write_binary(row, source);
      // The line end of the last row may be missing.
      const bool ended = source + 1 < vertices_.count || row.ends_with('\n') || row.ends_with('\r');
      if (is_text_ && !ended && v + 1 < count) out_.text("\n");
      out_.element_done(v + 1, count);
    }
  }

  std::size_t end() const { return rows_.end(); }
  double rounding() const { return rounding_; }

private:
  base::NumberType type(std::size_t property) const { return vertices_.properties[property].type; }

  void learn() {
    constexpr std::size_t enough = 10'000;
    for (std::size_t row = 0; row < std::min(enough, vertices_.count); ++row) {
      TextCursor text(rows_[row]);
      for (std::size_t p = 0; p < offsets_.size(); ++p) {
        text.next_filled_line();
        const std::string_view word = text.word();
        if (std::ranges::find(axes_, p) != axes_.end()) printed_.learn(word);
      }
    }
  }

  // Numbers that are not finite keep the number in the file, so that a single invalid splat does not prevent
  // writing the others.
  void find_changes(std::size_t v, std::size_t source) {
    changes_.clear();
    for (std::size_t k = 0; k < 3; ++k) {
      const double now = content_.positions[v][k];
      if (now != content_.surface.positions[source][k]) changes_.push_back({axes_[k], now, true});
    }
    for (std::size_t c = 0; c < now_.size(); ++c) {
      const float now = now_[c][v];
      const std::size_t property = columns_[c];
      if (now != before_[c][source] && std::isfinite(now) && property < offsets_.size())
        changes_.push_back({property, now, false});
    }
    std::ranges::sort(changes_, {}, &Change::property);
  }

  std::string_view written(const Change& change, std::size_t source) {
    const base::NumberType type = this->type(change.property);
    const bool all_digits = !change.is_position && out_.digits().kind != Digits::Kind::decimals;
    if (is_text_ && all_digits && (type == base::NumberType::float32 || type == base::NumberType::float64)) {
      char* const end = std::to_chars(room_.data(), room_.data() + room_.size(), float(change.value)).ptr;
      return {room_.data(), static_cast<std::size_t>(end - room_.data())};
    }
    const auto words = number_in_file(change.value, type, {is_text_, file_.header.order()}, printed_, room_);
    if (!words)
      throw base::Error(source_.place(vertices_.name, source),
                        "the new value of " + vertices_.properties[change.property].name +
                            " exceeds the range of its number type in this file",
                        "save in another format, or scale the model");
    if (change.is_position && type == base::NumberType::float32)
      rounding_ = std::max(rounding_, std::abs(static_cast<float>(change.value) - change.value));
    return *words;
  }

  void write_binary(std::string_view row, std::size_t source) {
    std::size_t copied = 0;  // bytes of the row
    for (const Change& change : changes_) {
      const std::size_t at = offsets_[change.property];
      const std::string_view bytes = written(change, source);
      out_.text(row.substr(copied, at - copied)).text(bytes);
      copied = at + bytes.size();
    }
    out_.text(row.substr(copied));
  }

  void write_text(std::string_view row, std::size_t source) {
    TextCursor text(row);
    std::size_t property = 0, copied = 0;  // the next property, and the copied bytes of the row
    for (const Change& change : changes_) {
      std::string_view word;
      for (; property <= change.property; ++property) {
        text.next_filled_line();
        word = text.word();
      }
      const auto at = static_cast<std::size_t>(word.data() - row.data());
      out_.text(row.substr(copied, at - copied)).text(written(change, source));
      copied = at + word.size();
    }
    out_.text(row.substr(copied));
  }

  const CaptureFile& file_;
  const Source& source_;
  const PlyElement& vertices_;
  bool is_text_;
  Rows rows_;
  const Content& content_;
  TextWriter& out_;
  Printed printed_;                   // of positions
  std::vector<std::size_t> columns_;  // the property of each column
  std::vector<std::size_t> axes_;     // properties x, y, z
  std::vector<std::size_t> offsets_;  // of each property in a binary row
  std::vector<SplatColumn<const float>> before_, now_;
  std::vector<Change> changes_;  // of the current row, in the order of properties
  std::array<char, 400> room_;
  double rounding_ = 0;
};

class PlyCaptureOriginal final : public Original {
public:
  PlyCaptureOriginal(const Source& source, CaptureFile file)
      : Original("PLY", source), file_(std::move(file)) {
    capture_ = Capture::splats;
  }

  std::vector<std::string> beyond_attributes() const override { return file_.header.beyond_attributes(); }

  std::vector<std::string> write(const Content& content, TextWriter& out) const override {
    Rewriter rewriter(bytes_, out);
    if (content.is_at_rest() && !content.splats) {
      rewriter.finish();
      return {};
    }
    const Source source = this->source();
    RowWriter rows(file_, source, content, out);
    if (!content.sources.empty())
      rewriter.replace(count_in_header(), std::to_string(content.positions.size()));
    rewriter.copy_until(file_.first_row);
    rows.write_all();
    rewriter.skip_until(rows.end());
    rewriter.finish();
    return rounding_notes(rows.rounding(), mesh::bounds(content.positions).diagonal());
  }

private:
  // Returns the word of the number of vertices.
  std::string_view count_in_header() const {
    for (TextCursor text(bytes_); text.next_filled_line(); text.next_line())
      if (text.word() == "element" && text.word() == "vertex") return text.word();
    return {};
  }

  CaptureFile file_;
};

}  // namespace

void write_ply(const Content& content, TextWriter& out) {
  out.text("ply\nformat binary_little_endian 1.0\n").comments("comment ", content.comments);
  if (content.splats && content.surface.polygon_count() == 0) return write_capture(content, out);
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

std::shared_ptr<const Original> original_of_capture(const Source& source, PlyHeader header,
                                                    std::size_t first_row,
                                                    std::shared_ptr<const mesh::Splats> splats) {
  if (!source.owner) return nullptr;
  return std::make_shared<const PlyCaptureOriginal>(
      source, CaptureFile{std::move(header), first_row, std::move(splats)});
}

}  // namespace viete::formats
