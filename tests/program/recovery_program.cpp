// Work that survives kill -9, and work set aside.
#include <random>

#include "program/kept_work.h"
#include "scene/document/edit.h"
#include "scene/document/time_edit.h"
#include "scene/hand/grip.h"
#include "scene/hand/placing.h"
#include "scene/hand/transform.h"
#include "scene/workspace/saving.h"
#include "support/edits.h"
#include "support/grips.h"
#include "support/longer.h"
#include "support/pictures.h"

using namespace viete;
using namespace test;

TEST_CASE("unsaved_edits_are_in_a_file_after_each_finished_edit_and_gone_when_saved_or_undone") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state";
  const auto kept_pose = [&] { return scene::read_session(kept_files(state).front()).pose->positions; };
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
    CHECK(scene::has_unsaved_edits(d.workspace()));
    CHECK_FALSE(wait_until([&] { return !kept_files(state).empty(); }, 0.2));  // no edit is finished yet
    d.button(0, false);
    d.frame();
    REQUIRE(settled(1));
    CHECK(kept_pose() == d.document().pose.positions);
    const auto first = d.document().pose.positions;

    const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
    d.press_and_move(at, at + glm::vec2(50, 5));
    CHECK(kept_pose() == first);
    d.press_key(scene::Key::escape);
    d.button(0, false);
    CHECK(kept_pose() == first);

    d.press_key(scene::key('Z'), true);
    REQUIRE(settled(0));
    d.press_key(scene::key('Y'), true);
    REQUIRE(settled(1));
    REQUIRE(scene::save_session(d.workspace(), folder / "a.viete"));
    d.frame();
    REQUIRE(settled(0));
    drag_some_vertex(d, {-30, 20});
  }
  CHECK_MESSAGE(kept_files(state).size() == 1, "quitting without saving keeps the work");
}

TEST_CASE("partial_files_of_a_killed_program_are_deleted_at_the_next_start") {
  const test::TemporaryFolder folder;
  const fs::path recovery = folder / "state" / "recovery", half = recovery / "9-1.viete.999999999-1-0.part";
  fs::create_directories(recovery);
  test::put_file(half, "half");
  const Driver d(remembering(folder / "state"));
  CHECK_FALSE(fs::exists(half));
}

TEST_CASE("opening_another_file_over_unsaved_edits_sets_them_aside_and_restore_brings_them_back") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state"), test::with_pixels);
  REQUIRE(d.open({small.model, small.cage}));
  d.settle();
  drag_some_vertex(d, {30, 20});
  const auto posed = d.document().pose.positions;
  const auto picture = rest_picture(d);
  d.open_dragon();
  CHECK(d.document().model.path == dragon);
  REQUIRE(d.workspace().recovery_files.size() == 1);
  CHECK(d.workspace().recovery_files[0].name == "small.ply");

  d.frame(3);
  CHECK_FALSE(d.viewer().recorder().find("restore_leftover"));  // not requested
  d.press_key(scene::key('B'), true);
  d.frame(3);
  d.click("restore_leftover");
  d.settle();
  CHECK(d.document().pose.positions == posed);
  CHECK(d.workspace().recovery_files.empty());
  CHECK(scene::has_unsaved_edits(d.workspace()));
  CHECK(test::difference(picture, rest_picture(d), 0) == 0);
  CHECK(wait_until([&] { return kept_files(folder / "state").size() == 1; }));
  CHECK(scene::read_session(kept_files(folder / "state").front()).pose->positions == posed);
}

TEST_CASE("one_click_answers_for_all_recovered_edits_and_a_broken_file_stays_offered") {
  const test::TemporaryFolder folder;
  const fs::path state = folder / "state";
  fs::create_directories(state / "recovery");
  for (const char* name : {"999999999-1.viete", "999999999-2.viete"})
    test::put_file(state / "recovery" / name, name);
  const auto sessions = [&] {
    const auto files = kept_files(state);
    return std::count_if(files.begin(), files.end(), scene::is_session);
  };
  {
    Driver d(remembering(state));
    d.frame(3);
    REQUIRE(d.workspace().recovery_files.size() == 2);
    d.click("restore_leftover");
    d.settle();
    CHECK(d.workspace().messages.all().back().severity == scene::Severity::error);
    CHECK(d.workspace().recovery_files.size() == 2);
    d.click("put_off_leftovers");
    d.frame(3);
    CHECK_FALSE(d.viewer().recorder().find("restore_leftover"));
    CHECK(sessions() == 2);
    d.press_key(scene::key('B'), true);
    d.frame(3);
    d.click("discard_leftovers");
    d.frame(3);
    d.press_key(scene::Key::enter);  // Cancel
    d.frame(3);
    CHECK(sessions() == 2);
    d.click("discard_leftovers");
    d.frame(3);
    d.click("question_save");
    d.frame(3);
    CHECK_FALSE(d.viewer().recorder().find("restore_leftover"));
  }
  CHECK(kept_files(state).empty());
}

TEST_CASE("an_unwritable_state_folder_is_reported_once_and_is_harmless") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  test::put_file(folder / "state", "a file, not a folder");
  Driver d(remembering(folder / "state"));
  REQUIRE(d.open({small.model, small.cage}));
  d.settle();
  drag_some_vertex(d, {30, 20});
  d.frame(5);
  REQUIRE(d.until([&] { return !d.workspace().messages.all().empty(); }));
  CHECK(d.workspace().messages.all().back().text.find((folder / "state").string()) != std::string::npos);
  CHECK(test::edit_count(d.document().history) == 1);
}

namespace {

// Replaces the recovery folder by a file, so that writing fails.
void break_recovery(const fs::path& state) {
  fs::remove_all(state / "recovery");
  fs::create_directories(state);
  test::put_file(state / "recovery", "a file, not a folder");
}

void mend_recovery(const fs::path& state) {
  fs::remove(state / "recovery");
}

void quit(Driver& d) {
  d.press_key(scene::key('Q'), true);
  d.frame(3);
}

struct Unkept {
  test::TemporaryFolder folder;
  SmallModel small{folder.path()};
  fs::path state = folder / "state";
  Driver d{remembering(state)};

  Unkept() {
    REQUIRE(d.open({small.model, small.cage}));
    d.settle();
    drag_some_vertex(d, {30, 20});
    REQUIRE(wait_until([&] { return kept_files(state).size() == 1; }));
    break_recovery(state);
    drag_some_vertex(d, {-20, 10});
  }
  bool asks(scene::Question::Kind kind) {
    const auto& question = d.workspace().question;
    return question && question->kind == kind;
  }
};

using Kind = scene::Question::Kind;

}  // namespace

TEST_CASE("closing_asks_where_edits_could_not_be_kept_and_cancel_leaves_everything_as_it_was") {
  Unkept u;
  quit(u.d);
  REQUIRE(u.asks(Kind::close));
  CHECK_FALSE(u.d.viewer().closed());
  CHECK_FALSE(u.d.viewer().keeping());
  CHECK(u.d.workspace().question->why.find((u.state / "recovery").string()) != std::string::npos);
  const auto posed = u.d.document().pose.positions;
  u.d.press_key(scene::key('Z'), true);  // blocked by the question
  u.d.press_key(scene::Key::delete_key);
  const glm::vec2 at = glm::round(u.d.vertex(u.d.free_vertex()));
  u.d.drag(at, at + glm::vec2(30, 30));
  CHECK(u.d.document().pose.positions == posed);
  u.d.press_key(scene::Key::escape);
  u.d.frame(3);
  CHECK_FALSE(u.d.workspace().question);
  CHECK_FALSE(u.d.viewer().closed());
  CHECK(scene::has_unsaved_edits(u.d.workspace()));
}

TEST_CASE("closing_does_not_ask_once_edits_can_be_kept_again") {
  Unkept u;
  quit(u.d);
  REQUIRE(u.asks(Kind::close));
  u.d.click("question_cancel");
  mend_recovery(u.state);
  quit(u.d);
  CHECK(u.d.viewer().closed());
  CHECK(u.d.viewer().keeping());
  REQUIRE(kept_files(u.state).size() == 1);
  CHECK(scene::read_session(kept_files(u.state).front()).pose->positions == u.d.document().pose.positions);
}

TEST_CASE("enter_saves_and_closes_and_a_save_that_is_called_off_or_fails_closes_nothing") {
  Unkept u;
  Driver& d = u.d;
  quit(d);
  d.press_key(scene::Key::enter);
  d.frame(3);
  REQUIRE(d.workspace().browser.open);
  d.press_key(scene::Key::escape);
  d.frame(3);
  CHECK_FALSE(d.workspace().after_saving);
  CHECK_FALSE(d.viewer().closed());

  d.workspace().saved.session = u.folder / "none" / "a.viete";
  quit(d);
  d.press_key(scene::Key::enter);
  d.frame(3);
  REQUIRE(u.asks(Kind::close));
  CHECK(d.workspace().question->why.find("a.viete") != std::string::npos);
  d.press_key(scene::Key::escape);
  d.frame(3);
  CHECK_FALSE(d.viewer().closed());

  d.workspace().saved.session.clear();
  quit(d);
  d.click("question_save");
  d.frame(3);
  REQUIRE(d.workspace().browser.open);
  d.press_key(scene::Key::enter);
  d.frame(3);
  CHECK(d.viewer().closed());
  CHECK(scene::read_session(u.folder / "small.viete").pose->positions == d.document().pose.positions);
}

TEST_CASE("the_answers_are_walked_with_tab_and_arrows_and_closing_without_saving_closes") {
  Unkept u;
  quit(u.d);
  REQUIRE(u.asks(Kind::close));
  constexpr int tab = 258, right = 262, left = 263;
  u.d.press_key(tab);
  CHECK(u.d.workspace().question->chosen == 1);
  u.d.press_key(tab, false, true);
  u.d.press_key(left);
  CHECK(u.d.workspace().question->chosen == 2);
  u.d.press_key(right);
  CHECK(u.d.workspace().question->chosen == 0);
  u.d.press_key(left);
  u.d.press_key(scene::Key::enter);
  u.d.frame(3);
  CHECK(u.d.viewer().closed());
  CHECK_FALSE(u.d.viewer().keeping());
}

TEST_CASE("without_a_home_folder_closing_asks_and_without_edits_it_does_not") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  for (const bool edited : {false, true}) {
    CAPTURE(edited);
    Driver d;
    REQUIRE(d.open({small.model, small.cage}));
    d.settle();
    if (edited) drag_some_vertex(d, {30, 20});
    quit(d);
    CHECK(d.viewer().closed() == !edited);
    REQUIRE(d.workspace().question.has_value() == edited);
    if (edited) CHECK(d.workspace().question->why.find("no home folder") != std::string::npos);
  }
}

TEST_CASE("another_file_takes_the_place_of_edits_that_could_not_be_set_aside_only_when_told_to") {
  Unkept u;
  Driver& d = u.d;
  const auto open_cage_as_model = [&] {
    CHECK_FALSE(d.open({u.small.cage}));
    d.frame(2);
  };
  open_cage_as_model();
  REQUIRE(u.asks(Kind::open));
  CHECK(d.document().model.path == u.small.model);
  d.click("question_cancel");
  d.frame(2);
  CHECK(d.document().model.path == u.small.model);
  CHECK(scene::has_unsaved_edits(d.workspace()));

  open_cage_as_model();
  d.click("question_save");
  d.frame(3);
  d.press_key(scene::Key::enter);
  d.frame(3);
  CHECK(d.document().model.path == u.small.cage);
  CHECK(fs::exists(u.folder / "small.viete"));
}

TEST_CASE("edits_of_a_model_whose_name_is_not_utf_8_are_kept") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state", odd = folder / "caf\xe9.ply";
  fs::rename(small.model, odd);
  {
    Driver d(remembering(state));
    REQUIRE(d.open({odd, small.cage}));
    d.settle();
    drag_some_vertex(d, {30, 20});
    quit(d);
    CHECK(d.viewer().closed());
    CHECK(d.viewer().keeping());
  }
  REQUIRE(kept_files(state).size() == 1);
  CHECK(scene::read_session(kept_files(state).front()).model == odd);
  CHECK(scene::read_preferences(state / "remembered.json").recent.at(0).file == odd);
}

TEST_CASE("an_unkeyed_pose_can_be_restored_after_a_frame_change_and_reopening") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state", session = folder / "a.viete";
  for (const scene::Key key : {scene::Key::right, scene::Key::space, scene::Key::up}) {
    CAPTURE(static_cast<int>(key));
    std::vector<mesh::Point> posed;
    {
      Driver d(remembering(state));
      REQUIRE(d.open({small.model, small.cage}));
      d.settle();
      d.press_key(scene::key('I'));
      drag_some_vertex(d, {30, 20});
      scene::set_key(d.document(), 11);
      REQUIRE(scene::save_session(d.workspace(), session));
      d.frame(3);
      drag_some_vertex(d, {20, -20});
      posed = d.document().pose.positions;
      d.press_key(key);
      d.frame(3);
      CHECK(d.document().pose.positions != posed);
      CHECK(scene::has_unsaved_edits(d.workspace()));
      quit(d);
      CHECK(d.viewer().closed());
      CHECK(d.viewer().keeping());
    }
    REQUIRE(kept_files(state).size() == 1);
    fs::rename(kept_files(state).front(),
               state / "recovery" / "999999999-1.viete");  // of an ended process
    Driver again(remembering(state));
    again.frame(3);
    again.click("restore_leftover");
    again.settle();
    CHECK(again.document().pose.positions == posed);
    CHECK(scene::has_unsaved_edits(again.workspace()));
    REQUIRE(scene::save_session(again.workspace(), session));
    again.frame(3);
    REQUIRE(wait_until([&] { return kept_files(state).empty(); }));
  }
}

// Runs in its own process, see the next test: makes edits and logs the start and end of each.
TEST_CASE("child_that_edits_until_it_is_killed" * doctest::skip()) {
  const fs::path folder = std::getenv("VIETE_TEST_FOLDER");
  const SmallModel small(folder);
  Driver d(remembering(folder / "state", {640, 400}));
  REQUIRE(d.open({small.model, small.cage}));
  d.workspace().view.panels = false;
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
    say("about", d.document().pose.positions[v][0]);
    d.button(0, false);
    d.frame();
    d.viewer().finish_keeping();  // edits are written in the background, and these come without a pause
    say("done", d.document().pose.positions[v][0]);
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
    // The edits that the file may contain: the last finished one, and the one in progress.
    std::vector<double> allowed;
    std::ifstream lines(log);
    std::string what;
    for (double x = 0; lines >> what >> x;) {
      if (what == "done") allowed.clear();
      allowed.push_back(x);
    }
    REQUIRE_FALSE(allowed.empty());
    const auto recovery_files = scene::find_recovery_files(folder / "state" / "recovery");
    REQUIRE(recovery_files.size() == 1);
    const auto positions = scene::read_session(recovery_files[0].file).pose->positions;
    const auto holds = [&](double x) {
      return std::any_of(positions.begin(), positions.end(), [x](const auto& p) { return p[0] == x; });
    };
    CHECK(std::any_of(allowed.begin(), allowed.end(), holds));
  }
}

TEST_CASE("a_real_window_that_is_killed_offers_its_work_at_the_next_start" *
          doctest::test_suite(test::if_present)) {
  if (test::no_desktop()) return;
  auto options = Driver::default_options();
  options.size = {1440, 900};
  Driver d(options);
  d.open_dragon("", test::bundled_dragon);
  d.frame();
  const glm::ivec2 from(glm::round(d.vertex(d.free_vertex()))), to = from + glm::ivec2(72, -56);
  d.drag(from, to);

  Desktop desktop;
  Child viewer(desktop.viete(""), desktop.folder / "first.log");
  desktop.xdotool("search --sync --onlyvisible --name dragon");
  desktop.rest();
  desktop.drag(from, to);
  REQUIRE(wait_until([&] { return !kept_files(desktop.folder / "state" / "viete").empty(); }));
  viewer.kill_now();
  const auto recovery_files = scene::find_recovery_files(desktop.folder / "state" / "viete" / "recovery");
  REQUIRE(recovery_files.size() == 1);
  CHECK(recovery_files[0].name == "dragon.ply");
  const auto kept = scene::read_session(recovery_files[0].file).pose->positions;
  CHECK(kept == d.document().pose.positions);

  Child again(desktop.viete(""), desktop.folder / "second.log");
  desktop.xdotool("search --sync --onlyvisible --name dragon");
  const auto recovery = desktop.folder / "state" / "viete" / "recovery";
  const auto ended = [&] { return scene::find_recovery_files(recovery); };
  desktop.rest();
  desktop.xdotool("key ctrl+b");
  desktop.rest();
  CHECK(fs::exists(recovery_files[0].file));
  const auto edited = [&] {
    desktop.drag(to, from + glm::ivec2(20, 10));  // not to rest, which would equal the cage's file
    return !fs::exists(recovery_files[0].file);   // its work is now in the running program's file
  };
  REQUIRE(wait_until(edited));
  CHECK(ended().empty());
  desktop.xdotool("key ctrl+q");
  REQUIRE(wait_until([&] { return again.finished(); }));
  CHECK(again.exit_code() == 0);
  CHECK(test::file_bytes(desktop.folder / "second.log").find("unsaved edits were saved") !=
        std::string::npos);
  REQUIRE(ended().size() == 1);
  CHECK_FALSE(ended()[0].restored);
}
