// Finds namespace-level declarations in a source text, without compiling it.
#pragma once

#include <cctype>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace viete::rules {

/// The end of a comment, literal or preprocessor line that starts at `at`; otherwise `at`.
inline std::size_t end_of_no_code(const std::string& text, std::size_t at) {
  const auto after = [&](const std::string& what, std::size_t from) {
    const std::size_t found = text.find(what, from);
    return found == text.npos ? text.size() : found + what.size();
  };
  const char c = text[at], before = at > 0 ? text[at - 1] : '\n';
  if (text.compare(at, 2, "//") == 0) return after("\n", at) - 1;
  if (text.compare(at, 2, "/*") == 0) return after("*/", at + 2);
  if (c == '"' && before == 'R')
    return after(')' + text.substr(at + 1, text.find('(', at) - at - 1) + '"', at + 1);
  if (c == '"' || (c == '\'' && !std::isalnum(static_cast<unsigned char>(before)))) {
    std::size_t end = at + 1;
    while (end < text.size() && text[end] != c) end += text[end] == '\\' ? 2 : 1;
    return std::min(end + 1, text.size());
  }
  if (c != '#' || text.find_last_not_of(" \t", at - 1) != text.rfind('\n', at)) return at;
  std::size_t end = text.find('\n', at);
  while (end != text.npos && text[end - 1] == '\\') end = text.find('\n', end + 1);
  return end == text.npos ? text.size() : end;
}

/// Removes comments, literals and preprocessor lines.
inline std::string plain_code(const std::string& text) {
  std::string code;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = end_of_no_code(text, i);
    code += end == i ? text[i] : ' ';
    i = end == i ? i + 1 : end;
  }
  return code;
}

/// A declaration at namespace level, up to its first brace or semicolon.
struct Head {
  std::string text;
  std::string space;  ///< its namespace: "viete mesh  ", with an extra blank if anonymous
  bool anonymous = false;
};

inline std::vector<Head> heads_of(const std::string& code) {
  static const std::regex opens_namespace(R"((?:^|\s)namespace(?:\s+([\w:]+))?\s*$)");
  std::vector<Head> heads;
  std::vector<std::string> spaces;  // open namespaces
  int braces = 0;                   // open braces within the last namespace
  std::string head;
  const auto keep = [&] {
    if (braces > 0 || head.find_first_not_of(" \n\t") == head.npos) return;
    std::string space;
    for (const auto& one : spaces) space += one + ' ';
    const bool anonymous = std::find(spaces.begin(), spaces.end(), "") != spaces.end();
    heads.push_back({head, space, anonymous});
  };
  for (const char c : code) {
    std::smatch match;
    if (c == '{' && braces == 0 && std::regex_search(head, match, opens_namespace)) {
      spaces.push_back(match[1]);
    } else if (c == '{') {
      keep();
      ++braces;
    } else if (c == ';') {
      keep();
    } else if (c == '}' && braces > 0) {
      --braces;
    } else if (c == '}') {
      if (!spaces.empty()) spaces.pop_back();
    } else {
      head += c;
      continue;
    }
    head.clear();
  }
  return heads;
}

struct Declared {
  enum class Kind { type, alias, function, constant } kind;
  std::string name;
  std::string meaning;  ///< target of an alias, or parameter types of a function
};

/// The parameter types of "const Point& p, int n = 3", without blanks.
inline std::string types_of(const std::string& parameters) {
  static const std::regex value("=[^,]*"), name(R"(([\s&*>])\w+\s*(?=,|$))"), blank(R"(\s+)");
  return std::regex_replace(std::regex_replace(std::regex_replace(parameters, value, ""), name, "$1"), blank,
                            "");
}

/// Empty if nothing new is declared, as by member definitions and using directives.
inline std::optional<Declared> declared_by(const std::string& head) {
  static const std::regex alias(R"(^\s*(?:template\s*<.*>\s*)?using\s+(\w+)\s*=([^]*))"),
      type(
          R"(^\s*(?:template\s*<[^]*>\s*)?(?:struct|class|union|enum(?:\s+class)?)\s+(?:alignas\(\w+\)\s*)?(\w+)[^(=]*$)"),
      function(R"(^[^=(]*[\s&*>](\w+)\s*\(([^]*)\)[^()]*$)"),
      constant(R"(^[^=(]*[\w>&*\]]\s+[&*]?(\w+)\s*(?:\[[^\]]*\]\s*)*(?:=[^]*)?$)"),
      nothing(R"(^\s*(?:using|namespace|extern|friend|static_assert)\b[^]*)");
  using Kind = Declared::Kind;
  std::smatch m;
  if (std::regex_match(head, m, alias))
    return Declared{Kind::alias, m[1], std::regex_replace(m[2].str(), std::regex(R"(\s+)"), " ")};
  if (std::regex_match(head, nothing)) return std::nullopt;
  if (std::regex_match(head, m, type)) return Declared{Kind::type, m[1], ""};
  if (std::regex_match(head, m, function)) return Declared{Kind::function, m[1], types_of(m[2])};
  if (std::regex_match(head, m, constant)) return Declared{Kind::constant, m[1], ""};
  return std::nullopt;
}

}  // namespace viete::rules
