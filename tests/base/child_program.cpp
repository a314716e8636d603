#include "base/process.h"

#include <chrono>
#include <thread>

#include "support/folder.h"
#include "support/text.h"

using namespace viete;
using base::ChildProgram;

namespace {

std::string problem_of(const std::vector<std::string>& words) {
  return test::problem_of([&] { ChildProgram(words, "install it").finish(); });
}

}  // namespace

TEST_CASE("a_child_gets_its_arguments_unchanged_and_no_input") {
  const test::TemporaryFolder folder;
  const auto file = (folder / "a b'$HOME").string();
  CHECK(problem_of({"sh", "-c", "cat > \"$1\"; echo end >> \"$1\"", "sh", file}) == "");
  CHECK(test::file_bytes(file) == "end\n");
}

TEST_CASE("a_child_can_be_polled_given_variables_and_stopped") {
  ChildProgram child({"sh", "-c", "echo \"$VIETE_TEST_WORD\" >&2; exec sleep 100"}, "",
                     {"VIETE_TEST_WORD=so far"});
  while (child.said().empty()) CHECK(child.running());
  CHECK(child.said() == "so far");
  child.stop();
  CHECK_THROWS(child.finish());
  CHECK(problem_of({"true"}) == "");
  const auto before = std::signal(SIGCHLD, SIG_IGN);  // then the system keeps no status of children
  CHECK(problem_of({"true"}) != "");
  std::signal(SIGCHLD, before);
}

TEST_CASE("the_output_of_a_child_is_kept_if_asked_for") {
  constexpr bool keeps_output = true;
  ChildProgram child({"sh", "-c", "echo '40 %' >&2; echo note >&2; head -c 3000000 /dev/zero; printf end"},
                     "", {}, keeps_output);
  base::Progress progress;
  CHECK(child.follow(progress) == std::vector<std::string>{"note"});
  child.finish();
  const std::string output = child.output();
  CHECK(output.size() == 3'000'003);
  CHECK(output.ends_with("end"));
  ChildProgram other({"sh", "-c", "echo lost"}, "");
  other.finish();
  CHECK(other.output().empty());
  ChildProgram slow({"sleep", "100"}, "");
  CHECK(slow.follow(progress, 0.01).empty());
  CHECK(slow.running());
}

TEST_CASE("missing_and_failing_children_are_reported_with_their_output") {
  CHECK(problem_of({"viete-no-such-program"}) ==
        "viete-no-such-program: this program is not installed; install it");
  CHECK(test::mentions(problem_of({"sh", "-c", "echo so bad >&2; exit 3"}), "so bad"));
  CHECK(test::mentions(problem_of({"sh", "-c", "printf 'one\\n\\ntwo\\r\\nthree\\n' >&2; exit 1"}),
                       "it reported: one; two; three; check"));
}

TEST_CASE("an_abandoned_child_is_killed_with_its_own_children") {
  const test::TemporaryFolder folder;
  const auto file = (folder / "number").string();
  std::string number;
  {
    ChildProgram child({"sh", "-c", "sleep 600 & echo $! > \"$1\"; sleep 600", "sh", file}, "");
    while (number.empty() || number.back() != '\n') number = test::file_bytes(file);
  }
  number.pop_back();
  const auto runs = [&] {  // a zombie does not count as running
    const std::string state = test::file_bytes("/proc/" + number + "/stat");
    const auto name_end = state.rfind(')');
    return name_end != std::string::npos && state[name_end + 2] != 'Z' && state[name_end + 2] != 'X';
  };
  for (int i = 0; i < 30'000 && runs(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK_FALSE(runs());
}
