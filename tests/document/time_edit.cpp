#include "document/time_edit.h"

#include <doctest/doctest.h>

#include "support/edits.h"
#include "support/posed_cube.h"

using namespace viete;
using namespace viete::document;

namespace {

struct Timed {
  Document document = test::cube_document();

  Timeline& timeline() { return document.changed_timeline(); }
  std::vector<int> frames() const {
    std::vector<int> all;
    for (const PoseKey& key : document.timeline().keys) all.push_back(key.frame);
    return all;
  }
  std::size_t edits() const { return test::edit_count(document.history()); }
};

using Frames = std::vector<int>;
using Places = std::vector<KeyPlace>;

}  // namespace

TEST_CASE("keys_are_by_frame_each_there_once_and_the_range_grows_with_them") {
  Timed t;
  for (const int frame : {10, 90, -5, 10}) set_key(t.document, frame);
  CHECK(t.frames() == Frames{-5, 10, 90});
  CHECK(t.timeline().first == -5);
  CHECK(t.timeline().last == 90);
  set_easing(t.document, Places{10}, Easing::hold);
  t.document.changed_pose() = test::turned_cube(90);
  set_key(t.document, 10);
  CHECK(key_at(t.timeline(), 10)->pose->cage.positions == test::turned_cube(90).positions);
  CHECK(key_at(t.timeline(), 10)->easing == Easing::hold);
  CHECK(key_at(t.timeline(), 11) == nullptr);
  while (t.document.history().can_undo()) undo(t.document);
  CHECK(t.timeline() == Timeline{});
}

TEST_CASE("frames_out_of_range_and_too_many_keys_are_refused_and_change_nothing") {
  Timed t;
  CHECK_THROWS_AS(set_key(t.document, Timeline::largest_frame + 1), base::Error);
  CHECK_THROWS_AS(set_camera_key(t.document, Timeline::least_frame - 1, {}), base::Error);
  for (int i = 0; i < int(Timeline::most_keys); ++i)
    t.timeline().keys.push_back({i, shared_pose(t.document)});
  CHECK_THROWS_AS(set_key(t.document, 20000), base::Error);
  set_key(t.document, 5);  // replaces a key
  CHECK(t.edits() == 1);
  CHECK_THROWS_AS(move_keys(t.document, t.timeline(), Places{1}, Frames{Timeline::largest_frame + 1}),
                  base::Error);
  CHECK(t.timeline().keys.size() == Timeline::most_keys);
}

TEST_CASE("moved_keys_take_the_place_of_others_and_one_drag_is_one_edit") {
  Timed t;
  t.timeline() = test::three_keys();
  const Timeline start = t.timeline();
  for (int step = 1; step <= 20; ++step) move_keys(t.document, start, Places{1}, Frames{1 + step});
  CHECK(t.frames() == Frames{11, 21, 31});  // the drag crossed frame 11, but its key stays
  CHECK(t.edits() == 1);
  CHECK(t.timeline().keys[1].pose == start.keys[0].pose);
  move_keys(t.document, start, Places{1}, Frames{11});
  CHECK(t.frames() == Frames{11, 31});
  CHECK(t.timeline().keys[0].pose == start.keys[0].pose);
  // Another drag of the key is another edit.
  const Timeline then = t.timeline();
  move_keys(t.document, then, Places{11}, Frames{12});
  CHECK(t.edits() == 2);
  undo(t.document);
  CHECK(t.timeline() == then);
  undo(t.document);
  CHECK(t.timeline() == start);
}

TEST_CASE("keys_and_camera_keys_of_a_frame_move_together_and_may_change_places") {
  Timed t;
  t.timeline() = test::three_keys();
  t.timeline().cameras = {{1, {}}, {11, {.distance = 9}}};
  const Timeline start = t.timeline();
  move_keys(t.document, start, Places{1, 11}, Frames{11, 1});
  CHECK(t.timeline().keys[0].pose == start.keys[1].pose);
  CHECK(t.timeline().keys[1].pose == start.keys[0].pose);
  CHECK(t.timeline().cameras[0].camera.distance == 9);
  move_keys(t.document, t.timeline(), Places{31}, Frames{-3});
  CHECK(t.timeline().first == -3);
  CHECK(t.timeline().last == 31);
}

TEST_CASE("frames_without_keys_are_ignored_and_give_no_edit") {
  Timed t;
  t.timeline() = test::three_keys();
  remove_keys(t.document, Places{2, 3});
  set_easing(t.document, Places{2, 3}, Easing::hold);
  set_easing(t.document, Places{1}, Easing::smooth);
  CHECK(t.edits() == 0);
  remove_keys(t.document, Places{2, 11, 1});
  CHECK(t.frames() == Frames{31});
  CHECK(t.edits() == 1);
  set_easing(t.document, Places{31, 7}, Easing::constant_speed);
  CHECK(t.timeline().keys[0].easing == Easing::constant_speed);
}

TEST_CASE("playback_settings_are_clamped_and_changed_in_one_edit") {
  Timed t;
  set_play(t.document, t.timeline());
  CHECK(t.edits() == 0);
  set_play(t.document, {5, 2, 1e9, Repeat::ping_pong, true});
  CHECK(t.timeline().first == 5);
  CHECK(t.timeline().last == 6);
  CHECK(t.timeline().rate == Timeline::largest_rate);
  CHECK(t.timeline().repeat == Repeat::ping_pong);
  CHECK(t.timeline().linear);
  set_play(t.document, {1 << 30, 1 << 30, std::numeric_limits<double>::quiet_NaN(), Repeat::loop, false});
  CHECK(t.timeline().last == Timeline::largest_frame);
  CHECK(t.timeline().first < t.timeline().last);
  CHECK(t.timeline().rate == Timeline::least_rate);
  CHECK(t.edits() == 1);
  undo(t.document);
  CHECK(t.timeline() == Timeline{});
}

TEST_CASE("a_camera_key_takes_the_short_way_from_the_one_before") {
  Timed t;
  set_camera_key(t.document, 1, {.yaw = 3});
  set_camera_key(t.document, 11, {.yaw = -3});
  CHECK(t.timeline().cameras[1].camera.yaw == doctest::Approx(2 * std::numbers::pi - 3));
  CHECK(camera_at(t.timeline(), 6)->yaw == doctest::Approx(std::numbers::pi));
  set_camera_key(t.document, 21, {.yaw = -2});
  CHECK(t.timeline().cameras[2].camera.yaw == doctest::Approx(2 * std::numbers::pi - 2));
}

TEST_CASE("a_turntable_is_one_whole_turn_at_an_even_speed_and_one_edit") {
  for (const auto& [first, last] : {std::array{1, 60}, {-3, 4}, {10, 11}}) {
    Timed t;
    t.timeline().first = first;
    t.timeline().last = last;
    set_camera_key(t.document, first, {.distance = 77});
    const Timeline before = t.timeline();
    const CameraPose camera{{0, 1, 0}, 5, 2.5f, 0.4f};
    set_turntable(t.document, camera);
    for (double share = 0; share <= 1; share += last - first > 1 ? 0.125 : 1) {
      const CameraPose now = *camera_at(t.timeline(), first + share * (last - first));
      CHECK(now.yaw == doctest::Approx(2.5 + share * 2 * std::numbers::pi).epsilon(1e-6));
      CHECK(now.distance == doctest::Approx(5));
      CHECK(now.target.y == 1);
    }
    CHECK(t.edits() == 2);
    undo(t.document);
    CHECK(t.timeline() == before);
  }
}
