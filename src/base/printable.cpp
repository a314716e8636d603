#include "base/printable.h"

namespace viete::base {

namespace {

bool within_letter(std::string_view text, std::size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;
}

void append_visible(unsigned char code, std::string& line) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  if (code == '\n') {
    line += "\\n";
  } else {
    line.append({'\\', 'x', digits[code >> 4], digits[code & 15]});
  }
}

// Those of 0x80 to 0x9F are two bytes in UTF-8.
std::string visible(std::string_view text) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]),
               next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (c < 32 || c == 127) {
      append_visible(c, line);
    } else if (c == 0xC2 && next >= 0x80 && next < 0xA0) {
      append_visible(next, line);
      ++i;
    } else {
      line.push_back(text[i]);
    }
  }
  return line;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  if (text.size() <= most) return visible(text);
  std::size_t head = most / 2, tail = text.size() - most / 2;
  while (head > 0 && within_letter(text, head)) --head;
  while (within_letter(text, tail)) ++tail;
  return visible(text.substr(0, head)) + " ... " + visible(text.substr(tail));
}

}  // namespace viete::base
