// Conversion of numbers to and from bytes in either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace viete::mesh {

/// Reads the first bytes as a number of type T.
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

}  // namespace viete::mesh
