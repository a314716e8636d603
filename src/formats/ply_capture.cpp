#include "formats/ply_capture.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "base/worker_pool.h"

namespace viete::formats {

namespace {

// Returns the largest degree, at most 3, whose harmonics are all among this number of harmonics.
int whole_degree(std::size_t harmonics) {
  return harmonics >= 15 ? 3 : harmonics >= 8 ? 2 : harmonics >= 3 ? 1 : 0;
}

// The rows of the vertices in the file.
class Rows {
public:
  Rows(const PlyCaptureFile& file, std::string_view bytes)
      : bytes_(bytes), first_(file.first_row), row_bytes_(file.vertices.row_bytes()) {
    const std::size_t count = file.vertices.count;
    end_ = first_ + count * row_bytes_;
    if (!file.form.text) return;
    const Source rest{"", "", bytes.substr(first_)};
    TextCursor text(rest, {});
    for (std::size_t row = 0; row < count; ++row) {
      text.next_filled_line();
      starts_.push_back(first_ + text.offset());
      for (std::size_t p = 0; p < file.vertices.properties.size(); ++p) {
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
  std::size_t first_, row_bytes_, end_ = 0;
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
  RowWriter(const PlyCaptureFile& file, const std::string& name, std::string_view bytes,
            const Content& content, TextWriter& out)
      : file_(file), name_(name), rows_(file, bytes), content_(content), out_(out), printed_(out.digits()) {
    const PlyElement& vertices = file.vertices;
    for (const char* axis : {"x", "y", "z"}) axes_.push_back(vertices.find(axis));
    for (std::size_t p = 0; p < vertices.properties.size(); ++p)
      offsets_.push_back(file.form.text ? 0 : vertices.bytes_before(p));
    if (content.splats) now_ = splat_columns(*content.splats);
    before_ = splat_columns(*file.splats);
    printed_.keep(6, mesh::bounds(content.surface.positions).diagonal());
    if (file.form.text) learn();
  }

  void write_all() {
    const std::size_t count = content_.positions.size();
    for (std::size_t v = 0; v < count; ++v) {
      const std::size_t source = content_.sources.empty() ? v : content_.sources[v];
      find_changes(v, source);
      const std::string_view row = rows_[source];
      file_.form.text ? write_text(row, source) : write_binary(row, source);
      // The line end of the last row may be missing.
      const bool ended = source + 1 < file_.vertices.count || row.ends_with('\n') || row.ends_with('\r');
      if (file_.form.text && !ended && v + 1 < count) out_.text("\n");
      out_.element_done(v + 1, count);
    }
  }

  std::size_t end() const { return rows_.end(); }
  double rounding() const { return rounding_; }

private:
  base::NumberType type(std::size_t property) const { return file_.vertices.properties[property].type; }

  void learn() {
    constexpr std::size_t enough = 10'000;
    for (std::size_t row = 0; row < std::min(enough, file_.vertices.count); ++row) {
      const Source source{"", "", rows_[row]};
      TextCursor text(source, {});
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
      const std::size_t property = file_.found.properties[c];
      if (now != before_[c][source] && std::isfinite(now) && property < offsets_.size())
        changes_.push_back({property, now, false});
    }
    std::ranges::sort(changes_, {}, &Change::property);
  }

  std::string_view written(const Change& change, std::size_t source) {
    const base::NumberType type = this->type(change.property);
    const bool all_digits = !change.is_position && out_.digits().kind != Digits::Kind::decimals;
    if (file_.form.text && all_digits &&
        (type == base::NumberType::float32 || type == base::NumberType::float64)) {
      char* const end = std::to_chars(room_.data(), room_.data() + room_.size(), float(change.value)).ptr;
      return {room_.data(), static_cast<std::size_t>(end - room_.data())};
    }
    const auto words = number_in_file(change.value, type, file_.form, printed_, room_);
    if (!words)
      throw base::Error(Source{name_, "", ""}.place(file_.vertices.name, source),
                        "the new value of " + file_.vertices.properties[change.property].name +
                            " exceeds the range of its number type in this file",
                        "save in another format, or scale the model");
    if (change.is_position && type == base::NumberType::float32)
      rounding_ = std::max(rounding_, std::abs(static_cast<float>(change.value) - change.value));
    return *words;
  }

  void write_binary(std::string_view row, std::size_t source) {
    row_ = row;
    for (const Change& change : changes_) {
      const std::string_view bytes = written(change, source);
      row_.replace(offsets_[change.property], bytes.size(), bytes);
    }
    out_.text(row_);
  }

  void write_text(std::string_view row, std::size_t source) {
    const Source words{"", "", row};
    TextCursor text(words, {});
    std::size_t property = 0, copied = 0;
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

  const PlyCaptureFile& file_;
  const std::string& name_;
  Rows rows_;
  const Content& content_;
  TextWriter& out_;
  Printed printed_;                   // of positions
  std::vector<std::size_t> axes_;     // properties x, y, z
  std::vector<std::size_t> offsets_;  // of each property in a binary row
  std::vector<SplatColumn<const float>> before_, now_;
  std::vector<Change> changes_;  // of the current row, in the order of properties
  std::string row_;
  std::array<char, 400> room_;
  double rounding_ = 0;
};

class PlyCaptureOriginal final : public Original {
public:
  PlyCaptureOriginal(const Source& source, PlyCaptureFile file)
      : Original("PLY", source), file_(std::move(file)) {}

  std::vector<std::string> beyond_attributes() const override { return file_.beyond_attributes; }
  Capture capture() const override { return Capture::splats; }

  std::vector<std::string> write(const Content& content, TextWriter& out) const override {
    Rewriter rewriter(bytes_, out);
    if (content.is_at_rest() && !content.splats) {
      rewriter.finish();
      return {};
    }
    RowWriter rows(file_, name_, bytes_, content, out);
    if (!content.sources.empty())
      rewriter.replace(count_in_header(), std::to_string(content.positions.size()));
    rewriter.copy_until(file_.first_row);
    rows.write_all();
    rewriter.skip_until(rows.end());
    rewriter.finish();
    std::string note = rounding_note(rows.rounding(), mesh::bounds(content.positions).diagonal());
    if (note.empty()) return {};
    return {std::move(note)};
  }

private:
  // Returns the word of the number of vertices.
  std::string_view count_in_header() const {
    const Source source = this->source();
    for (TextCursor text(source, {}); text.next_filled_line(); text.next_line())
      if (text.word() == "element" && text.word() == "vertex") return text.word();
    return {};
  }

  PlyCaptureFile file_;
};

}  // namespace

PlySplats::PlySplats(const PlyElement& vertices) {
  const auto has = [&](const std::string& name) { return vertices.find(name) < vertices.properties.size(); };
  std::size_t harmonics = 0;
  while (has("f_rest_" + std::to_string(harmonics))) ++harmonics;
  const std::size_t in_file = harmonics % 3 == 0 ? harmonics / 3 : 0;
  degree = whole_degree(in_file);
  const auto bands = static_cast<std::size_t>(degree * (degree + 2));
  for (const std::string& name : splat_names(bands, in_file)) properties.push_back(vertices.find(name));
  if (3 * bands != harmonics)
    notes.push_back("the capture has " + std::to_string(harmonics) +
                    " properties f_rest_* instead of 0, 9, 24 or 45: harmonics above degree " +
                    std::to_string(degree) + " are kept, but neither drawn nor turned");
  if (!has("f_dc_0") || !has("f_dc_1") || !has("f_dc_2"))
    notes.emplace_back("the capture has no colours (f_dc_0 to f_dc_2): its splats are grey");
}

mesh::Splats PlySplats::allocate(const std::string& file, std::size_t count) const {
  mesh::Splats splats;
  splats.degree = degree;
  base::require_memory({static_cast<double>(sizeof(float) * properties.size() * count),
                        base::counted(count, "splat") + " take",
                        "use a computer with more memory, or remove splats in another program", file});
  splats.resize(count);
  return splats;
}

void read_splats(const PlySplats& found, const PlyElement& vertices, std::string_view rows, std::endian order,
                 mesh::Splats& splats) {
  const auto columns = splat_columns(splats);
  const std::size_t row_bytes = vertices.row_bytes();
  base::for_blocks(
      splats.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
          if (found.properties[c] == vertices.properties.size()) continue;
          const char* const first = rows.data() + vertices.bytes_before(found.properties[c]);
          with_type(vertices.properties[found.properties[c]].type, [&](auto number) {
            for (std::size_t v = begin; v < end; ++v)
              columns[c][v] =
                  static_cast<float>(base::number_of_bytes<decltype(number)>(first + v * row_bytes, order));
          });
        }
      },
      1 << 12);
}

std::shared_ptr<const Original> original_of_capture(const Source& source, PlyCaptureFile file) {
  return source.owner ? std::make_shared<const PlyCaptureOriginal>(source, std::move(file)) : nullptr;
}

}  // namespace viete::formats
