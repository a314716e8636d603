#include "base/child_program.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "base/error.h"
#include "base/progress.h"
#include "support/folder.h"
#include "support/text.h"

using namespace viete;
using base::ChildProgram;

namespace {

std::string problem_of(const std::vector<std::string>& words, std::size_t bytes) {
  try {
    ChildProgram child(words, "install it");
    const std::vector<unsigned char> data(bytes, 'x');
    child.write(data);
    child.finish();
  } catch (const base::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a_child_gets_all_bytes_and_its_words_as_they_are") {
  const test::TemporaryFolder folder;
  const auto file = (folder / "a b'$HOME").string();
  CHECK(problem_of({"sh", "-c", "cat > \"$1\"", "sh", file}, 3'000'000) == "");
  CHECK(test::file_bytes(file) == std::string(3'000'000, 'x'));
}

TEST_CASE("a_child_is_looked_at_while_it_runs_told_variables_and_stopped") {
  ChildProgram child({"sh", "-c", "echo \"$VIETE_TEST_WORD\" >&2; exec sleep 100"}, "",
                     {"VIETE_TEST_WORD=so far"});
  while (child.said().empty()) CHECK(child.running());
  CHECK(child.said() == "so far");
  child.stop();
  while (child.running()) {
  }
  CHECK_THROWS(child.finish());
  ChildProgram good({"true"}, "");
  while (good.running()) {
  }
  CHECK_NOTHROW(good.finish());
}

TEST_CASE("a_child_that_is_not_there_or_fails_is_said_with_its_own_words") {
  CHECK(problem_of({"viete-no-such-program"}, 0) ==
        "viete-no-such-program: this program is not installed; install it");
  CHECK(test::mentions(problem_of({"sh", "-c", "cat > /dev/null; echo so bad >&2; exit 3"}, 10), "so bad"));
  CHECK(test::mentions(problem_of({"sh", "-c", "echo too early >&2; exit 1"}, 3'000'000), "too early"));
  CHECK(test::mentions(problem_of({"sh", "-c", "printf 'one\\n\\ntwo\\r\\nthree\\n' >&2; exit 1"}, 0),
                       "it says: one; two; three; check"));
  CHECK(problem_of({"true"}, 3'000'000) != "");
}

TEST_CASE("who_waits_for_a_child_that_hangs_may_give_up_and_ends_it_with_its_own_children") {
  const test::TemporaryFolder folder;
  const auto file = (folder / "number").string();
  for (const bool fed : {false, true}) {
    CAPTURE(fed);
    std::string number;
    {
      ChildProgram child({"sh", "-c", "sleep 600 & echo $! > \"$1\"; sleep 600", "sh", file}, "");
      const auto give_up = [&] {
        number = test::file_bytes(file);
        if (!number.empty() && number.back() == '\n') throw base::Cancelled();
      };
      const std::vector<unsigned char> data(fed ? 10'000'000 : 0, 'x');
      const auto all = [&] {
        child.write(data, give_up);
        child.finish(give_up);
      };
      CHECK_THROWS_AS(all(), base::Cancelled);
    }
    number.pop_back();
    const auto runs = [&] {  // what nobody has waited for yet has ended all the same
      const std::string state = test::file_bytes("/proc/" + number + "/stat");
      const auto name_end = state.rfind(')');
      return name_end != std::string::npos && state[name_end + 2] != 'Z' && state[name_end + 2] != 'X';
    };
    for (int i = 0; i < 30'000 && runs(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK_FALSE(runs());
    std::filesystem::remove(file);
  }
}
