#include "workspace/playing.h"

#include "document/cage_editing.h"
#include "document/elements.h"
#include "support/commands.h"
#include "support/edits.h"
#include "support/posed_cube.h"
#include "workspace/open_save.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;
using test::distance, test::turned_cube;

namespace {

// A timeline with ten frames per second. Keys: at rest (frame 1), half a turn (11), twice the width (31).
struct Played {
  Workspace w = test::cube_workspace();

  Played() {
    timeline() = test::three_keys();
    timeline().rate = 10;
    w.preferences.layout.timeline = true;
    for (PoseKey& key : timeline().keys) key.easing = Easing::constant_speed;
    follow_time(w, 0);
  }
  Document& document() { return w.document; }
  Timeline& timeline() { return w.document.changed_timeline(); }
  const std::vector<mesh::Point>& positions() const { return w.document.pose().positions; }
  void pass(double seconds) { follow_time(w, seconds); }
  void go_to(double frame) {
    go_to_frame(w, frame);
    pass(0);
  }
  void take_back() {
    undo(document());
    pass(0);
  }
  void put(const pose::Pose& pose) {
    record_edit(document(), "move by hand");
    document().changed_pose() = pose;
  }
  void hold_something() { w.view.interaction.brushing = SelectMode::replace; }
  std::size_t edits() const { return test::edit_count(w.document.history()); }
  bool stands_at(double degrees) const {
    return distance(positions(), turned_cube(degrees).positions) < 1e-12;
  }
};

}  // namespace

TEST_CASE("a_frame_shows_its_pose_and_its_camera_and_is_no_edit") {
  Played p;
  p.timeline().cameras = {{1, {.distance = 3}}, {11, {.distance = 12}}};
  go_to_frame(p.w, 6);
  CHECK(p.stands_at(90));
  CHECK(p.w.view.camera.pose().distance == doctest::Approx(6));
  go_to_frame(p.w, 11);
  CHECK(p.positions() == turned_cube(180).positions);
  go_to_frame(p.w, 3.5);
  CHECK(p.stands_at(45));
  CHECK(p.document().frame() == 3.5);
  CHECK(current_frame(p.document()) == 4);
  go_to_frame(p.w, 1e300);
  CHECK(p.document().frame() == Timeline::largest_frame);
  go_to_frame(p.w, std::nan(""));
  CHECK(p.document().frame() == Timeline::largest_frame);
  CHECK_FALSE(has_unkeyed_pose(p.w));
  CHECK(p.edits() == 0);
}

TEST_CASE("an_unkeyed_pose_survives_a_frame_change_unless_it_is_rest") {
  Played p;
  const auto lost_without_a_word = [&](auto change) {
    p.go_to(6);
    const std::size_t edits = p.edits();
    change();
    p.pass(0);
    CHECK(has_unkeyed_pose(p.w));
    const auto there = p.document().pose();
    const auto probes = p.document().probes();
    go_to_frame(p.w, 11);
    CHECK(p.positions() == turned_cube(180).positions);
    CHECK(p.edits() == edits + 2);
    undo(p.document());
    CHECK(p.positions() == there.positions);
    CHECK(p.document().probes() == probes);
    CHECK(p.document().frame() == 6);
    p.take_back();
    CHECK_FALSE(has_unkeyed_pose(p.w));
  };
  lost_without_a_word([&] { p.put(turned_cube(33)); });
  lost_without_a_word([&] {
    // A full turn changes the pose, but not the positions.
    pose::Pose pose = p.document().pose();
    pose.turns[0][2] += 2 * std::numbers::pi;
    p.put(pose);
  });
  p.document().changed_probes().all.resize(1);
  lost_without_a_word([&] {
    record_edit(p.document(), "move a probe");
    p.document().changed_probes().all[0].pose.move = {1, 2, 3};
  });
  go_to_frame(p.w, 6);
  reset_pose(p.document());
  p.pass(0);
  CHECK(has_unkeyed_pose(p.w));
  const std::size_t edits = p.edits();
  go_to_frame(p.w, 11);
  CHECK(p.edits() == edits);
}

TEST_CASE("commands_change_the_frame_while_the_timeline_is_open_and_with_keys_or_without") {
  Played p;
  const char* const steps[] = {"next_frame", "previous_frame", "first_frame", "last_frame"};
  const char* const to_keys[] = {"next_key", "previous_key"};
  const auto all_are = [&](bool enabled, auto& names) {
    for (const char* name : names) {
      CAPTURE(name);
      CHECK(find_command(name)->enabled(p.w) == enabled);
    }
  };
  all_are(true, steps);
  all_are(true, to_keys);
  p.timeline().keys.clear();
  all_are(true, steps);
  all_are(false, to_keys);
  CHECK(test::run_command(p.w, "next_frame"));
  CHECK(p.document().frame() == 2);
  p.timeline() = test::three_keys();
  p.w.preferences.layout.timeline = false;
  all_are(false, steps);
  all_are(false, to_keys);
  CHECK(find_command("play")->enabled(p.w));
}

TEST_CASE("a_key_that_is_set_opens_the_timeline_and_says_where") {
  Played p;
  const auto said = [&] { return p.w.messages.all().back().text; };
  const auto opens_by = [&](const char* command) {
    p.w.preferences.layout.timeline = false;
    return test::run_command(p.w, command) && p.w.preferences.layout.timeline;
  };
  CHECK(opens_by("set_key"));
  CHECK(said() == "Key at frame 1 replaced; undo restores the old one.");
  CHECK(opens_by("set_camera_key"));
  CHECK(said() == "Camera key set at frame 1.");
  go_to_frame(p.w, 40);
  CHECK(opens_by("set_key"));
  CHECK(said() == "Key set at frame 40.");
  CHECK(p.w.view.time.seen.last >= 40);
  CHECK(opens_by("turntable"));
  CHECK(said() == "Camera keys set from frame 1 to 40.");
}

TEST_CASE("an_unkeyed_pose_is_unsaved_work_after_being_replaced") {
  Played p;
  test::add_two_poses(p.document());
  const std::map<std::string, std::function<void()>> transitions{
      {"a step", [&] { test::run_command(p.w, "next_frame"); }},
      {"a key", [&] { test::run_command(p.w, "previous_key"); }},
      {"an end", [&] { test::run_command(p.w, "last_frame"); }},
      {"scrubbing",
       [&] {
         go_to_frame(p.w, 3.5);
         go_to_frame(p.w, 4);
       }},
      {"playing",
       [&] {
         test::run_command(p.w, "play");
         p.pass(0.2);
         test::run_command(p.w, "play");
       }},
      {"a pose", [&] { apply_pose(p.w, 0); }},
      {"a pose, then a step", [&] {
         apply_pose(p.w, 1);
         go_to_frame(p.w, 9);
       }}};
  for (const auto& [transition, go] : transitions) {
    CAPTURE(transition);
    p.go_to(6);
    mark_saved(p.w);
    p.put(turned_cube(33));
    p.pass(0);
    const std::size_t edits = p.edits();
    go();
    p.pass(0);
    CHECK(has_unsaved_edits(p.w));
    REQUIRE(p.timeline().unkeyed.size() == 1);
    CHECK(p.timeline().unkeyed[0].frame == 6);
    CHECK(p.timeline().unkeyed[0].pose->cage.positions == turned_cube(33).positions);
    while (p.edits() > edits) undo(p.document());
    CHECK(p.positions() == turned_cube(33).positions);
    CHECK(p.timeline().unkeyed.empty());
    p.take_back();
    CHECK_FALSE(has_unsaved_edits(p.w));
  }
}

TEST_CASE("a_stored_or_saved_pose_is_not_unsaved_work_at_other_frames") {
  Played p;
  go_to_frame(p.w, 6);
  p.put(turned_cube(33));
  keep_pose(p.document(), p.w.playback.vectors, "kept");
  mark_saved(p.w);
  go_to_frame(p.w, 11);
  CHECK(p.timeline().unkeyed.empty());
  CHECK_FALSE(has_unsaved_edits(p.w));
  p.put(turned_cube(44));
  mark_saved(p.w);
  go_to_frame(p.w, 6);
  CHECK_FALSE(has_unsaved_edits(p.w));
  mark_saved(p.w);  // saves the pose that is now in Timeline::unkeyed
  CHECK_FALSE(has_unsaved_edits(p.w));
  p.put(turned_cube(55));
  go_to_frame(p.w, 7);
  CHECK(p.timeline().unkeyed.size() == 2);
  CHECK(has_unsaved_edits(p.w));
}

TEST_CASE("a_mix_ends_where_time_goes_on_and_comes_back_with_undo") {
  Played p;
  test::add_two_poses(p.document());
  set_weight(p.document(), p.w.playback.vectors, 1, 0.5);
  go_to_frame(p.w, 6);
  CHECK(p.stands_at(90));
  CHECK_FALSE(p.document().library().mixes());
  undo(p.document());
  CHECK(p.document().library().poses[1].weight == 0.5);
}

TEST_CASE("weights_of_a_frame_are_those_that_its_keys_play_and_the_mix_goes_on_from_them") {
  Played p;
  test::add_two_poses(p.document());
  p.timeline().keys.clear();
  auto& vectors = p.w.playback.vectors;
  const auto weights_are = [&](double turned, double wide) {
    const std::vector<double> shown = shown_weights(p.w);
    REQUIRE(shown.size() == 2);
    CHECK(shown[0] == doctest::Approx(turned));
    CHECK(shown[1] == doctest::Approx(wide));
  };
  REQUIRE(set_weight(p.document(), vectors, 0, 0.4));
  REQUIRE(set_weight(p.document(), vectors, 1, 0.2));
  REQUIRE(test::run_command(p.w, "set_key"));
  go_to_frame(p.w, 11);
  weights_are(0.4, 0.2);
  apply_pose(p.w, 1);
  REQUIRE(test::run_command(p.w, "set_key"));
  for (PoseKey& key : p.timeline().keys) key.easing = Easing::constant_speed;
  p.pass(0);
  weights_are(0, 1);
  p.go_to(6);
  weights_are(0.2, 0.6);
  CHECK_FALSE(p.document().library().mixes());
  REQUIRE(test::run_command(p.w, "set_key"));  // sets a key with the played pose
  CHECK(p.timeline().keys[1].mix.size() == 2);
  p.take_back();

  const auto before = p.positions();
  REQUIRE(set_weight(p.document(), vectors, 0, 0.2 + 1e-7, shown_weights(p.w)));
  CHECK(distance(before, p.positions()) < 1e-5);
  weights_are(0.2, 0.6);
  CHECK(p.document().library().mixes());
  undo(p.document());
  CHECK(p.positions() == before);
  p.pass(0);

  rename_pose(p.document(), 0, "Wave");
  p.pass(0);
  weights_are(0.2, 0.6);
  p.go_to(1);
  update_pose(p.document(), 0);
  p.pass(0);
  CHECK(shown_weights(p.w)[0] == 1);
  remove_pose(p.document(), vectors, 1);
  CHECK(p.timeline().keys[0].mix.empty());
}

TEST_CASE("the_timeline_is_ignored_during_drags_and_cage_editing") {
  Played p;
  p.document().changed_selection().apply(std::vector<std::uint32_t>{0}, SelectMode::replace);
  p.hold_something();
  go_to_frame(p.w, 6);
  CHECK(p.document().frame() == 1);
  start_playing(p.w);
  CHECK_FALSE(p.w.playback.playing);
  p.w.view.interaction.brushing.reset();
  start_playing(p.w);
  p.pass(0.1);
  CHECK(p.w.playback.playing);
  p.hold_something();
  p.pass(0.1);
  CHECK_FALSE(p.w.playback.playing);
  p.w.view.interaction.brushing.reset();
  begin_cage_editing(p.document());
  p.pass(0);
  const double frame = p.document().frame();
  go_to_frame(p.w, 20);
  start_playing(p.w);
  p.pass(0.1);
  CHECK(p.document().frame() == frame);
  CHECK(p.positions() == test::cube(1.5).positions);
  CHECK(animation_of(p.w) == nullptr);
  end_cage_editing(p.document());
  go_to_frame(p.w, 6);
  CHECK(p.stands_at(90));
}

TEST_CASE("it_plays_by_seconds_and_comes_to_rest_at_a_whole_frame") {
  Played p;
  start_playing(p.w);
  p.pass(0.53);
  CHECK(p.document().frame() == doctest::Approx(6.3));
  CHECK(p.stands_at(95.4));
  stop_playing(p.w);
  CHECK(p.document().frame() == 6);
  CHECK(p.stands_at(90));
  p.pass(1);
  CHECK(p.document().frame() == 6);
  start_playing(p.w);
  p.pass(2.6);  // plays beyond the end and starts again
  CHECK(p.document().frame() == doctest::Approx(2));
  stop_playing(p.w);
  p.timeline().repeat = Repeat::once;
  start_playing(p.w);
  p.pass(100);
  CHECK_FALSE(p.w.playback.playing);
  CHECK(p.positions() == test::stretched_cube(2).positions);
  start_playing(p.w);
  CHECK(p.document().frame() == 1);
  CHECK(p.edits() == 0);
}

TEST_CASE("without_keys_nothing_plays") {
  Played p;
  p.timeline() = {};
  start_playing(p.w);
  p.pass(1);
  CHECK_FALSE(p.w.playback.playing);
  go_to_frame(p.w, 7);
  CHECK(p.document().frame() == 7);
  CHECK(p.positions() == test::cube(1.5).positions);
}

TEST_CASE("edits_of_the_timeline_are_seen_at_once_while_it_plays_too") {
  Played p;
  p.go_to(6);
  const Timeline before = p.timeline();
  move_keys(p.document(), before, KeyPlaces{11}, std::vector{21});
  p.pass(0);
  CHECK(p.stands_at(45));
  p.take_back();
  CHECK(p.stands_at(90));
  start_playing(p.w);
  p.pass(0.1);
  move_keys(p.document(), p.timeline(), KeyPlaces{11}, std::vector{21});
  p.pass(0.3);
  CHECK(p.w.playback.playing);
  CHECK(p.stands_at(81));
  reset_pose(p.document());  // stops the playback
  p.pass(0.1);
  CHECK_FALSE(p.w.playback.playing);
  CHECK(p.positions() == test::cube(1.5).positions);
  CHECK(has_unkeyed_pose(p.w));
  undo(p.document());
  start_playing(p.w);
  remove_keys(p.document(), KeyPlaces{1, 21, 31});
  p.pass(0.1);
  CHECK_FALSE(p.w.playback.playing);
}

TEST_CASE("auto_key_sets_a_key_within_the_same_edit") {
  Played p;
  p.w.playback.auto_key = true;
  p.go_to(21);
  set_radius(p.document(), 0.3);
  p.pass(0);
  undo(p.document());
  CHECK(p.timeline().keys.size() == 3);  // no new key, because the pose has not changed
  p.put(turned_cube(77));
  p.pass(0);
  REQUIRE(key_at(p.timeline(), 21));
  CHECK(key_at(p.timeline(), 21)->pose->cage.positions == turned_cube(77).positions);
  CHECK_FALSE(has_unkeyed_pose(p.w));
  CHECK(p.edits() == 1);
  p.pass(0);
  go_to_frame(p.w, 1);
  go_to_frame(p.w, 21);
  CHECK(p.positions() == turned_cube(77).positions);
  p.take_back();
  CHECK(p.timeline().keys.size() == 3);
  CHECK(p.edits() == 0);
  // Undo and redo do not set keys automatically.
  redo(p.document());
  p.pass(0);
  CHECK(p.timeline().keys.size() == 4);
  p.take_back();
  CHECK(p.timeline().keys.size() == 3);
  CHECK(p.document().history().can_redo());
}

TEST_CASE("steps_go_from_key_to_key_and_round") {
  Played p;
  p.timeline().cameras = {{5, {}}};
  std::vector<double> frames;
  for (int i = 0; i < 4; ++i) {
    go_to_key(p.w, true);
    frames.push_back(p.document().frame());
  }
  CHECK(frames == std::vector<double>{5, 11, 31, 1});
  for (double& frame : frames) {
    go_to_key(p.w, false);
    frame = p.document().frame();
  }
  CHECK(frames == std::vector<double>{31, 11, 5, 1});
  go_to_frame(p.w, 7.5);
  go_to_key(p.w, false);
  CHECK(p.document().frame() == 5);
}
