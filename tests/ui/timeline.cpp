// Keys of weights: the sliders of the panel Poses, and the rows of the timeline.
#include "document/pose_edit.h"
#include "document/time_edit.h"
#include "ui/panel_driver.h"

using namespace viete;
using document::KeyPlace, document::WeightKey;
using test::PanelDriver;

namespace {

struct Sliders : PanelDriver {
  explicit Sliders(int count, float scale = 1) : PanelDriver(test::ball_workspace(2), {1280, 800}, scale) {
    for (int i = 0; i < count; ++i) {
      document::WholePose pose = whole_pose(document());
      pose.cage.positions[static_cast<std::size_t>(i)][1] += 1;
      document().changed_library().poses.push_back(
          {"Pose " + std::to_string(i), std::make_shared<const document::WholePose>(pose)});
    }
    frame(3);
  }
  const document::Timeline& timeline() { return document().timeline(); }
  const std::vector<WeightKey>& keys(const std::string& pose) {
    const document::Channel* channel = channel_of(timeline(), pose);
    REQUIRE(channel);
    return channel->keys;
  }
  void key_slider(int slider) {
    move(place_of("pose_weight/" + std::to_string(slider)));
    press_key('I');
  }
  void go_to(int at) {
    workspace::go_to_frame(workspace(), at);
    frame(2);
  }
  void type_weight(int slider, const char* percent) {
    enter(("pose_weight/" + std::to_string(slider) + "/typed").c_str(), percent);
  }
  // Returns the place of a frame in a row of the timeline.
  glm::vec2 in_row(int row, double at) {
    const auto track = recorder().find("time/track");
    const auto name = recorder().find("time/row/" + std::to_string(row));
    REQUIRE(track);
    REQUIRE(name);
    const auto share = static_cast<float>(workspace().view.time.seen.share_of(at));
    return {track->x0 + share * (track->x1 - track->x0), 0.5f * (name->y0 + name->y1)};
  }
};

}  // namespace

TEST_CASE("i_over_a_slider_gives_its_weight_a_key_and_a_row_in_the_timeline") {
  Sliders d(3);
  d.move(d.place_of("pose_weight/1"));
  CHECK_FALSE(d.has("time/track"));
  d.key_slider(1);
  CHECK(d.keys("Pose 1") == std::vector<WeightKey>{{1, 0}});
  CHECK(d.timeline().keys.empty());
  CHECK(d.last_message() == "Key of Pose 1 set at frame 1.");
  CHECK(d.is_seen("time/row/1"));
  CHECK_FALSE(d.has("time/row/2"));
  d.go_to(20);
  d.type_weight(1, "80");
  d.key_slider(1);
  CHECK(d.keys("Pose 1") == std::vector<WeightKey>{{1, 0}, {20, 0.8}});
  d.key_slider(1);
  CHECK(d.keys("Pose 1").size() == 1);
  d.press_key('Z', true);
  CHECK(d.keys("Pose 1").size() == 2);
  d.move({700, 60});
  d.press_key('I');  // elsewhere, I sets a key of the pose
  CHECK(d.timeline().keys.size() == 1);
  CHECK(d.keys("Pose 1").size() == 2);
  d.click("pose_key/2");
  CHECK(d.keys("Pose 2") == std::vector<WeightKey>{{20, 0}});
  d.click("pose_key/2");
  CHECK(d.timeline().channels.size() == 1);
}

TEST_CASE("with_auto_key_a_dragged_slider_sets_one_key_that_one_undo_removes") {
  Sliders d(2);
  d.key_slider(0);
  d.run("toggle_auto_key");
  d.go_to(30);
  const std::size_t edits = d.edits();
  const glm::vec2 from = d.place_of("pose_weight/0");
  d.drag(from, from + glm::vec2(30, 0));
  REQUIRE(d.keys("Pose 0").size() == 2);
  CHECK(d.keys("Pose 0")[1].frame == 30);
  CHECK(d.keys("Pose 0")[1].weight > 0.1);
  CHECK(d.edits() == edits + 1);
  d.press_key('Z', true);
  CHECK(d.keys("Pose 0").size() == 1);
  d.press_and_move(from, from + glm::vec2(30, 0));
  REQUIRE(d.keys("Pose 0").size() == 2);
  d.press_key(workspace::Key::escape);
  d.button(0, false);
  CHECK(d.keys("Pose 0").size() == 1);
  CHECK(d.edits() == edits);
}

TEST_CASE("the_mouse_drags_eases_selects_and_deletes_keys_of_one_row") {
  Sliders d(2);
  d.press_key('I');
  d.key_slider(0);
  d.key_slider(1);
  d.go_to(40);
  d.key_slider(0);
  d.key_slider(1);
  d.drag(d.in_row(1, 40), d.in_row(1, 25));
  CHECK(d.keys("Pose 0").back().frame == 25);
  CHECK(d.keys("Pose 1").back().frame == 40);
  d.press_and_move(d.in_row(2, 40), d.in_row(2, 30));
  CHECK(d.keys("Pose 1").back().frame == 30);
  d.press_key(workspace::Key::escape);
  d.button(0, false);
  CHECK(d.keys("Pose 1").back().frame == 40);
  d.click(d.in_row(1, 1), 1);
  d.click("key_menu/easing_hold");
  CHECK(d.keys("Pose 0")[0].easing == document::Easing::hold);
  CHECK(d.keys("Pose 1")[0].easing == document::Easing::smooth);
  CHECK(d.timeline().keys[0].easing == document::Easing::smooth);
  d.drag(d.in_row(1, 50) - glm::vec2(0, 4), d.in_row(2, 10));
  CHECK(d.workspace().view.time.selected == workspace::KeyPlaces{{25, "Pose 0"}, {40, "Pose 1"}});
  d.drag(d.in_row(2, 50), d.in_row(2, 10));
  CHECK(d.workspace().view.time.selected == workspace::KeyPlaces{{40, "Pose 1"}});
  d.press_key(workspace::Key::delete_key);
  CHECK(d.keys("Pose 1").size() == 1);
  CHECK(d.keys("Pose 0").size() == 2);
  d.click(d.in_row(2, 1), 1);
  d.click("key_menu/delete_keys");
  CHECK(d.timeline().channels.size() == 1);
  CHECK_FALSE(d.has("time/row/2"));
  CHECK(d.timeline().keys.size() == 1);
}

TEST_CASE("many_rows_enlarge_the_timeline_then_scroll_and_long_names_are_cut") {
  Sliders d(12);
  const std::string name = "a pose with a name that is too long for its row";
  d.document().changed_library().poses[1].name = name;
  d.key_slider(0);
  const float before = d.workspace().view.camera.viewport.size.y;
  for (int i = 1; i < 12; ++i) d.key_slider(i);
  CHECK(d.workspace().view.camera.viewport.size.y < before);
  CHECK(d.is_seen("time/row/1"));
  CHECK_FALSE(d.is_seen("time/row/12"));
  CHECK(d.says("a pose with..."));
  d.move(d.in_row(2, 1) - glm::vec2(60, 0));
  d.frame(60);
  CHECK(d.says("that is too long"));
  d.wheel(-20);
  d.frame(10);
  CHECK(d.is_seen("time/row/12"));
  CHECK_FALSE(d.is_seen("time/row/0"));
  d.click(d.in_row(12, 1));
  CHECK(d.workspace().view.time.selected == workspace::KeyPlaces{{1, "Pose 11"}});
}
