// Statements and functions of a C++ source, read from its brackets, without a parser.
#pragma once

#include <cctype>
#include <cstddef>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "rules/room_table.h"

namespace viete::rules {

/// A statement, or the head of a block. Brackets in it are empty: "if () f(), g()".
struct Statement {
  std::size_t line;   ///< the line of its end, from 1
  std::size_t lines;  ///< of a block: the number of its lines
  bool is_block;
  std::string text;
};

/// Returns the statements and the blocks of a source, in the order of their ends.
inline std::vector<Statement> statements_of(const std::string& source) {
  struct Open {
    char bracket;
    std::size_t line;
    std::string text;
  };
  static const std::regex directive(R"((^|\n)[ \t]*#([^\\\n]|\\\n?)*)");
  const auto lines_only = [](std::string match) {
    std::erase_if(match, [](char c) { return c != '\n'; });
    return match;
  };
  std::string code;
  std::sregex_iterator at(source.begin(), source.end(), directive), end;
  std::size_t from = 0;
  for (; at != end; ++at) {
    code += source.substr(from, at->position() - from) + lines_only(at->str());
    from = at->position() + at->length();
  }
  code = code_of(code + source.substr(from));

  std::vector<Statement> all;
  std::vector<Open> open{{'{', 1, ""}};
  std::size_t line = 1;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '\n') ++line;
    std::string& text = open.back().text;
    if (std::string_view("([{").find(c) != std::string_view::npos) {
      open.push_back({c, line, ""});
    } else if (std::string_view(")]}").find(c) != std::string_view::npos && open.size() > 1) {
      const Open closed = open.back();
      open.pop_back();
      Open& outer = open.back();
      const auto next = code.find_first_not_of(" \n", i + 1);
      const bool continues = outer.bracket != '{' || c != '}' ||
                             (next != std::string::npos &&
                              std::string_view(";,).(]?:").find(code[next]) != std::string_view::npos);
      if (c == '}') all.push_back({line, line - closed.line, true, outer.text});
      outer.text += std::string(1, closed.bracket) + c;
      if (!continues) outer.text.clear();
    } else if (c == ';' && open.back().bracket == '{') {
      all.push_back({line, 0, false, text});
      text.clear();
    } else {
      text += std::isspace(static_cast<unsigned char>(c)) ? ' ' : c;
    }
  }
  return all;
}

/// Returns true if a statement joins expressions by commas: "a = b, f()".
inline bool is_joined(std::string text) {
  static const std::regex heads(
      R"(^\s*((if|if constexpr|for|while|switch) ?\(\)|else|do|case [\w:' ]*[^:]:(?!:)|default ?:|public ?:|private ?:|protected ?:))");
  static const std::regex arguments(R"((\w)<[\w\s:,*&()\[\]+-]*>)");
  static const std::regex joined(
      R"(^\s*(\+\+|--|\*+|&|!)?\w+(::\w+)*(\(\)|\[\]|\{\}|(\.|->)\w+)*\s*([-+*/|&^]?=[^=]|\+\+|--|,)(.|\n)*)");
  for (std::string shorter; shorter != text; text = shorter) {
    shorter = text;
    text = std::regex_replace(text, arguments, "$1");
    std::swap(shorter, text);
  }
  for (std::smatch head; std::regex_search(text, head, heads);) text = head.suffix();
  return text.find(',') != std::string::npos && std::regex_match(text, joined);
}

/// Returns true if a block is the body of a function.
inline bool is_function(const std::string& head) {
  static const std::regex other(
      R"(^\s*(if|for|while|switch|else|do|namespace|try|catch)\b|=\s*$|[({,]\s*$|\]\(\)?\s*$)");
  return head.find("()") != std::string::npos && !std::regex_search(head, other);
}

}  // namespace viete::rules
