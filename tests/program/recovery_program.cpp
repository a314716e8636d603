// Work that outlives kill -9, and work set aside.
#include <random>

#include "program/kept_work.h"
#include "scene/edit.h"
#include "scene/saving.h"
#include "scene/transform.h"

using namespace viete;
using namespace test;
using What = scene::OpenRequest::What;

TEST_CASE("unsaved_edits_are_in_a_file_after_each_finished_edit_and_gone_when_saved_or_undone") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state";
  const auto kept_pose = [&] { return scene::read_session(kept_files(state).front()).pose->positions; };
  const auto settled = [&](std::size_t files) {
    return wait_until([&] { return kept_files(state).size() == files; }, 5);
  };
  {
    Driver d(remembering(state));
    REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
    d.settle();
    CHECK(kept_files(state).empty());
    drag_some_vertex(d, {30, 20});
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

TEST_CASE("what_a_killed_program_was_still_writing_goes_at_the_next_start") {
  const test::TemporaryFolder folder;
  const fs::path recovery = folder / "state" / "recovery", half = recovery / "9-1.viete.999999999-1-0.part";
  fs::create_directories(recovery);
  test::put_file(half, "half");
  const Driver d(remembering(folder / "state"));
  CHECK_FALSE(fs::exists(half));
}

TEST_CASE("a_whole_turn_and_another_reach_are_kept_without_a_moved_vertex") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state";
  Driver d(remembering(state));
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.settle();
  const auto settled = [&](std::size_t files) {
    d.settle();
    return wait_until([&] { return kept_files(state).size() == files; }, 5);
  };
  scene::set_reach(d.document(), 3);
  REQUIRE(settled(1));
  CHECK(scene::read_session(kept_files(state).front()).reach == 3);
  scene::set_reach(d.document(), deform::whole_cage);
  REQUIRE(settled(0));
  d.press_key(scene::key('A'));
  scene::Transform turn;
  turn.degrees = 360;
  scene::transform_selection(d.document(), scene::Tool::rotate, turn);
  REQUIRE(settled(1));
  const auto kept = scene::read_session(kept_files(state).front());
  CHECK(kept.pose->positions == d.document().cage->surface.positions);
  CHECK(kept.pose->turns[0] == d.document().pose.turns[0]);
}

TEST_CASE("opening_another_file_over_unsaved_edits_sets_them_aside_and_restore_brings_them_back") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state"));
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.settle();
  drag_some_vertex(d, {30, 20});
  const auto posed = d.document().pose.positions;
  const auto picture = rest_picture(d);
  d.workspace().requests.open = scene::OpenRequest{What::model, {dragon, dragon_cage}};
  d.settle();
  CHECK(d.document().model.path == dragon);
  REQUIRE(d.workspace().leftovers.size() == 1);
  CHECK(d.workspace().leftovers[0].name == "small.ply");

  d.frame(3);
  d.click("restore_leftover");
  d.settle();
  CHECK(d.document().pose.positions == posed);
  CHECK(d.workspace().leftovers.empty());
  CHECK(scene::has_unsaved_edits(d.workspace()));
  CHECK(render::difference(picture, rest_picture(d), 0) == 0);
  CHECK(wait_until([&] { return kept_files(folder / "state").size() == 1; }, 5));
  CHECK(scene::read_session(kept_files(folder / "state").front()).pose->positions == posed);
}

TEST_CASE("discarded_work_is_removed_and_work_put_off_stays") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state";
  fs::create_directories(state / "recovery");
  for (const char* name : {"999999999-1.viete", "999999999-2.viete"})
    test::put_file(state / "recovery" / name, "{}");
  Driver d(remembering(state));
  d.frame(3);
  REQUIRE(d.workspace().leftovers.size() == 2);
  d.click("put_off_leftover");
  d.frame(3);
  CHECK(kept_files(state).size() == 2);
  REQUIRE(d.workspace().leftovers.size() == 1);
  d.click("restore_leftover");  // it is broken: said, and still there
  d.settle();
  CHECK(d.workspace().messages.all().back().severity == scene::Severity::error);
  CHECK(d.workspace().leftovers.size() == 1);
  d.click("discard_leftover");
  d.frame(3);
  CHECK(d.workspace().leftovers.empty());
  CHECK(kept_files(state).size() == 1);
}

TEST_CASE("a_state_folder_that_cannot_be_written_is_said_once_and_nothing_breaks") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  test::put_file(folder / "state", "a file, not a folder");
  Driver d(remembering(folder / "state"));
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.settle();
  drag_some_vertex(d, {30, 20});
  d.frame(5);
  REQUIRE(wait_until(
      [&] {
        d.frame();
        return !d.workspace().messages.all().empty();
      },
      5));
  CHECK(d.workspace().messages.all().back().text.find((folder / "state").string()) != std::string::npos);
  CHECK(d.document().history.undo_count() == 1);
}

// Runs in a process of its own, see the next test: finishes edit after edit, and says in a log which one is
// about to be finished and which one is.
TEST_CASE("child_that_edits_until_it_is_killed" * doctest::skip()) {
  const fs::path folder = std::getenv("VIETE_TEST_FOLDER");
  const SmallModel small(folder);
  Driver d(remembering(folder / "state", {640, 400}));
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
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
    say("done", d.document().pose.positions[v][0]);
  }
}

TEST_CASE("kill_9_at_any_moment_loses_at_most_the_running_drag") {
  std::mt19937 random(11);
  for (int round = 0; round < 12; ++round) {
    CAPTURE(round);
    const test::TemporaryFolder folder;
    const fs::path log = folder / "log";
    {
      Child child("env VIETE_TEST_FOLDER='" + folder.path().string() + "' '" +
                      fs::read_symlink("/proc/self/exe").string() +
                      "' --no-skip --test-case=child_that_edits_until_it_is_killed",
                  folder / "out");
      REQUIRE_MESSAGE(wait_until([&] { return fs::exists(log) && fs::file_size(log) > 60; }, 60),
                      test::file_bytes(folder / "out"));
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 200000));
      child.kill_now();
    }
    // The edits that may be in the file: the last that was finished, and the one that was just being
    // finished.
    std::vector<double> allowed;
    std::ifstream lines(log);
    std::string what;
    for (double x = 0; lines >> what >> x;) {
      if (what == "done") allowed.clear();
      allowed.push_back(x);
    }
    REQUIRE_FALSE(allowed.empty());
    const auto leftovers = scene::find_leftovers(folder / "state" / "recovery");
    REQUIRE(leftovers.size() == 1);
    const auto positions = scene::read_session(leftovers[0].file).pose->positions;
    const auto holds = [&](double x) {
      return std::any_of(positions.begin(), positions.end(), [x](const auto& p) { return p[0] == x; });
    };
    CHECK(std::any_of(allowed.begin(), allowed.end(), holds));
  }
}

TEST_CASE("a_real_window_that_is_killed_offers_its_work_at_the_next_start") {
  if (test::no_desktop()) return;
  auto options = Driver::default_options();
  options.size = {1440, 900};
  Driver d(options);
  open_dragon(d);
  d.frame();
  const glm::ivec2 from(glm::round(d.vertex(d.free_vertex()))), to = from + glm::ivec2(72, -56);
  d.drag(from, to);

  Desktop desktop;
  Child viewer(desktop.viete(""), desktop.folder / "first.log");
  desktop.xdotool("search --sync --onlyvisible --name dragon");
  std::this_thread::sleep_for(std::chrono::seconds(3));
  desktop.drag(from, to);
  REQUIRE(wait_until([&] { return !kept_files(desktop.folder / "state" / "viete").empty(); }, 20));
  viewer.kill_now();
  const auto leftovers = scene::find_leftovers(desktop.folder / "state" / "viete" / "recovery");
  REQUIRE(leftovers.size() == 1);
  CHECK(leftovers[0].name == "dragon.ply");
  const auto kept = scene::read_session(leftovers[0].file).pose->positions;
  CHECK(kept == d.document().pose.positions);

  Child again(desktop.viete(""), desktop.folder / "second.log");
  desktop.xdotool("search --sync --onlyvisible --name dragon");
  const auto restored = [&] {
    desktop.xdotool("key ctrl+b");  // does nothing before there is something to restore, and afterwards
    std::this_thread::sleep_for(std::chrono::seconds(1));
    return !fs::exists(leftovers[0].file);
  };
  REQUIRE(wait_until(restored, 5));  // a hundred times
  const auto files = kept_files(desktop.folder / "state" / "viete");
  REQUIRE(files.size() == 1);
  CHECK(scene::read_session(files[0]).pose->positions == kept);
  desktop.xdotool("key ctrl+z");  // recovered work has no history: nothing happens
  desktop.xdotool("key ctrl+q");
  REQUIRE(wait_until([&] { return again.finished(); }, 20));
  CHECK(again.exit_code() == 0);
  CHECK(test::file_bytes(desktop.folder / "second.log").find("unsaved edits are kept") != std::string::npos);
}
