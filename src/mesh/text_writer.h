// Puts numbers into text so that reading them gives the same bits; independent of the locale.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

class TextWriter {
public:
  TextWriter& text(std::string_view s) {
    out_.append(s);
    return *this;
  }

  /// The shortest digits (17 at most) that read back as the same double.
  TextWriter& number(double value) { return shortest(value); }
  TextWriter& number(std::uint64_t value) { return shortest(value); }

  TextWriter& point(const Point& p) { return number(p[0]).text(" ").number(p[1]).text(" ").number(p[2]); }

  /// One line each, behind the mark; line ends and control characters in a comment become blanks.
  void comments(std::string_view mark, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) text(mark).text(one_line(line)).text("\n");
  }

  static std::string one_line(std::string text) {
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 32) c = ' ';
    }
    while (!text.empty() && (text.back() == '\\' || text.back() == ' ')) text.pop_back();
    return text;
  }

  std::string take() { return std::move(out_); }

private:
  template <class Number>
  TextWriter& shortest(Number value) {
    char digits[32];
    out_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    return *this;
  }

  std::string out_;
};

}  // namespace viete::mesh
