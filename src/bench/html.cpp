#include "bench/html.h"

#include <algorithm>

#include "bench/plot.h"

namespace viete::bench {

std::string paragraph(std::string_view text, std::string_view kind) {
  const std::string attribute = kind.empty() ? "" : " class=\"" + std::string(kind) + "\"";
  return "<p" + attribute + ">" + escaped(text) + "</p>\n";
}

std::string html(const Table& table) {
  const auto opened = [&](const char* tag, std::size_t column, const char* scope) {
    const bool is_word = column == 0 || std::ranges::count(table.words, table.columns[column]) > 0;
    return std::string("<") + tag + (*scope ? std::string(" scope=\"") + scope + "\"" : "") +
           (is_word ? "" : " class=\"n\"") + ">";
  };
  std::string text = "<div class=\"wide\" tabindex=\"0\"><table><thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    text += opened("th", c, "col") + escaped(table.columns[c]) + "</th>";
  text += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      const char* tag = c == 0 ? "th" : "td";
      text += opened(tag, c, c == 0 ? "row" : "") + escaped(row[c]) + "</" + tag + ">";
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string figure(std::string_view title, std::string_view svg) {
  return "<figure role=\"group\"><figcaption>" + escaped(title) + "</figcaption>\n" + std::string(svg) +
         "</figure>\n";
}

}  // namespace viete::bench
