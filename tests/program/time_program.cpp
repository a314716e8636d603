// Named poses and the timeline with simulated events: save, mix, set keys, play, move keys.

#include "document/time_edit.h"
#include "program/driver.h"
#include "workspace/playing.h"

using namespace viete;
using document::Easing;
using test::Driver;

namespace {

struct Timed : Driver {
  Timed() {
    open_dragon();
    workspace().preferences.layout.sections["Poses"] = true;
    frame(3);
  }

  const std::vector<mesh::Point>& pose() { return document().pose().positions; }
  const document::Timeline& timeline() { return document().timeline(); }
  void open_pose(const std::string& name) {
    REQUIRE(open({test::dragon_cage.parent_path() / (name + ".obj")}, What::pose));
    frame(2);
  }
  void keep(const std::string& file) {
    open_pose(file);
    click("keep_pose");
  }
  void go_to(int to) {
    workspace::go_to_frame(workspace(), to);
    frame(2);
  }
  void key_pose_of(const std::string& file, int at) {
    go_to(at);
    open_pose(file);
    press_key('I');
  }
  // Returns the screen position of a frame on the track. `y` is a fraction of the track's height.
  glm::vec2 on_track(double at, float y) {
    const auto rect = viewer().recorder().find("time/track");
    REQUIRE(rect);
    const auto share = static_cast<float>(workspace().view.time.seen.share_of(at));
    return {rect->x0 + share * (rect->x1 - rect->x0), rect->y0 + y * (rect->y1 - rect->y0)};
  }
};

constexpr float ruler = 0.05f, keys = 0.5f;

}  // namespace

TEST_CASE("poses_are_kept_mixed_by_sliders_and_numbers_applied_renamed_and_moved") {
  Timed d;
  d.keep("pose_alert");
  const auto alert = d.pose();
  CHECK(d.document().library().poses[0].weight == 1);
  d.enter("pose_weight/0/typed", "100");
  CHECK(d.pose() == alert);
  d.keep("pose_flight");
  const auto flight = d.pose();
  REQUIRE(d.document().library().poses.size() == 2);
  d.press_key('R', true);  // resets the pose
  const auto rest = d.pose();
  REQUIRE(rest == d.document().cage()->surface.positions);

  const auto slider = d.recorder().find("pose_weight/0");
  REQUIRE(slider);
  const glm::vec2 from{slider->x0 + 0.3f * (slider->x1 - slider->x0), 0.5f * (slider->y0 + slider->y1)};
  d.drag(from, {slider->x1 - 40, from.y});
  CHECK(d.document().library().poses[0].weight > 0.5);
  CHECK(d.pose() != rest);
  d.press_key('Z', true);
  CHECK(d.pose() == rest);
  CHECK(d.document().library().poses[0].weight == 0);
  d.enter("pose_weight/0/typed", "100");
  CHECK(d.document().library().poses[0].weight == 1);
  CHECK(d.pose() == alert);
  d.enter("pose_weight/0/typed", "37.1974");
  d.click("pose_weight/0/typed");
  CHECK(d.workspace().panels.typed.at("pose_weight/0/typed").text == "37.2");
  d.press_key(workspace::Key::escape);
  d.run("clear_mix");
  CHECK(d.pose() == rest);

  d.click("pose/1");
  CHECK(d.workspace().view.chosen_pose == 1);
  d.click("apply_pose");
  CHECK(d.pose() == flight);
  d.enter("pose_name/1", "Wings");
  CHECK(d.document().library().poses[1].name == "Wings");
}

TEST_CASE("the_dragon_opens_without_keys_and_its_loop_is_one_click_away") {
  Timed d;
  d.open_dragon("", test::bundled_dragon);
  CHECK(d.timeline().empty());
  CHECK(d.document().library().poses.empty());
  d.press_key(workspace::Key::right);
  CHECK(d.document().frame() == 1);  // the key has no effect while the timeline is hidden
  d.press_key('I');
  CHECK(d.recorder().find("time/track"));
  CHECK(d.workspace().messages.all().back().text == "Key set at frame 1.");
  d.press_key(workspace::Key::right);
  CHECK(d.document().frame() == 2);
  d.press_key('Z', true);
  REQUIRE(d.timeline().empty());

  d.run("open_example");
  d.viewer().finish_loading();
  d.frame(3);
  CHECK(d.timeline().keys.size() > 2);
  CHECK(d.document().library().poses.size() == 3);
  CHECK(d.workspace().playback.playing);
  d.frame(3);
  CHECK(d.recorder().find("time/track"));
  d.press_key(workspace::Key::space);
  REQUIRE_FALSE(d.workspace().playback.playing);
  // Sliders show the weights of the played pose. A typed weight changes the pose, and undo restores it.
  d.go_to(110);
  const auto played = d.pose();
  d.enter("pose_weight/0/typed", "100");
  CHECK(d.document().library().poses[0].weight == 1);
  CHECK(d.pose() != played);
  d.press_key('Z', true);
  CHECK(d.pose() == played);
}

TEST_CASE("keys_are_set_played_scrubbed_and_retimed") {
  Timed d;
  const auto rest = d.pose();
  d.press_key('I');
  REQUIRE(d.timeline().keys.size() == 1);
  d.frame(3);
  d.key_pose_of("pose_alert", 24);
  const auto alert = d.pose();
  d.key_pose_of("pose_flight", 48);
  REQUIRE(d.timeline().keys.size() == 3);

  // A drag on the ruler changes the frame. At a key, the pose equals the key's pose exactly.
  d.drag(d.on_track(30, ruler), d.on_track(24, ruler));
  CHECK(d.document().frame() == 24);
  CHECK(d.pose() == alert);
  d.click(d.on_track(12, ruler));
  CHECK(d.document().frame() == 12);
  const auto halfway = d.pose();
  CHECK(halfway != rest);
  d.choose("time/easing", "time/easing_constant_speed");
  CHECK(d.timeline().keys[0].easing == Easing::constant_speed);
  CHECK(d.pose() != halfway);
  d.press_key(workspace::Key::left, false, true);
  CHECK(d.document().frame() == 1);

  d.press_key(workspace::Key::space);
  CHECK(d.workspace().playback.playing);
  CHECK(d.viewer().wants_frame());
  d.frame(30);
  CHECK(d.document().frame() > 5);
  d.press_key(workspace::Key::space);
  CHECK_FALSE(d.workspace().playback.playing);

  d.drag(d.on_track(24, keys), d.on_track(30, keys));
  CHECK(document::key_at(d.timeline(), 30));
  CHECK_FALSE(document::key_at(d.timeline(), 24));
  d.click(d.on_track(30, keys), 1);
  d.click("key_menu/easing_hold");
  CHECK(document::key_at(d.timeline(), 30)->easing == Easing::hold);
  // While the pointer is over the timeline, Delete removes keys.
  d.click(d.on_track(48, keys));
  d.press_key(workspace::Key::delete_key);
  CHECK(d.timeline().keys.size() == 2);
}
