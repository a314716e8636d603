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
#include "mesh/ply_header.h"
#include "mesh/source.h"
#include "mesh/text_cursor.h"

namespace viete::mesh {

/// Values are words; a row ends with its line.
class PlyTextValues {
public:
  explicit PlyTextValues(const TextCursor& text) : text_(text) {}

  void start_row(std::string_view element, std::size_t) {
    text_.need_word("the last " + std::string(element));
  }
  void end_row() {
    if (!text_.at_line_end())
      text_.fail("more values than the header's properties", "export the model again");
  }
  double coordinate(PlyType) { return next().coordinate(); }
  std::int64_t integer(PlyType) { return next().integer("whole number"); }
  /// Where the value stands.
  std::string_view skip(PlyType) { return next().word(); }
  /// Of a value that stands there; 0 where that is no number.
  double value_of(PlyType, std::string_view place) const { return number_in(place).value_or(0); }
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
  double value_of(PlyType type, std::string_view place) const {
    const double value = take(type, place.data());
    return std::isfinite(value) ? value : 0;
  }
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
