// The values of a PLY file's body one after the other, from text or from bytes: same interface, no common
// base.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "base/error.h"
#include "mesh/formats/ply_header.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_cursor.h"

namespace viete::mesh {

/// Values are words; a row ends with its line.
class PlyTextValues {
public:
  explicit PlyTextValues(const TextCursor& text) : text_(text) {}

  void start_row(std::string_view element, std::size_t) {
    text_.need_word("the last " + std::string(element));
  }
  /// What a line holds beyond that is passed over, and counted.
  void end_row() {
    if (text_.at_line_end()) return;
    if (longer_rows_++ == 0) first_longer_ = text_.line();
    text_.next_line();
  }
  std::string place_of_longer() const { return text_.place(first_longer_); }
  std::size_t longer_rows() const { return longer_rows_; }
  double coordinate(PlyType) { return next().coordinate(); }
  std::int64_t integer(PlyType) { return next().integer("whole number"); }
  /// Where the value stands.
  std::string_view skip(PlyType) { return next().word(); }
  /// Of a value that stands there; NaN or an infinity where that is no finite number.
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

/// Values are bytes; a place is the element's name and number.
class PlyBinaryValues {
public:
  PlyBinaryValues(const Source& source, std::size_t start, std::endian order)
      : source_(&source), at_(source.bytes.substr(start)), swap_(order != std::endian::native) {}

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
    if (at_.size() < size) fail("the file ends here", "it seems to be cut short: export or copy it again");
    const char* const from = at_.data();
    at_.remove_prefix(size);
    return from;
  }

  template <class T>
  double as(const char* from) const {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), from, sizeof(T));
    if (swap_) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  double take(PlyType type) { return take(type, bytes(size_of(type))); }
  double take(PlyType type, const char* from) const {
    switch (type) {
      case PlyType::int8: return as<std::int8_t>(from);
      case PlyType::uint8: return as<std::uint8_t>(from);
      case PlyType::int16: return as<std::int16_t>(from);
      case PlyType::uint16: return as<std::uint16_t>(from);
      case PlyType::int32: return as<std::int32_t>(from);
      case PlyType::uint32: return as<std::uint32_t>(from);
      case PlyType::int64: return as<std::int64_t>(from);
      case PlyType::uint64: return as<std::uint64_t>(from);
      case PlyType::float32: return as<float>(from);
      case PlyType::float64: return as<double>(from);
    }
    return 0;
  }

  const Source* source_;
  std::string_view at_;
  bool swap_;
  std::string_view element_;
  std::size_t index_ = 0;
};

}  // namespace viete::mesh
