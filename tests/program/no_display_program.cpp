#include <algorithm>

#include "program/command_line.h"
#include "support/pictures.h"

using namespace viete;
using namespace viete::test;

TEST_CASE("without_a_display_the_viewer_says_so_in_one_line_and_renders_a_picture") {
  for (const char* more : {" XDG_RUNTIME_DIR=/nowhere", " -u XDG_RUNTIME_DIR"}) {
    const TemporaryFolder scratch;
    const auto outcome = run(quoted(dragon) + " " + quoted(cage), without_display(scratch.path()) + more);
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    CHECK_MESSAGE(std::count(outcome.text.begin(), outcome.text.end(), '\n') == 1, outcome.text);
    CHECK(mentions(outcome, "no window"));
    CHECK_MESSAGE(mentions(outcome, fs::canonical(scratch.path() / "viete.png").string()), outcome.text);
    CHECK(test::read_png(scratch.path() / "viete.png").width == 1440);
  }
}

TEST_CASE("existing_pictures_and_link_targets_are_not_overwritten") {
  const TemporaryFolder scratch;
  put_file(scratch / "precious", "precious");
  fs::create_symlink("precious", scratch / "viete.png");
  fs::create_symlink("nowhere", scratch / "viete-2.png");
  const auto outcome = run(quoted(cage), without_display(scratch.path()));
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(file_bytes(scratch / "precious") == "precious");
  CHECK_FALSE(fs::exists(scratch / "nowhere"));
  CHECK_MESSAGE(mentions(outcome, "viete-3.png"), outcome.text);
  CHECK(test::read_png(scratch / "viete-3.png").width == 1440);
}

TEST_CASE("nothing_is_announced_of_a_file_that_cannot_be_opened") {
  const TemporaryFolder scratch;
  const auto outcome = run("none.obj", without_display(scratch.path()));
  CHECK(outcome.code == 1);
  CHECK_MESSAGE(mentions(outcome, "none.obj: "), outcome.text);
  CHECK_FALSE(mentions(outcome, "picture"));
  CHECK(scratch.entries() == 0);
}

TEST_CASE("the_bundled_model_is_found_from_any_working_directory") {
  const TemporaryFolder scratch;
  const auto outcome = run("", without_display(scratch.path()));
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(fs::exists(scratch / "viete.png"));
}
