// A parsed PLY file: its header and a reader of its values, text or binary.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "mesh/formats/byte_order.h"
#include "mesh/formats/source.h"
#include "mesh/formats/surface_builder.h"
#include "mesh/formats/text_cursor.h"

namespace viete::mesh {

enum class PlyType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

/// Calls use(number) with a number of this type.
template <class Use>
auto with_type(PlyType type, const Use& use) {
  switch (type) {
    case PlyType::int8: return use(std::int8_t{});
    case PlyType::uint8: return use(std::uint8_t{});
    case PlyType::int16: return use(std::int16_t{});
    case PlyType::uint16: return use(std::uint16_t{});
    case PlyType::int32: return use(std::int32_t{});
    case PlyType::uint32: return use(std::uint32_t{});
    case PlyType::int64: return use(std::int64_t{});
    case PlyType::uint64: return use(std::uint64_t{});
    case PlyType::float32: return use(float{});
    case PlyType::float64: break;
  }
  return use(double{});
}

/// Bytes of one value in a binary file.
inline std::size_t size_of(PlyType type) {
  return with_type(type, [](auto number) { return sizeof number; });
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;   ///< type of the value or of list items
  std::optional<PlyType> list_size;  ///< type of the list's length; empty for a single value
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of the first property with one of these names, or properties.size().
  std::size_t find(const std::string& name, const std::string& other = "") const;
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian };

  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> texture_files;  ///< from `comment TextureFile` lines, as MeshLab writes them
  std::size_t unknown_lines = 0;           ///< skipped lines

  const PlyElement* find(const std::string& name) const;
};

/// Moves the cursor past the header. Comments go to the builder; lines without a header keyword are skipped
/// with a warning. Throws base::Error also if the declared elements exceed the rest of the file.
PlyHeader read_ply_header(TextCursor& text, const Source& source, SurfaceBuilder& builder);

/// Reads the values of a text body in sequence. A value is a word; a row is a line.
class PlyTextValues {
public:
  explicit PlyTextValues(const TextCursor& text) : text_(text) {}

  void start_row(std::string_view element, std::size_t) {
    text_.need_word("the last " + std::string(element));
  }
  /// Skips and counts extra values of the line.
  void end_row() {
    if (text_.at_line_end()) return;
    if (longer_rows_++ == 0) first_longer_ = text_.line();
    text_.next_line();
  }
  std::string place_of_longer() const { return text_.place(first_longer_); }
  std::size_t longer_rows() const { return longer_rows_; }
  double coordinate(PlyType) { return next().coordinate(); }
  std::int64_t integer(PlyType) { return next().integer("whole number"); }
  /// The text of the value.
  std::string_view skip(PlyType) { return next().word(); }
  /// The value of that text; NaN or infinity if it is not a finite number.
  double value_of(PlyType, std::string_view place) const { return number_in(place).value_or(std::nan("")); }
  std::size_t most_values(PlyType) const { return text_.bytes_left() / 2 + 1; }
  double done() const { return text_.done(); }
  [[noreturn]] void fail(const std::string& problem, const std::string& advice) const {
    text_.fail(problem, advice);
  }

private:
  TextCursor& next() {
    text_.need_word("the last value");
    return text_;
  }

  TextCursor text_;
  std::size_t longer_rows_ = 0, first_longer_ = 0;
};

/// The interface of PlyTextValues for binary bodies. Errors name the element and its number.
class PlyBinaryValues {
public:
  PlyBinaryValues(const Source& source, std::size_t start, std::endian order)
      : source_(&source), at_(source.bytes.substr(start)), order_(order) {}

  void start_row(std::string_view element, std::size_t index) {
    element_ = element;
    index_ = index;
  }
  void end_row() {}
  std::string place_of_longer() const { return {}; }
  std::size_t longer_rows() const { return 0; }

  double coordinate(PlyType type) {
    const double value = take(type);
    if (!(std::abs(value) <= largest_coordinate))
      fail("a coordinate is not a finite number up to 1e100", "repair the vertex");
    return value;
  }

  std::int64_t integer(PlyType type) {
    const double value = take(type);
    if (!(std::abs(value) < 9e15) || value != std::floor(value))
      fail("a value is not a whole number", "export again");
    return static_cast<std::int64_t>(value);
  }

  std::string_view skip(PlyType type) { return {bytes(size_of(type)), size_of(type)}; }
  double value_of(PlyType type, std::string_view place) const { return take(type, place.data()); }
  std::size_t most_values(PlyType type) const { return at_.size() / size_of(type); }
  double done() const {
    return 1 - static_cast<double>(at_.size()) / static_cast<double>(source_->bytes.size());
  }
  [[noreturn]] void fail(const std::string& problem, const std::string& advice) const {
    throw base::Error(source_->place(element_, index_), problem, advice);
  }

private:
  const char* bytes(std::size_t size) {
    if (at_.size() < size) fail("the file ends here", "it seems to be truncated: export or copy it again");
    const char* const from = at_.data();
    at_.remove_prefix(size);
    return from;
  }

  double take(PlyType type) { return take(type, bytes(size_of(type))); }
  double take(PlyType type, const char* from) const {
    return with_type(type, [&](auto number) {
      return static_cast<double>(number_of_bytes<decltype(number)>(from, order_));
    });
  }

  const Source* source_;
  std::string_view at_;
  std::endian order_;
  std::string_view element_;
  std::size_t index_ = 0;
};

}  // namespace viete::mesh
