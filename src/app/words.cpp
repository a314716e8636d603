#include "app/words.h"

#include <algorithm>

namespace viete::app {

std::string wrapped(std::string_view text, std::size_t column, std::size_t indent, std::size_t width) {
  std::string out;
  bool line_has_words = false;
  const auto new_line = [&] {
    out += '\n' + std::string(indent, ' ');
    column = indent;
    line_has_words = false;
  };
  while (!text.empty()) {
    const std::size_t length = std::min(text.find_first_of(" \n"), text.size());
    if (length > 0) {
      if (line_has_words && column + 1 + length > width) new_line();
      if (line_has_words) out += ' ';
      column += length + (line_has_words ? 1 : 0);
      out += text.substr(0, length);
      line_has_words = true;
    }
    if (length < text.size() && text[length] == '\n') new_line();
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return out;
}

std::size_t misspellings(std::string_view a, std::string_view b) {
  // Row by row of the table of all beginnings of a and b (optimal string alignment).
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t other = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + other});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t telling = 3;  // letters
  std::string best;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& name : names) {
    const bool begins = word.size() >= telling && name.size() >= telling &&
                        (name.starts_with(word) || word.starts_with(name));
    const std::size_t count = begins ? 1 : misspellings(word, name);
    if (count >= fewest) continue;
    fewest = count;
    best = name;
  }
  return best;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace viete::app
