// Converts numbers to bytes and back, in little-endian or big-endian order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace viete::base {

/// Reads the first sizeof(T) bytes as a number.
template <class T>
T number_of_bytes(const char* bytes, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::ranges::reverse(raw);
  return std::bit_cast<T>(raw);
}

template <class T>
auto bytes_of_number(T value, std::endian order = std::endian::little) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::ranges::reverse(raw);
  return raw;
}

/// Types of the numbers in a file.
enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Calls use(x), where x is 0 and has the C++ type for `type`. Returns the result of use(x).
template <class Use>
auto with_type(NumberType type, const Use& use) {
  switch (type) {
    case NumberType::int8: return use(std::int8_t{});
    case NumberType::uint8: return use(std::uint8_t{});
    case NumberType::int16: return use(std::int16_t{});
    case NumberType::uint16: return use(std::uint16_t{});
    case NumberType::int32: return use(std::int32_t{});
    case NumberType::uint32: return use(std::uint32_t{});
    case NumberType::int64: return use(std::int64_t{});
    case NumberType::uint64: return use(std::uint64_t{});
    case NumberType::float32: return use(float{});
    case NumberType::float64: break;
  }
  return use(double{});
}

inline std::size_t size_of(NumberType type) {
  return with_type(type, [](auto number) { return sizeof number; });
}

inline double number_of_bytes(const char* bytes, NumberType type, std::endian order) {
  return with_type(type, [&](auto number) {
    return static_cast<double>(number_of_bytes<decltype(number)>(bytes, order));
  });
}

}  // namespace viete::base
