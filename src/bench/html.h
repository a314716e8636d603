// Text of a page that is XML, too: every value escaped, every element closed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace viete::bench {

/// <p class="...">, a paragraph of text; no class where that is empty.
std::string paragraph(std::string_view text, std::string_view kind = "");

/// A command that is typed.
std::string command_line(std::string_view command);

/// The first column is of names; the others are of numbers and stand to the right, but for those that are
/// called by `words`. Scrolls by itself where the page is narrow.
struct HtmlTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> words = {};
};
std::string html(const HtmlTable& table);

/// A drawing with its title, which it is also read out by.
std::string figure(std::string_view title, std::string_view svg);

}  // namespace viete::bench
