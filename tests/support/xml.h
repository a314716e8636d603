// Checks that a page is well-formed and does not use other files.
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace viete::test {

/// Returns the first XML error in the text, such as an unclosed element; empty without an error.
inline std::string xml_problem(const std::string& text) {
  static const std::regex tag(R"(^<(/?)([a-zA-Z][\w:-]*)((\s+[\w:-]+="[^"<]*")*)\s*(/?)>)");
  static const std::regex entity(R"(^&(amp|lt|gt|quot);)");
  std::vector<std::string> open;
  for (std::size_t at = text.find_first_of("<&"); at != text.npos; at = text.find_first_of("<&", at + 1)) {
    const std::string here = text.substr(at, text.find('>', at) + 1 - at);
    std::smatch found;
    if (here.starts_with("<!DOCTYPE")) continue;
    if (text[at] == '&') {
      if (!std::regex_search(text.substr(at, 8), entity)) return "unescaped &: " + here;
    } else if (!std::regex_search(here, found, tag)) {
      return "not a tag: " + here;
    } else if (found[1].length() && (open.empty() || open.back() != found[2])) {
      return "closes an element that is not open: " + here;
    } else if (found[1].length()) {
      open.pop_back();
    } else if (!found[5].length()) {
      open.push_back(found[2]);
    }
  }
  return open.empty() ? "" : "not closed: " + open.back();
}

/// Returns the first element of the page that is a script or uses another file; empty if there is none.
inline std::string outside_of(const std::string& page) {
  static const std::regex outside(
      R"((\s(src|href|srcset|action|data)="(?!#|data:,)[^"]*")|url\(|@import|<(script|iframe|object|embed|form)\b)");
  std::smatch found;
  return std::regex_search(page, found, outside) ? found.str() : "";
}

}  // namespace viete::test
