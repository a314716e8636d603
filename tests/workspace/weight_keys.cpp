// Keys of the weights of named poses: their evaluation, their edits, and the sliders.

#include "document/cage_editing.h"
#include "document/edit.h"
#include "document/elements.h"
#include "document/pose_edit.h"
#include "document/time_edit.h"
#include "support/commands.h"
#include "support/data.h"
#include "support/edits.h"
#include "support/open.h"
#include "support/posed_cube.h"
#include "workspace/playing.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;

namespace {

// A cube with the named poses "turned" and "wide".
struct Weighted {
  Workspace w = test::cube_workspace();

  Weighted() { test::add_two_poses(w.document); }
  Document& document() { return w.document; }
  const Timeline& timeline() { return w.document.timeline(); }
  std::size_t edits() { return test::edit_count(w.document.history()); }
  void put_keys(std::vector<WeightKey> keys) {
    Timeline& t = w.document.changed_timeline();
    t.last = 31;
    t.channels.push_back({"turned", document().library().poses[0].pose, std::move(keys)});
    pass();
  }
  void put_pose_keys() {
    w.document.changed_timeline() = test::three_keys();
    w.document.changed_timeline().keys[2] = test::key(31, test::stretched_cube(3));  // not a named pose
    pass();
  }
  void pass() { follow_time(w, 0); }
  void go_to(double frame) {
    go_to_frame(w, frame);
    pass();
  }
  void weigh(std::size_t pose, double weight) {
    change_mix(w, [&] { return set_weight(w.document, w.playback.vectors, pose, weight, shown_weights(w)); });
    pass();
  }
  void press_i(std::optional<std::size_t> slider = {}) {
    w.panels.hovered_weight = slider;
    REQUIRE(test::run_command(w, "set_key"));
    w.panels.hovered_weight.reset();
    pass();
  }
  // Sets keys of the whole pose: turned at frame 1, at rest at frame 21.
  void key_turned_and_rest() {
    w.document.changed_timeline().last = 21;
    weigh(0, 1);
    press_i();
    go_to(21);
    weigh(0, 0);
    press_i();
  }
  void take_back() {
    undo(w.document);
    pass();
  }
  double weight(std::size_t pose) { return shown_weights(w)[pose]; }
  const std::vector<mesh::Point>& positions() { return w.document.pose().positions; }
  bool is_turned_by(double degrees) {
    return test::distance(positions(), test::turned_cube(degrees).positions) < 1e-12;
  }
  // The cube turned by the angle, then `factor` times as wide along its own x axis.
  std::vector<mesh::Point> turned_and_wide(double degrees, double factor) {
    return test::turned(test::stretched_cube(factor).positions, degrees);
  }
};

}  // namespace

TEST_CASE("a_weight_is_eased_between_its_keys_and_constant_outside") {
  Timeline t;
  t.repeat = Repeat::once;
  const Channel channel{"a",
                        nullptr,
                        {{10, 1, Easing::constant_speed},
                         {20, 2, Easing::hold},
                         {30, -1, Easing::smooth},
                         {40, 1, Easing::smooth}}};
  const std::pair<double, double> known[] = {{-100, 1}, {10, 1}, {15, 1.5}, {20, 2}, {29.9, 2},
                                             {30, -1},  {35, 0}, {40, 1},   {99, 1}};
  for (const auto& [frame, weight] : known) {
    CAPTURE(frame);
    CHECK(weight_at(t, channel, frame) == doctest::Approx(weight));
  }
  CHECK(weight_at(t, channel, 32.5) == doctest::Approx(-1 + 2 * (3.0 / 16 - 2.0 / 64)));
  t.channels = {channel};
  CHECK(weight_at(t, "a", 15) == doctest::Approx(1.5));
  CHECK(weight_at(t, "b", 15) == 0);
}

TEST_CASE("the_weight_of_a_loop_with_equal_ends_does_not_stop_at_its_ends") {
  Timeline t;
  const Channel channel{"a", nullptr, {{0, 0}, {10, 1}, {30, -1}, {40, 0}}};
  const auto slope = [&] { return weight_at(t, channel, 0.01) / 0.01; };
  t.repeat = Repeat::loop;
  CHECK(slope() == doctest::Approx(0.1).epsilon(0.01));
  t.repeat = Repeat::once;
  CHECK(slope() < 0.01);
}

TEST_CASE("keyed_weights_play_upon_the_rest_pose_or_the_keyed_poses") {
  Weighted p;
  p.put_keys({{1, 0, Easing::constant_speed}, {11, 1}});
  for (const auto& [frame, degrees] :
       {std::pair(1.0, 0.0), {6.0, 45.0}, {3.5, 22.5}, {11.0, 90.0}, {99.0, 90.0}}) {
    p.go_to(frame);
    CHECK(p.is_turned_by(degrees));
    CHECK(p.weight(0) == doctest::Approx(degrees / 90));
    CHECK_FALSE(has_unkeyed_pose(p.w));
  }
  p.go_to(11);
  CHECK(p.positions() == test::turned_cube(90).positions);  // a single pose of weight 1 is exact
  CHECK(p.edits() == 0);
  p.document().changed_timeline().keys = {test::key(1, test::stretched_cube(2))};
  p.pass();
  p.go_to(6);
  CHECK(test::distance(p.positions(), p.turned_and_wide(45, 2)) < 1e-9);
}

TEST_CASE("a_slider_with_a_key_shows_the_same_bits_as_its_mix") {
  for (const bool linear : {false, true})
    for (const bool upon_keys : {false, true}) {
      CAPTURE(linear);
      CAPTURE(upon_keys);
      Weighted p;
      if (upon_keys) p.put_pose_keys();
      p.document().changed_timeline().linear = linear;
      p.go_to(6);
      p.weigh(0, 0.37);
      p.weigh(1, 0.6);
      const auto mixed = p.positions();
      p.press_i(0);
      p.press_i(1);
      CHECK(p.positions() == mixed);
      CHECK_FALSE(has_unkeyed_pose(p.w));
      p.go_to(20);
      if (upon_keys) CHECK(p.positions() != mixed);
      p.go_to(6);
      CHECK(p.positions() == mixed);
      CHECK(p.weight(0) == doctest::Approx(0.37));
      // The export computes the frame without the window.
      VectorCache vectors;
      vectors.follow(p.document().cage());
      CHECK(Animation(p.timeline(), vectors).at(6).cage.positions == mixed);
    }
}

TEST_CASE("i_over_a_slider_sets_a_key_replaces_it_and_deletes_it") {
  Weighted p;
  p.weigh(0, 0.5);
  p.press_i(0);
  REQUIRE(p.timeline().channels.size() == 1);
  CHECK(p.timeline().channels[0].name == "turned");
  CHECK(p.timeline().channels[0].keys == std::vector<WeightKey>{{1, 0.5}});
  CHECK(p.timeline().keys.empty());
  CHECK(p.document().history().undo_label() == "set key of turned");
  CHECK(p.w.view.time.selected == KeyPlaces{{1, "turned"}});
  CHECK(p.w.preferences.layout.timeline);
  p.weigh(0, 0.75);
  p.press_i(0);
  CHECK(p.timeline().channels[0].keys == std::vector<WeightKey>{{1, 0.75}});
  p.press_i(0);
  CHECK(p.timeline().channels.empty());
  CHECK(p.document().history().undo_label() == "delete keys");
  p.take_back();
  CHECK(p.timeline().channels[0].keys == std::vector<WeightKey>{{1, 0.75}});
  CHECK(p.weight(0) == 0.75);
  for (int i = 0; i < 3; ++i) p.take_back();
  CHECK(p.timeline().empty());
  CHECK(p.weight(0) == 0.5);
  p.w.view.chosen_pose = 1;
  REQUIRE(test::run_command(p.w, "key_weight"));
  CHECK(p.timeline().channels.at(0).name == "wide");
}

TEST_CASE("auto_key_sets_keys_of_moved_sliders_within_the_same_edit") {
  Weighted p;
  p.put_keys({{1, 0}});
  p.w.playback.auto_key = true;
  p.go_to(11);
  const std::size_t edits = p.edits();
  for (const double weight : {0.1, 0.3, 0.8}) p.weigh(0, weight);
  CHECK(p.edits() == edits + 1);
  CHECK(p.timeline().channels[0].keys == std::vector<WeightKey>{{1, 0}, {11, 0.8}});
  CHECK(p.timeline().keys.empty());
  p.weigh(1, 0.4);
  REQUIRE(p.timeline().channels.size() == 2);
  CHECK(p.timeline().channels[1].keys == std::vector<WeightKey>{{11, 0.4}});
  CHECK_FALSE(has_unkeyed_pose(p.w));
  p.go_to(6);
  CHECK(p.weight(0) == doctest::Approx(0.4));
  p.weigh(1, 0.9);
  CHECK(p.edits() == edits + 3);  // another frame is another edit
  p.go_to(11);
  p.weigh(1, 0);
  p.weigh(0, 0);
  CHECK(p.timeline().channels[0].keys.back().weight == 0);
  CHECK_FALSE(has_unkeyed_pose(p.w));
  for (int i = 0; i < 5; ++i) p.take_back();
  REQUIRE(p.timeline().channels.size() == 1);
  CHECK(p.timeline().channels[0].keys.size() == 1);
}

TEST_CASE("a_slider_moved_without_a_key_is_an_unkeyed_pose") {
  Weighted p;
  p.put_keys({{1, 0, Easing::constant_speed}, {11, 1}});
  p.go_to(6);
  p.weigh(0, 0.9);
  CHECK(has_unkeyed_pose(p.w));
  CHECK(p.is_turned_by(81));
  p.go_to(1);
  CHECK(p.is_turned_by(0));
  p.take_back();
  CHECK(p.is_turned_by(81));
  CHECK(p.weight(0) == doctest::Approx(0.9));
}

TEST_CASE("clear_weights_clears_the_sliders_that_show_keyed_weights") {
  for (const bool auto_key : {false, true}) {
    CAPTURE(auto_key);
    Weighted p;
    p.put_keys({{1, 0, Easing::constant_speed}, {11, 1}});
    p.w.playback.auto_key = auto_key;
    p.go_to(1);
    CHECK_FALSE(test::run_command(p.w, "clear_mix"));
    p.go_to(6);
    REQUIRE(test::run_command(p.w, "clear_mix"));
    p.pass();
    CHECK(p.weight(0) == 0);
    CHECK(p.is_turned_by(0));
    CHECK(has_unkeyed_pose(p.w) != auto_key);
    CHECK(p.timeline().channels[0].keys.size() == (auto_key ? 3 : 2));
    CHECK(p.edits() == 1);
    p.take_back();
    CHECK(p.weight(0) == doctest::Approx(0.5));
  }
}

TEST_CASE("a_key_of_a_weight_does_not_move_the_camera_to_its_keys") {
  Weighted p;
  p.key_turned_and_rest();
  CameraPose camera = p.w.view.camera.pose();
  set_camera_key(p.document(), 1, camera);
  p.pass();
  p.go_to(11);
  camera.yaw += 1;
  p.w.view.camera.set_pose(camera);
  p.weigh(0, 0.8);
  p.press_i(0);
  CHECK_FALSE(has_unkeyed_pose(p.w));
  CHECK(p.w.view.camera.pose() == camera);
}

TEST_CASE("a_key_of_the_pose_does_not_contain_keyed_weights") {
  Weighted p;
  p.put_keys({{1, 0, Easing::constant_speed}, {11, 1, Easing::constant_speed}, {21, 0}});
  p.go_to(6);
  record_edit(p.document(), "stretch");
  p.document().changed_pose().positions = p.turned_and_wide(45, 2);
  p.document().changed_pose().turns = test::turned_cube(45).turns;
  p.pass();
  CHECK(p.weight(0) == doctest::Approx(0.5));  // the slider still moves the pose
  p.press_i();
  REQUIRE(p.timeline().keys.size() == 1);
  CHECK(test::distance(p.timeline().keys[0].pose->cage.positions, test::stretched_cube(2).positions) < 1e-9);
  CHECK(p.timeline().channels[0].keys.size() == 3);  // the weight has not changed
  CHECK(test::distance(p.positions(), p.turned_and_wide(45, 2)) < 1e-9);
  CHECK_FALSE(has_unkeyed_pose(p.w));
  p.go_to(11);
  CHECK(test::distance(p.positions(), p.turned_and_wide(90, 2)) < 1e-9);
  p.weigh(0, 0.25);
  p.weigh(1, 0.5);
  const auto mixed = p.positions();
  p.press_i();
  CHECK(p.timeline().channels[0].keys[1].weight == 0.25);
  CHECK(p.timeline().keys[1].mix == std::vector<MixedPose>{{"wide", 0.5}});
  CHECK(test::distance(p.positions(), mixed) < 1e-9);
  CHECK_FALSE(has_unkeyed_pose(p.w));
  CHECK(p.weight(0) == doctest::Approx(0.25));
  CHECK(p.weight(1) == doctest::Approx(0.5));
}

TEST_CASE("a_key_of_a_pose_upon_keyed_weights_does_not_move_a_cage_that_turns_and_bends") {
  Workspace w;
  REQUIRE(
      test::open_now(w, {files::OpenRequest::What::model, {test::assets_dir() / "dragon" / "loop.viete"}}));
  follow_time(w, 0);
  set_weight_key(w.document, 0, 1, 1);
  follow_time(w, 0);
  go_to_frame(w, 46);  // the head is between two poses that differ by 195 degrees
  record_edit(w.document, "move");
  w.document.changed_pose().positions[40][1] += 0.1 * w.document.cage()->diagonal;
  follow_time(w, 0);
  const auto before = w.document.pose().positions;
  REQUIRE(test::run_command(w, "set_key"));
  follow_time(w, 0);
  CHECK(test::largest_distance(before, w.document.pose().positions) < 1e-10 * w.document.cage()->diagonal);
  CHECK_FALSE(has_unkeyed_pose(w));
}

TEST_CASE("a_part_that_is_moved_after_a_reset_is_a_pose_without_keyed_weights") {
  Weighted p;
  p.put_keys({{1, 0, Easing::constant_speed}, {11, 1}});
  p.go_to(6);
  reset_pose(p.document());
  p.pass();
  record_edit(p.document(), "move a part");
  p.document().changed_pose().positions[0][0] -= 0.5;
  p.pass();
  const auto part = p.positions();
  CHECK(p.weight(0) == 0);
  REQUIRE(test::run_command(p.w, "keep_pose"));
  p.pass();
  CHECK(p.document().library().poses[2].pose->cage.positions == part);
  p.press_i(2);
  p.go_to(1);
  p.go_to(6);
  CHECK(p.weight(0) == doctest::Approx(0.5));
  CHECK(p.weight(2) == 1);
  CHECK(p.positions() != part);
  CHECK(p.timeline().channels.size() == 2);
}

TEST_CASE("auto_key_keys_an_edited_cage_and_keeps_keyed_weights") {
  Weighted p;
  p.put_keys({{1, 0, Easing::constant_speed}, {11, 1}});
  p.w.playback.auto_key = true;
  p.go_to(6);
  record_edit(p.document(), "stretch");
  p.document().changed_pose().positions = p.turned_and_wide(45, 2);
  p.pass();
  REQUIRE(p.timeline().keys.size() == 1);
  CHECK(p.timeline().channels[0].keys.size() == 2);
  CHECK(test::distance(p.timeline().keys[0].pose->cage.positions, test::stretched_cube(2).positions) < 1e-9);
  CHECK(test::distance(p.positions(), p.turned_and_wide(45, 2)) < 1e-9);
  CHECK_FALSE(has_unkeyed_pose(p.w));
}

TEST_CASE("a_keyed_weight_is_added_to_the_weight_in_the_keyed_poses") {
  Weighted p;
  p.key_turned_and_rest();
  p.go_to(11);
  CHECK(p.weight(0) == doctest::Approx(0.5));
  p.weigh(0, 0.8);
  p.press_i(0);
  CHECK(p.timeline().channels.at(0).keys[0].weight == doctest::Approx(0.3));
  CHECK(p.weight(0) == doctest::Approx(0.8));
  CHECK(p.is_turned_by(72));
  CHECK_FALSE(has_unkeyed_pose(p.w));
  p.go_to(1);
  CHECK(p.weight(0) == doctest::Approx(1.3));
  CHECK(p.is_turned_by(117));
  p.weigh(0, 1);
  p.press_i(0);
  CHECK(p.timeline().channels[0].keys[0].weight == doctest::Approx(0));
  CHECK(p.is_turned_by(90));
  CHECK_FALSE(has_unkeyed_pose(p.w));
}

TEST_CASE("keyed_weights_follow_the_list_of_poses") {
  Weighted p;
  p.put_keys({{1, 1}});
  p.go_to(1);
  rename_pose(p.document(), 0, "wide");
  p.pass();
  CHECK(p.timeline().channels[0].name == "wide 2");
  CHECK(p.is_turned_by(90));
  move_pose(p.document(), 0, 2);
  p.pass();
  CHECK(p.weight(1) == 1);
  p.take_back();
  record_edit(p.document(), "move");
  p.document().changed_pose() = test::turned_cube(30);
  update_pose(p.document(), 0);
  p.pass();
  CHECK(p.timeline().channels[0].pose == p.document().library().poses[0].pose);
  p.go_to(2);
  CHECK(p.is_turned_by(30));
  remove_pose(p.document(), p.w.playback.vectors, 0);
  p.pass();
  CHECK(p.timeline().empty());
  p.take_back();
  CHECK(p.timeline().channels.at(0).name == "wide 2");
  CHECK(p.timeline().channels[0].keys.size() == 1);
  begin_cage_editing(p.document());
  p.document().changed_pose().positions[0][0] -= 0.5;
  end_cage_editing(p.document());
  p.pass();
  CHECK(p.timeline().channels.at(0).pose == p.document().library().poses[0].pose);
}

TEST_CASE("keys_of_weights_are_selected_dragged_eased_and_deleted_without_those_of_poses") {
  Weighted p;
  p.put_pose_keys();
  p.put_keys({{1, 0}, {11, 1}, {31, 0}});
  Workspace& w = p.w;
  const auto drag = [&](double from, const KeyPlace& key, double to) {
    press_keys(w, from, key, false);
    drag_time(w, to);
    release_time(w);
    p.pass();
  };
  drag(11, {11, "turned"}, 15);
  CHECK(w.view.time.selected == KeyPlaces{{15, "turned"}});
  CHECK(p.timeline().channels[0].keys[1].frame == 15);
  CHECK(p.timeline().keys[1].frame == 11);
  CHECK(p.document().history().undo_label() == "move keys");
  drag(11, {11}, 12);
  CHECK(p.timeline().channels[0].keys[1].frame == 15);
  CHECK(p.timeline().keys[1].frame == 12);
  press_keys(w, 5, {}, false);
  const std::string rows[] = {"turned"};
  drag_time(w, 40, rows);
  release_time(w);
  CHECK(w.view.time.selected == KeyPlaces{{15, "turned"}, {31, "turned"}});
  CHECK(eased_keys(w) == KeyPlaces{{15, "turned"}});
  REQUIRE(test::run_command(w, "easing_hold"));
  CHECK(p.timeline().channels[0].keys[1].easing == Easing::hold);
  CHECK(p.timeline().keys[1].easing == Easing::smooth);
  CHECK(easing_at(p.timeline(), {15, "turned"}) == Easing::hold);
  CHECK_FALSE(easing_at(p.timeline(), {15}));
  w.view.time.hovered = true;
  REQUIRE(test::run_command(w, "delete_keys"));
  CHECK(p.timeline().channels[0].keys.size() == 1);
  CHECK(p.timeline().keys.size() == 3);
  w.view.time.selected = {{1, "turned"}};
  REQUIRE(test::run_command(w, "delete_keys"));
  CHECK(p.timeline().channels.empty());
}
