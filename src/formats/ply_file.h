// A parsed PLY file: the header, a reader of the values in text or binary, and the numbers of Gaussian
// splats.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/byte_order.h"
#include "formats/original.h"
#include "formats/source.h"
#include "formats/surface_builder.h"
#include "formats/text_cursor.h"
#include "mesh/splats.h"

namespace viete::formats {

struct PlyProperty {
  std::string name;
  base::NumberType type = base::NumberType::float32;  ///< type of the value, or of the items of a list
  std::optional<base::NumberType> list_size;  ///< type of the list's length; nullopt for a single value
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  /// Returns the index of the first property with one of these names, or properties.size().
  std::size_t find(const std::string& name, const std::string& other = "") const;
  /// Number of bytes of each row in a binary file. If rows contain lists, returns 0.
  std::size_t row_bytes() const { return bytes_before(properties.size()); }
  /// Number of bytes of each row before this property. If rows contain lists, returns 0.
  std::size_t bytes_before(std::size_t property) const;
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian };

  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> texture_files;  ///< from `comment TextureFile` lines, as MeshLab writes them
  std::size_t unknown_lines = 0;           ///< number of skipped lines
  bool has_comments = false, has_obj_info = false;

  std::endian order() const { return format == Format::big_endian ? std::endian::big : std::endian::little; }
  const PlyElement* find(const std::string& name) const;
  Capture capture() const;
  /// Names the content that Attributes does not store; see Original::beyond_attributes().
  std::vector<std::string> beyond_attributes() const;
};

/// Moves the cursor past the header. Adds comments to the builder. Skips lines without a header keyword and
/// adds a warning. If the declared elements do not fit in the rest of the file, throws base::Error.
PlyHeader read_ply_header(TextCursor& text, const Source& source, SurfaceBuilder& builder);

/// Reads the values of the body one after the other. In text, a value is a word and a row is a line. Errors
/// in text files contain the line; errors in binary files contain the element and its index.
class PlyValues {
public:
  /// `text` must be at the start of the body.
  PlyValues(const Source& source, const PlyHeader& header, const TextCursor& text)
      : source_(source),
        text_(text),
        at_(source.bytes.substr(text.offset())),
        is_text_(header.format == PlyHeader::Format::ascii),
        order_(header.order()) {}

  void start_row(std::string_view element, std::size_t index) {
    element_ = element;
    index_ = index;
    if (is_text_) text_.need_word("the last " + std::string(element));
  }
  /// Text only: if the line has more values, skips these values and counts the line for longer_rows().
  void end_row() {
    if (!is_text_ || text_.at_line_end()) return;
    if (longer_rows_++ == 0) first_longer_ = text_.line();
    text_.next_line();
  }
  std::string place_of_longer() const { return text_.place(first_longer_); }
  std::size_t longer_rows() const { return longer_rows_; }

  /// Returns the offset of the next value in the file.
  std::size_t place() { return is_text_ ? next_word().offset() : source_.bytes.size() - at_.size(); }
  double coordinate(base::NumberType type);
  std::int64_t integer(base::NumberType type);
  /// Returns NaN or infinity if the value is not a finite number.
  double value(base::NumberType type);
  void skip(base::NumberType type) { next(type); }

  /// Returns the rest of a binary body, or nothing for text.
  std::string_view bytes() const { return is_text_ ? std::string_view() : at_; }
  void skip_bytes(std::size_t count) { at_.remove_prefix(count); }

  std::size_t most_values(base::NumberType type) const {
    return is_text_ ? text_.bytes_left() / 2 + 1 : at_.size() / size_of(type);
  }
  double done() const {
    if (is_text_) return text_.done();
    return 1 - static_cast<double>(at_.size()) / static_cast<double>(source_.bytes.size());
  }
  [[noreturn]] void fail(const std::string& problem,
                         const std::string& advice = "export the model again") const;

private:
  TextCursor& next_word() {
    text_.need_word("the last value");
    return text_;
  }
  std::string_view next(base::NumberType type);

  const Source& source_;
  TextCursor text_;
  std::string_view at_;  // the rest of a binary body
  bool is_text_;
  std::endian order_;
  std::string_view element_;
  std::size_t index_ = 0;
  std::size_t longer_rows_ = 0, first_longer_ = 0;
};

/// One number of each splat.
template <class Float>
struct SplatColumn {
  Float* first = nullptr;
  std::size_t stride = 0;

  Float& operator[](std::size_t splat) const { return first[splat * stride]; }
};

/// Returns the columns f_dc_0 to 2, f_rest_*, opacity, scale_0 to 2, rot_0 to 3. Without splats, returns
/// none.
template <class Splats>
auto splat_columns(Splats& splats) {
  using Float = std::conditional_t<std::is_const_v<Splats>, const float, float>;
  std::vector<SplatColumn<Float>> columns;
  if (splats.size() == 0) return columns;
  const auto add = [&](Float* first, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) columns.push_back({first + k, count});
  };
  add(splats.colors[0].data(), 3);
  if (splats.degree > 0) add(splats.harmonics.data(), 3 * splats.bands());
  add(splats.opacities.data(), 1);
  add(splats.log_scales[0].data(), 3);
  add(splats.rotations[0].data(), 4);
  return columns;
}

/// Returns the names of splat_columns() in a file with `in_file` harmonics for each colour, at least `bands`.
std::vector<std::string> splat_names(std::size_t bands, std::size_t in_file);

/// The properties that store splats.
struct PlySplats {
  int degree = 0;
  /// For each column its property, or the number of properties if missing.
  std::vector<std::size_t> properties;
  std::vector<std::string> notes;  ///< about missing colours and incomplete harmonics

  /// The header must satisfy capture() == Capture::splats.
  explicit PlySplats(const PlyElement& vertices);

  /// Allocates splats with all numbers 0. Throws base::Error if memory is short.
  mesh::Splats allocate(const std::string& file, std::size_t count) const;
};

/// Reads the numbers of binary rows on all processors. `rows` must be complete.
void read_splats(const PlySplats& found, const PlyElement& vertices, std::string_view rows, std::endian order,
                 mesh::Splats& splats);

/// Returns an original of a capture. Rewriting changes x y z and the numbers that differ from `splats`.
/// `first_row` is the offset of the first vertex. Returns null if source.owner is null.
std::shared_ptr<const Original> original_of_capture(const Source& source, PlyHeader header,
                                                    std::size_t first_row,
                                                    std::shared_ptr<const mesh::Splats> splats);

}  // namespace viete::formats
