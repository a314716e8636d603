#include "app/options.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "support/text.h"

using namespace viete;
using test::mentions;

namespace {

// CLI11's error for the arguments; empty if they are valid.
std::string refusal(CLI::App& command, const std::string& arguments) {
  try {
    command.parse(arguments, false);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a_number_outside_of_its_range_is_refused_with_the_range") {
  CLI::App command;
  double number = 0;
  app::in_range(command.add_option("--number", number), 0.5, 4);
  CHECK(refusal(command, "--number 0.5").empty());
  CHECK(number == 0.5);
  for (const char* wrong : {"0.49", "5", "nan", "inf", "2x", "1,5"})
    CHECK(mentions(refusal(command, std::string("--number ") + wrong), "needs a number from 0.5 to 4, not "));
}

TEST_CASE("a_whole_number_has_no_decimals") {
  CLI::App command;
  std::size_t number = 0;
  app::whole_in_range(command.add_option("--number", number), 1, 10'000'000);
  CHECK(refusal(command, "--number 10000000").empty());
  CHECK(number == 10'000'000);
  for (const char* wrong : {"0", "-1", "1.5", "1e3", "10000001"})
    CHECK(mentions(refusal(command, std::string("--number ") + wrong),
                   "needs a whole number from 1 to 10,000,000, not "));
}

TEST_CASE("a_word_is_one_of_its_list_and_a_misspelt_one_is_corrected") {
  CLI::App command;
  std::string word;
  app::one_of(command.add_option("--look", word), {"home", "front", "back"});
  CHECK(refusal(command, "--look front").empty());
  const std::string text = refusal(command, "--look fornt");
  CHECK(mentions(text, "needs home, front or back, not fornt; did you mean front?"));
}

TEST_CASE("a_picture_has_a_size_that_memory_holds") {
  CLI::App command;
  glm::ivec2 size{0, 0};
  app::add_size_option(command, size);
  CHECK(refusal(command, "--size 640x480").empty());
  CHECK(size == glm::ivec2(640, 480));
  for (const char* wrong : {"640", "640x", "15x100", "32769x100", "640x480x3", "32768x8193"})
    CHECK(mentions(refusal(command, std::string("--size ") + wrong), "needs "));
}
