// Help, and errors about wrong words, options and numbers on the command line.
#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "program/command_line.h"

using namespace viete;
using namespace viete::test;

namespace {

const std::vector<std::string> commands = {"view", "render", "deform", "animate", "between", "mix",
                                           "pose", "cage",   "info",   "manual",  "bench",   "report"},
                               benches = {"exp", "eigen", "accuracy", "sym3", "frame", "bind", "modes"};

void check_width(const Outcome& help) {
  std::istringstream lines(help.text);
  for (std::string line; std::getline(lines, line);) CHECK_MESSAGE(line.size() <= 80, line);
}

}  // namespace

TEST_CASE("help_of_every_command_is_there_and_fits_eighty_columns") {
  const Outcome top = run("--help");
  CHECK(top.code == 0);
  check_width(top);
  CHECK(mentions(top, "viete [MODEL [CAGE]]"));
  CHECK(mentions(top, "Exit codes"));
  for (const std::string& command : commands) {
    CHECK_MESSAGE(mentions(top, "\n  " + command + " "), command);
    const Outcome help = run(command + " --help");
    CHECK(help.code == 0);
    check_width(help);
    CHECK_MESSAGE(std::ranges::count(help.text, '\n') <= 65, command);
    CHECK(mentions(help, "Usage: viete " + command));
    CHECK(mentions(help, command == "bench" ? "Commands:" : "Examples:\n  viete " + command));
    CHECK(run("help " + command).text == help.text);
  }
  for (const std::string& bench : benches) {
    const Outcome help = run("bench " + bench + " --help");
    CHECK(help.code == 0);
    check_width(help);
    CHECK(run("help bench " + bench).text == help.text);
  }
  CHECK(run("help").text == top.text);
  const Outcome choices = run("help deformers");
  CHECK(choices.code == 0);
  check_width(choices);
  CHECK(mentions(choices, "\n  mls-rigid "));
  CHECK_FALSE(mentions(choices, " map "));  // only colours are maps here
  CHECK(mentions(top, "viete manual glossary"));
  CHECK(mentions(run("render --help"), "-o, --output FILE"));
  CHECK(mentions(run("render --help"), "Device pixels per logical pixel, 0.5 to 4 (default: 1)"));
}

TEST_CASE("the_version_includes_build_information") {
  const Outcome version = run("--version");
  CHECK(version.code == 0);
  CHECK(mentions(version, "viete "));
  CHECK(mentions(version, ", kernel "));
}

TEST_CASE("a_wrong_command_line_exits_with_2_names_what_is_wrong_and_whose_help_to_read") {
  const std::pair<const char*, const char*> cases[] = {
      {"render", "MODEL is required\nTry 'viete render --help'"},
      {"deform a b", "--output is required\nTry 'viete deform --help'"},
      {"render --bogus", "viete render has no option --bogus\nTry 'viete render --help'"},
      {"render --bogus 3 a.obj", "viete render has no option --bogus"},
      {"render a b -o x.png --no-grids", "--no-grids; did you mean --no-grid?"},
      {"render a b --out x.png", "no option --out; did you mean --output?"},
      {"render a b --look=top --siez=3x3 -o a.png", "no option --siez=3x3; did you mean --size?"},
      {"render a b -o", "--output needs a value\n"},
      {"render a b -o x.png --scale", "--scale needs a value\n"},
      {"render a b -o x.png -o y.png", "--output is given more than once\n"},
      {"render a b -o x.png --compare smooth", "--compare needs 2 or more values\n"},
      {"render a b -o x.png --compare smooth,paper,rigid,arap,local", "--compare needs at most 4 values\n"},
      {"render a b -q -o x.png", "no option -q\n"},
      {"render a b c d -o x.png", "unexpected arguments of viete render: c d\n"},
      {"bench",
       "viete bench needs one of exp, eigen, accuracy, sym3, frame, bind, splats or modes\nTry 'viete bench "
       "--help'"},
      {"bench nothing", "viete bench has no command nothing\n"},
      {"bench exponential", "no command exponential; did you mean exp?"},
      {"bench frame --face 8", "no option --face; did you mean --faces?\nTry 'viete bench frame --help'"},
      {"frobnicate", "frobnicate: no such command or file\nTry 'viete --help'"},
      {"rendr a b", "rendr: no such command or file; did you mean viete render?"},
      {"help rendr", "did you mean viete render?"},
      {"--bogus", "viete view has no option --bogus\n"},
      {"render a b -o x.png --method fats",
       "--method: needs diag, sd, improved_sd or fast, not fats; did you "
       "mean fast?"},
      {"render a b -o x.png --look up",
       "--look: needs home, front, back, left, right, top or bottom, not up"},
      {"render a b -o x.png --size 12", "--size: needs WIDTHxHEIGHT, each 16 to 32768, not 12"},
      {"render a b -o x.png --size 32768x32768", "at most 268 million pixels"},
      {"render --method best", "--method: needs diag"}};  // invalid values are reported before missing words
  const WorkFolder empty;
  for (const auto& [line, words] : cases) empty.refused(line, 2, words);
  CHECK(empty.entries() == 0);
}

TEST_CASE("a_file_that_is_called_like_no_command_is_opened") {
  const TemporaryFolder folder;
  fs::copy_file(cage, folder / "rendr");
  const Outcome outcome = run("rendr", without_display(folder.path()));
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "viete.png"));
}

TEST_CASE("every_number_has_a_range_without_nan_and_infinity_and_says_it_in_short") {
  const std::pair<std::string, const char*> cases[] = {
      {"render " + in_cage + " -o x.png --scale ", "needs a number from 0.5 to 4, not "},
      {"view --frames ", "needs a whole number from 0 to 1,000,000,000, not "},
      {posed + " -o x.ply --radius ", "needs a number from 0.1 to 1000, not "},
      {posed + " -o x.ply --rotation ", "needs a number from 0 to 200, not "},
      {"bench exp --count ", "needs a whole number from 1 to 1,000,000,000, not "},
      {"bench accuracy --count ", "needs a whole number from 1 to 1,000,000, not "},
      {"bench frame --faces ", "needs a whole number from 8 to 10,000, not "},
      {"bench bind --rounds ", "needs a whole number from 1 to 1,000, not "},
      {"bench modes --radius ", "needs a number from 0.1 to 1000, not "}};
  for (const auto& [line, range] : cases)
    for (const char* bad : {"nan", "inf", "-inf", "-1", "1e400", "10000000000x", "0x10", "''"}) {
      const Outcome outcome = run(line + bad);
      CHECK(outcome.code == 2);
      CHECK_MESSAGE(mentions(outcome, range), (line + bad + "\n" + outcome.text));
      CHECK(outcome.text.size() < 200);
    }
  CHECK(run("bench exp --count 10000000000").code == 2);
  CHECK(mentions(run("bench frame --faces 8,nan"), "needs a whole number from 8 to 10,000, not nan"));
}
