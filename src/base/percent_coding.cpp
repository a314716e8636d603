#include "base/percent_coding.h"

#include <algorithm>
#include <charconv>

namespace viete::base {

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

}  // namespace viete::base
