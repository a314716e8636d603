#include "base/encoding.h"

#include <algorithm>
#include <charconv>
#include <cstring>

namespace viete::base {

namespace {

constexpr std::string_view base64_letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int, 256> base64_values = [] {
  std::array<int, 256> table{};
  for (int& value : table) value = -1;
  for (std::size_t i = 0; i < 64; ++i)
    table[static_cast<unsigned char>(base64_letters[i])] = static_cast<int>(i);
  return table;
}();

// Combines two words. If only one of the words changes, the result always changes.
std::uint64_t mix(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * 0x9e3779b97f4a7c15;  // 2^64 divided by the golden ratio, as an odd number
  return state ^ state >> 32;
}

}  // namespace

std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(k <= n ? base64_letters[bits >> (18 - 6 * k) & 63] : '=');
  }
  return text;
}

std::optional<std::string> bytes_of_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int value = base64_values[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) bytes.push_back(static_cast<char>(bits >> (count -= 8)));
  }
  return bytes;
}

std::string percent_encoded(std::string_view bytes, bool (*is_plain)(char)) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_plain(c)) {
      text += c;
    } else {
      text += {'%', digits[byte >> 4], digits[byte & 15]};
    }
  }
  return text;
}

std::string percent_decoded(std::string_view text, bool* whole) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned byte = 0;
    const char* const end = text.data() + std::min(i + 3, text.size());
    const bool coded = text[i] == '%' && i + 2 < text.size() &&
                       std::from_chars(text.data() + i + 1, end, byte, 16).ptr == end;
    if (text[i] == '%' && !coded && whole) *whole = false;
    bytes += coded ? static_cast<char>(byte) : text[i];
    if (coded) i += 2;
  }
  return bytes;
}

// Multiplies in four independent chains, so that the processor can run four multiplications at a time.
void Checksum::add(const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  for (std::size_t left = size; left > 0;) {
    std::array<std::uint64_t, 4> words{};
    const std::size_t taken = std::min(left, sizeof words);
    std::memcpy(words.data(), at, taken);
    for (std::size_t i = 0; i < words.size(); ++i) lanes_[i] = mix(lanes_[i], words[i]);
    at += taken;
    left -= taken;
  }
  lanes_[0] = mix(lanes_[0], size);
}

std::uint64_t Checksum::value() const {
  std::uint64_t value = 0;
  for (const auto lane : lanes_) value = mix(value, lane);
  return value;
}

}  // namespace viete::base
