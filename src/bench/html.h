// Elements of an HTML page that is also XML: every value escaped, every element closed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace viete::bench {

/// A paragraph of text, <p class="...">; without a class if `kind` is empty.
std::string paragraph(std::string_view text, std::string_view kind = "");

/// A command line to copy.
std::string command_line(std::string_view command);

/// The first column has names; the others have numbers and are right-aligned, except columns listed in
/// `words`. Scrolls horizontally on narrow pages.
struct HtmlTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> words = {};
};
std::string html(const HtmlTable& table);

/// A drawing with its title, which is also its accessible name.
std::string figure(std::string_view title, std::string_view svg);

}  // namespace viete::bench
