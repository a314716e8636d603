#include "base/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdarg>
#include <cstdio>

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

// Makes control characters visible. In UTF-8, the control characters 0x80 to 0x9F have two bytes.
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

std::string cut(std::string_view text, std::size_t most) {
  while (most > 0 && within_letter(text, most)) --most;
  return std::string(text.substr(0, most));
}

std::string printable(std::string_view text, std::size_t most) {
  if (text.size() <= most) return visible(text);
  std::size_t head = most / 2, tail = text.size() - most / 2;
  while (head > 0 && within_letter(text, head)) --head;
  while (within_letter(text, tail)) ++tail;
  return visible(text.substr(0, head)) + " ... " + visible(text.substr(tail));
}

std::string formatted(const char* format, ...) {
  char text[512];  // enough for every double without exponent
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::string with_thousands(std::size_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string joined(std::span<const std::string> texts, std::string_view separator, std::size_t most) {
  std::string all;
  for (const std::string& text : texts.first(std::min(most, texts.size())))
    all.append(&text == texts.data() ? "" : separator).append(text);
  return texts.size() > most ? all + " ..." : all;
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string listed(std::span<const std::string> texts, std::string_view last) {
  if (texts.size() < 2) return joined(texts);
  return joined(texts.first(texts.size() - 1)).append(last) + texts.back();
}

std::string memory_size(double bytes) {
  const double megabytes = std::max(1.0, bytes * 1e-6);
  return megabytes < 999.5 ? formatted("%.0f MB", megabytes) : formatted("%.1f GB", megabytes * 1e-3);
}

std::string few_digits(double value) {
  const double a = std::abs(value);
  if (a < 9.995) return formatted("%.2f", value);
  return formatted(a < 99.95 ? "%.1f" : "%.0f", value);
}

std::string milliseconds(double ms) {
  return std::abs(ms) < 999.5 ? few_digits(ms) + " ms" : few_digits(ms * 1e-3) + " s";
}

std::string nanoseconds(double ns) {
  return std::abs(ns) < 999.5 ? few_digits(ns) + " ns" : few_digits(ns * 1e-3) + " us";
}

}  // namespace viete::base
