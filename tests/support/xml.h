// Checks that a page is well-formed and does not use other files.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace viete::test {

/// Returns the first XML error in the text, such as an unclosed element; empty without an error.
inline std::string xml_problem(std::string_view text) {
  std::vector<std::string_view> open;
  for (std::size_t at = text.find_first_of("<&"); at != text.npos; at = text.find_first_of("<&", at + 1)) {
    const std::string_view rest = text.substr(at), tag = rest.substr(0, rest.find('>') + 1);
    if (tag.starts_with("<!DOCTYPE")) continue;
    if (rest[0] == '&') {
      const auto is_here = [&](std::string_view entity) { return rest.starts_with(entity); };
      if (std::ranges::none_of(std::vector{"&amp;", "&lt;", "&gt;", "&quot;"}, is_here))
        return "unescaped &: " + std::string(tag);
      continue;
    }
    const bool closes = tag.starts_with("</");
    const std::size_t start = closes ? 2 : 1, end = tag.find_first_of(" \n/>", start);
    std::size_t values = 0;
    for (auto v = tag.find("=\""); v != tag.npos; v = tag.find("=\"", v + 1)) ++values;
    if (end == tag.npos || end == start || tag.find('<', 1) != tag.npos ||
        values * 2 != std::size_t(std::ranges::count(tag, '"')))
      return "not a tag: " + std::string(tag);
    const std::string_view name = tag.substr(start, end - start);
    if (closes && (open.empty() || open.back() != name))
      return "closes an element that is not open: " + std::string(tag);
    if (closes) open.pop_back();
    if (!closes && !tag.ends_with("/>")) open.push_back(name);
  }
  return open.empty() ? "" : "not closed: " + std::string(open.back());
}

/// Returns the first part of the page that is a script or uses another file; empty if there is none.
inline std::string outside_of(std::string_view page) {
  for (const char* part : {"url(", "@import", "<script", "<iframe", "<object", "<embed", "<form"})
    if (page.find(part) != page.npos) return part;
  for (const std::string part : {"src=\"", "href=\"", "srcset=\"", "action=\"", " data=\""})
    for (auto at = page.find(part); at != page.npos; at = page.find(part, at + 1)) {
      const std::string_view value = page.substr(at + part.size());
      if (!value.starts_with('#') && !value.starts_with("data:,"))
        return part + std::string(value.substr(0, 80));
    }
  return "";
}

}  // namespace viete::test
