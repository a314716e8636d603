#include "app/options.h"

#include <doctest/doctest.h>

#include "base/text.h"

using namespace viete;

TEST_CASE("lines_break_at_blanks") {
  using app::wrapped;
  CHECK(wrapped("", 0, 2, 10) == "");
  CHECK(wrapped("one two three", 0, 2, 80) == "one two three");
  CHECK(wrapped("one two three", 0, 2, 8) == "one two\n  three");
  CHECK(wrapped("one two three", 3, 3, 8) == "one\n   two\n   three");
  CHECK(wrapped("averylongword b", 0, 1, 5) == "averylongword\n b");
  CHECK(wrapped("one\ntwo", 0, 1, 80) == "one\n two");
  CHECK(wrapped("abc abc x", 0, 0, 7) == "abc abc\nx");
}

TEST_CASE("the_nearest_name_is_one_of_few_corrections_or_of_the_same_beginning") {
  using app::nearest;
  const std::vector<std::string> names = {"view", "render", "deform", "bind", "info", "bench"};
  for (const auto& [word, name] : {std::pair{"rendr", "render"},
                                   {"redner", "render"},
                                   {"deforme", "deform"},
                                   {"defrom", "deform"},
                                   {"inof", "info"},
                                   {"benchmark", "bench"},
                                   {"vie", "view"},
                                   {"frobnicate", ""},
                                   {"x", ""},
                                   {"", ""}})
    CHECK(nearest(word, names) == name);
  CHECK(app::misspellings("kitten", "sitting") == 3);
  CHECK(app::misspellings("", "abc") == 3);
}

TEST_CASE("lists_end_with_or") {
  CHECK(base::listed(std::vector<std::string>{"a"}) == "a");
  CHECK(base::listed(std::vector<std::string>{"a", "b"}) == "a or b");
  CHECK(base::listed(std::vector<std::string>{"a", "b", "c"}) == "a, b or c");
}
