#include "app/options.h"

#include <doctest/doctest.h>

#include "app/command_line.h"
#include "base/text.h"
#include "support/text.h"

using namespace viete;
using test::mentions;

TEST_CASE("options_take_what_they_need_and_refuse_the_rest_with_it") {
  CLI::App command;
  double number = 0;
  std::size_t whole = 0;
  std::string word;
  glm::ivec2 size{0, 0};
  app::in_range(command.add_option("--number", number), 0.5, 4);
  app::whole_in_range(command.add_option("--whole", whole), 1, 10'000'000);
  app::one_of(command.add_option("--look", word), {"home", "front", "back"});
  app::add_size_option(command, size);
  command.parse("--number 0.5 --whole 10000000 --look front --size 640x480", false);
  CHECK(number == 0.5);
  CHECK(whole == 10'000'000);
  CHECK(word == "front");
  CHECK(size == glm::ivec2(640, 480));
  CHECK(mentions(command.get_option("--size")->get_description(), "logical pixels"));

  const auto refuses = [&](const std::string& option, const std::string& needs,
                           std::initializer_list<const char*> values) {
    for (const char* value : values) {
      const std::string refusal = test::problem_of([&] { command.parse(option + " " + value, false); });
      CHECK_MESSAGE(mentions(refusal, needs), option, " ", value, ": ", refusal);
    }
  };
  refuses("--number", "needs a number from 0.5 to 4, not ", {"0.49", "5", "nan", "inf", "2x", "1,5"});
  refuses("--whole", "needs a whole number from 1 to 10,000,000, not ",
          {"0", "-1", "1.5", "1e3", "10000001"});
  refuses("--look", "needs home, front or back, not fornt; did you mean front?", {"fornt"});
  refuses("--size", "needs ", {"640", "640x", "15x100", "32769x100", "640x480x3", "32768x8193"});
}

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

TEST_CASE("the_remaining_time_is_estimated_once_there_is_data") {
  CHECK(app::progress_text(0, 10) == "0 %");
  CHECK(app::progress_text(0.5, 0.2) == "50 %");
  CHECK(app::progress_text(0.25, 10) == "25 %, 30 s left");
  CHECK(app::progress_text(0.1, 100) == "10 %, 15 min left");
}
