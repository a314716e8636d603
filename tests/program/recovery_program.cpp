// Ends the program by kill -9 and in other ways. Unsaved edits must survive.

#include "program/kept_work.h"
#include "workspace/open_save.h"

using namespace viete;
using namespace test;

TEST_CASE("unsaved_edits_are_in_a_file_after_each_finished_edit_and_gone_when_saved_or_undone") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state";
  const auto kept_pose = [&] { return files::read_session(kept_files(state).front()).pose.positions; };
  const auto settled = [&](std::size_t files) {
    return wait_until([&] { return kept_files(state).size() == files; });
  };
  {
    Driver d(remembering(state));
    REQUIRE(d.open({small.model, small.cage}));
    d.settle();
    CHECK(kept_files(state).empty());
    const glm::vec2 from = glm::round(d.vertex(d.free_vertex()));
    d.press_and_move(from, from + glm::vec2(30, 20));
    d.frame(3);
    CHECK(workspace::has_unsaved_edits(d.workspace()));
    CHECK_FALSE(wait_until([&] { return !kept_files(state).empty(); }, 0.2));  // no edit is complete yet
    d.button(0, false);
    d.frame();
    REQUIRE(settled(1));
    CHECK(kept_pose() == d.document().pose().positions);
    const auto first = d.document().pose().positions;

    const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
    d.press_and_move(at, at + glm::vec2(50, 5));
    CHECK(kept_pose() == first);
    d.press_key(workspace::Key::escape);
    d.button(0, false);
    CHECK(kept_pose() == first);

    d.press_key(workspace::key('Z'), true);
    REQUIRE(settled(0));
    d.press_key(workspace::key('Y'), true);
    REQUIRE(settled(1));
    REQUIRE(workspace::save_session(d.workspace(), folder / "a.viete"));
    d.frame();
    REQUIRE(settled(0));
    drag_some_vertex(d, {-30, 20});
  }
  CHECK_MESSAGE(kept_files(state).size() == 1, "quitting without saving keeps the work");
}

TEST_CASE("one_click_answers_for_all_recovered_edits_and_a_broken_file_stays_offered") {
  const test::TemporaryFolder folder;
  const fs::path state = folder / "state";
  fs::create_directories(state / "recovery");
  for (const char* name : {"999999999-1.viete", "999999999-2.viete"})
    test::put_file(state / "recovery" / name, name);
  const auto sessions = [&] {
    const auto files = kept_files(state);
    return std::count_if(files.begin(), files.end(), files::is_session);
  };
  {
    Driver d(remembering(state));
    d.frame(3);
    REQUIRE(d.workspace().recovery.files.size() == 2);
    d.click("restore_leftover");
    d.settle();
    CHECK(d.workspace().messages.all().back().severity == workspace::Severity::error);
    CHECK(d.workspace().recovery.files.size() == 2);
    d.click("put_off_leftovers");
    CHECK_FALSE(d.recorder().find("restore_leftover"));
    CHECK(sessions() == 2);
    d.press_key(workspace::key('B'), true);
    d.click("discard_leftovers");
    d.press_key(workspace::Key::enter);  // the button Cancel
    CHECK(sessions() == 2);
    d.click("discard_leftovers");
    d.click("question_save");
    CHECK_FALSE(d.recorder().find("restore_leftover"));
  }
  CHECK(kept_files(state).empty());
}

namespace {

void quit(Driver& d) {
  d.press_key(workspace::key('Q'), true);
}

}  // namespace

TEST_CASE("closing_asks_where_edits_could_not_be_kept_and_is_answered_with_the_keyboard") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state", recovery = state / "recovery";
  Driver d(remembering(state));
  REQUIRE(d.open({small.model, small.cage}));
  d.settle();
  drag_some_vertex(d, {30, 20});
  REQUIRE(wait_until([&] { return kept_files(state).size() == 1; }));
  fs::remove_all(recovery);
  test::put_file(recovery, "a file, not a folder");
  drag_some_vertex(d, {-20, 10});
  const auto ask = [&] {
    quit(d);
    REQUIRE(d.workspace().files.question);
    REQUIRE(d.workspace().files.question->kind == workspace::Question::Kind::close);
    CHECK_FALSE(d.viewer().closed());
  };
  ask();
  CHECK(d.workspace().files.question->why.find(recovery.string()) != std::string::npos);
  const auto posed = d.document().pose().positions;
  d.press_key(workspace::key('Z'), true);  // has no effect while the question is open
  d.press_key(workspace::Key::delete_key);
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.drag(at, at + glm::vec2(30, 30));
  CHECK(d.document().pose().positions == posed);
  constexpr int tab = 258, right = 262, left = 263;
  const auto press = [&](int key, int chosen) {
    d.press_key(key);
    CHECK(d.workspace().files.question->chosen == chosen);
  };
  press(tab, 1);
  press(left, 0);
  press(left, 2);
  press(right, 0);
  d.press_key(workspace::Key::escape);
  CHECK_FALSE(d.workspace().files.question);
  CHECK_FALSE(d.viewer().closed());
  CHECK(workspace::has_unsaved_edits(d.workspace()));

  ask();
  d.press_key(workspace::Key::enter);  // the button Save
  REQUIRE(d.workspace().files.browser.open);
  d.press_key(workspace::Key::escape);
  CHECK_FALSE(d.workspace().files.after_saving);
  CHECK_FALSE(d.viewer().closed());

  ask();
  d.click("question_save");
  REQUIRE(d.workspace().files.browser.open);
  d.press_key(workspace::Key::enter);
  CHECK(files::read_session(folder / "small.viete").pose.positions == posed);
  CHECK(d.viewer().closed());
}

// The next test runs this test in another process. This test logs when each edit begins and ends.
TEST_CASE("child_that_edits_until_it_is_killed" * doctest::skip()) {
  const fs::path folder = std::getenv("VIETE_TEST_FOLDER");
  const SmallModel small(folder);
  Driver d(remembering(folder / "state", {640, 400}));
  REQUIRE(d.open({small.model, small.cage}));
  d.workspace().view.options.panels = false;
  d.settle();
  const int log = open((folder / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  const auto say = [&](const char* what, double x) {
    char line[64];
    const int n = std::snprintf(line, sizeof line, "%s %.17g\n", what, x);
    REQUIRE(write(log, line, static_cast<std::size_t>(n)) == n);
  };
  const std::uint32_t v = d.free_vertex();
  std::mt19937 random(7);
  for (;;) {
    const glm::vec2 at = glm::round(d.vertex(v)), center(320, 200);
    const glm::vec2 by = glm::sign(center - at) * glm::vec2(static_cast<float>(5 + random() % 20),
                                                            static_cast<float>(5 + random() % 20));
    d.press_and_move(at, at + by);
    say("about", d.document().pose().positions[v][0]);
    d.button(0, false);
    d.frame();
    d.viewer().finish_keeping();  // waits until the edit is written
    say("done", d.document().pose().positions[v][0]);
  }
}

TEST_CASE("kill_9_at_any_moment_loses_at_most_the_running_drag" * doctest::test_suite(test::longer)) {
  std::mt19937 random(11);
  for (int round = 0; round < test::rounds(4, 40); ++round) {
    CAPTURE(round);
    const test::TemporaryFolder folder;
    const fs::path log = folder / "log";
    {
      Child child("env VIETE_TEST_FOLDER='" + folder.path().string() + "' '" +
                      fs::read_symlink("/proc/self/exe").string() +
                      "' --no-skip --test-case=child_that_edits_until_it_is_killed",
                  folder / "out");
      REQUIRE_MESSAGE(wait_until([&] { return fs::exists(log) && fs::file_size(log) > 60; }),
                      test::file_bytes(folder / "out"));
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 200000));
      child.kill_now();
    }
    // The recovery file has the last complete edit, or the edit that follows it.
    std::vector<double> allowed;
    std::ifstream lines(log);
    std::string what;
    for (double x = 0; lines >> what >> x;) {
      if (what == "done") allowed.clear();
      allowed.push_back(x);
    }
    REQUIRE_FALSE(allowed.empty());
    const auto recovery_files = files::find_recovery_files(folder / "state" / "recovery");
    REQUIRE(recovery_files.size() == 1);
    const auto positions = files::read_session(recovery_files[0].file).pose.positions;
    const auto holds = [&](double x) {
      return std::any_of(positions.begin(), positions.end(), [x](const auto& p) { return p[0] == x; });
    };
    CHECK(std::any_of(allowed.begin(), allowed.end(), holds));
  }
}
