// One statement per line, and short functions.
#include <doctest/doctest.h>

#include <fstream>

#include "rules/statements.h"
#include "support/data.h"

namespace fs = std::filesystem;
using viete::rules::is_function;
using viete::rules::is_joined;
using viete::rules::statements_of;

namespace {

constexpr std::size_t most_lines_of_a_function = 70;

template <class Visit>
void for_statements(const char* top, const Visit& visit) {
  for (const auto& entry : fs::recursive_directory_iterator(viete::test::source_dir() / top)) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    for (const auto& statement : statements_of(std::string(std::istreambuf_iterator<char>(in), {})))
      visit(entry.path().string() + ":" + std::to_string(statement.line), statement);
  }
}

std::vector<std::string> joined_in(const std::string& source) {
  std::vector<std::string> found;
  for (const auto& statement : statements_of(source))
    if (!statement.is_block && is_joined(statement.text)) found.push_back(statement.text);
  return found;
}

}  // namespace

TEST_CASE("no_statements_are_joined_by_commas") {
  for (const char* top : {"src", "tests"})
    for_statements(top, [](const std::string& place, const auto& statement) {
      if (!statement.is_block && is_joined(statement.text))
        FAIL_CHECK(place << ": write one statement per line:" << statement.text);
    });
}

TEST_CASE("functions_have_at_most_seventy_lines") {
  std::size_t functions = 0;
  for_statements("src", [&](const std::string& place, const auto& statement) {
    if (!statement.is_block || !is_function(statement.text)) return;
    ++functions;
    CHECK_MESSAGE(statement.lines <= most_lines_of_a_function, place, ":", statement.text);
  });
  CHECK(functions > 4000);
}

TEST_CASE("joined_statements_are_found_and_lists_are_not") {
  for (const char* joined :
       {"void f() { a = 1, b = 2; }", "void f() { if (x) g(1, 2), h(); }", "void f() { ++i, ++j; }",
        "void f() { x[i] += 2, y.z->w(); }", "void f() { use([&] { a = b, c = d; }); }",
        "void f() { case A::b: a = 0, c = 0; }", "void f() { std::swap(a, b), g(); }"})
    CHECK_MESSAGE(joined_in(joined).size() == 1, joined);
  for (const char* other :
       {"double a = 1, b = 2;", "enum class E { a, b = 2 };", "for (i = 0, j = 0; i < 3; ++i, ++j) f(i, j);",
        "A(int x) : a_(x), b_(2) {}", "std::map<std::pair<int, int>, int> all;", "auto [a, b] = f();",
        "x = std::pair<int, int>(1, 2);", "using a::b, a::c;", "return f(a, b);", "v = {1, 2};",
        "#define A(x) \\\n  f(), \\\n  g()\nint x;"})
    CHECK_MESSAGE(joined_in(other).empty(), other);
}
