#include "app/options.h"

#include <doctest/doctest.h>

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
