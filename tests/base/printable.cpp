#include "base/text.h"

#include <doctest/doctest.h>

#include "base/error.h"

using namespace viete;
using base::printable;

TEST_CASE("text_of_a_file_cannot_act_on_a_terminal") {
  CHECK(printable("wood \"caf\xC3\xA9\" \\") == "wood \"caf\xC3\xA9\" \\");
  CHECK(printable("a\x1B[2Jb\nc\x7F\xC2\x9B") == "a\\x1B[2Jb\\nc\\x7F\\x9B");
  CHECK(printable(printable("a\x1B\n")) == printable("a\x1B\n"));
  CHECK(printable(std::string_view("a\0b", 3)) == "a\\x00b");
}

TEST_CASE("a_long_text_is_cut_in_its_middle_between_letters") {
  CHECK(printable("abcdefghij", 10) == "abcdefghij");
  CHECK(printable("abcdefghijk", 10) == "abcde ... ghijk");
  CHECK(printable("abcd\xC3\xA9 middle \xC3\xA9zyxw", 10) == "abcd ... zyxw");
  const base::Error error("file", std::string(10'000'000, 'x'), "do\x1B something");
  CHECK(std::string(error.what()).size() < 3000);
  CHECK(std::string(error.what()).ends_with("; do\\x1B something"));
}
