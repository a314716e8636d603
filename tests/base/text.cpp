#include <doctest/doctest.h>
#include <utility>

#include "base/error.h"
#include "base/text.h"

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

using namespace viete::base;

TEST_CASE("quantities_have_three_digits_and_a_suitable_unit") {
  const std::pair<std::string, const char*> rows[] = {
      {milliseconds(0.004), "0.00 ms"}, {milliseconds(9.994), "9.99 ms"},
      {milliseconds(9.996), "10.0 ms"}, {milliseconds(123.4), "123 ms"},
      {milliseconds(1234), "1.23 s"},   {nanoseconds(3.21), "3.21 ns"},
      {nanoseconds(1500), "1.50 us"},   {with_thousands(999), "999"},
      {with_thousands(1000), "1,000"},  {with_thousands(1074744), "1,074,744"},
      {counted(1, "face"), "1 face"},   {counted(0, "face"), "0 faces"},
      {memory_size(12), "1 MB"},        {memory_size(999.4e6), "999 MB"},
      {memory_size(999.6e6), "1.0 GB"}};
  for (const auto& [text, expected] : rows) CHECK(text == expected);
}

TEST_CASE("a_capitalised_text_begins_with_a_capital") {
  CHECK(capitalised("rotate 45") == "Rotate 45");
  CHECK(capitalised("Rotate") == "Rotate");
  CHECK(capitalised("").empty());
}

TEST_CASE("an_error_reads_place_problem_advice") {
  const Error error("dragon.obj:1042", "face refers to vertex 70000", "export the model again");
  CHECK(std::string(error.what()) == "dragon.obj:1042: face refers to vertex 70000; export the model again");
  CHECK(error.place() == "dragon.obj:1042");
  CHECK(std::string(Error("", "the disk is full").what()) == "the disk is full");
}
