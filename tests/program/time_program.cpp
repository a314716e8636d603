// Named poses and the timeline with real events: saved, mixed, keyed, played, retimed.
//
// VIETE_PICTURES=FOLDER also writes pictures.
#include <array>
#include <cmath>
#include <cstdlib>

#include "program/driver.h"
#include "render/image.h"
#include "scene/document/edit.h"
#include "scene/document/time_edit.h"
#include "scene/workspace/playing.h"
#include "scene/workspace/saving.h"
#include "support/folder.h"

using namespace viete;
using scene::Easing;
using test::Driver;
namespace fs = std::filesystem;

namespace {

struct Timed : Driver {
  explicit Timed(glm::ivec2 size = {1440, 900}, std::optional<test::WithPixels> pixels = pictures_wanted())
      : Driver(options(size), pixels) {
    open_dragon();
    workspace().preferences.layout.sections["Poses"] = true;
    frame(3);
  }

  static app::ViewerOptions options(glm::ivec2 size) {
    app::ViewerOptions options = default_options();
    options.size = size;
    return options;
  }

  std::vector<mesh::Point>& pose() { return document().pose.positions; }
  const scene::Timeline& timeline() { return document().timeline; }
  void open_pose(const std::string& name) {
    REQUIRE(open({test::dragon_cage.parent_path() / (name + ".obj")}, What::pose));
    frame(2);
  }
  void keep(const std::string& file) {
    open_pose(file);
    click("keep_pose");
  }
  void go_to(int to) {
    scene::go_to_frame(workspace(), to);
    frame(2);
  }
  void key_pose_of(const std::string& file, int at) {
    go_to(at);
    open_pose(file);
    press_key('I');
    frame(2);
  }
  std::uint32_t farthest_from_rest() {
    const auto& rest = document().cage->surface.positions;
    std::uint32_t farthest = 0;
    const auto way = [&](std::uint32_t v) { return mesh::norm(pose()[v] - rest[v]); };
    for (std::uint32_t v = 0; v < rest.size(); ++v)
      if (way(v) > way(farthest)) farthest = v;
    return farthest;
  }
  // The screen position of a frame on the track; `y` is a fraction of its height.
  glm::vec2 on_track(double at, float y) {
    const auto rect = viewer().recorder().find("time/track");
    REQUIRE(rect);
    const auto share = static_cast<float>(workspace().time_view.seen.share_of(at));
    return {rect->x0 + share * (rect->x1 - rect->x0), rect->y0 + y * (rect->y1 - rect->y0)};
  }
  void show(const std::string& name) {
    const char* folder = std::getenv("VIETE_PICTURES");
    if (!folder) return;
    settle();
    render::write_png(fs::path(folder) / (name + ".png"), picture());
  }
};

constexpr float ruler = 0.05f, keys = 0.5f;

double distance_of(const std::vector<mesh::Point>& a, const std::vector<mesh::Point>& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, mesh::norm(a[v] - b[v]));
  return largest;
}

}  // namespace

TEST_CASE("poses_are_kept_with_a_picture_and_mixed_by_sliders") {
  Timed d;
  d.keep("pose_alert");
  const auto alert = d.pose();
  d.keep("pose_flight");
  const auto flight = d.pose();
  d.keep("pose_coil");
  REQUIRE(d.document().library.poses.size() == 3);
  d.press_key('R', true);  // to rest
  const auto rest = d.pose();
  REQUIRE(rest == d.document().cage->surface.positions);

  const auto slider = d.viewer().recorder().find("pose_weight/0");
  REQUIRE(slider);
  const glm::vec2 from{slider->x0 + 0.3f * (slider->x1 - slider->x0), 0.5f * (slider->y0 + slider->y1)};
  d.drag(from, {slider->x1 - 40, from.y});
  CHECK(d.document().library.poses[0].weight > 0.5);
  CHECK(d.pose() != rest);
  d.show("poses_mixed");
  d.press_key('Z', true);
  CHECK(d.pose() == rest);
  CHECK(d.document().library.poses[0].weight == 0);

  d.click("pose_weight/0/typed");
  d.press_key('A', true);
  d.type("100");
  d.press_key(scene::Key::enter);
  CHECK(d.document().library.poses[0].weight == 1);
  CHECK(d.pose() == alert);
  d.click("pose_weight/0/typed");
  d.press_key('A', true);
  d.type("150");
  d.press_key(scene::Key::enter);
  CHECK(distance_of(d.pose(), rest) > distance_of(alert, rest));
  d.run("clear_mix");
  CHECK(d.pose() == rest);

  d.click("pose/1");
  CHECK(d.workspace().chosen_pose == 1);
  d.click("apply_pose");
  CHECK(d.pose() == flight);
  d.click("pose_name/1");
  d.press_key('A', true);
  d.type("Wings");
  d.press_key(scene::Key::enter);
  CHECK(d.document().library.poses[1].name == "Wings");
  scene::find_command("pose_up")->run(d.workspace());
  d.frame();
  CHECK(d.document().library.poses[0].name == "Wings");
  d.run("remove_pose");
  CHECK(d.document().library.poses.size() == 2);
  d.press_key('Z', true);
  CHECK(d.document().library.poses.size() == 3);
}

// As in the README's first minute, with the dragon as it opens.
TEST_CASE("the_dragon_opens_without_keys_and_its_loop_is_one_click_away") {
  Timed d;
  d.open_dragon("", test::bundled_dragon);
  CHECK(d.timeline().empty());
  CHECK(d.document().library.poses.empty());
  d.press_key(scene::Key::right);
  CHECK(d.document().frame == 1);  // the timeline is hidden
  d.press_key('I');
  d.frame(3);
  CHECK(d.viewer().recorder().find("time/track"));
  CHECK(d.workspace().messages.all().back().text == "Key set at frame 1.");
  CHECK_FALSE(d.viewer().recorder().find("add_example"));
  d.press_key(scene::Key::right);
  CHECK(d.document().frame == 2);
  d.open_pose("pose_alert");
  d.press_key('I');
  REQUIRE(d.timeline().keys.size() == 2);
  CHECK(d.timeline().keys[1].frame == 2);
  d.press_key('T', false, true);
  d.press_key(scene::Key::left);
  CHECK(d.document().frame == 2);

  for (int i = 0; i < 3; ++i) d.press_key('Z', true);
  REQUIRE(d.timeline().empty());
  d.show("no_poses");
  d.click("add_example");
  CHECK(d.timeline().keys.size() > 2);
  CHECK(d.document().library.poses.size() == 3);
  CHECK(d.workspace().playback.playing);
  d.frame(3);
  CHECK(d.viewer().recorder().find("time/track"));
  d.show("loop_added");
  d.press_key(scene::Key::space);
  REQUIRE_FALSE(d.workspace().playback.playing);
  // Sliders show the played pose: the first pose is the key at both ends of the loop.
  d.go_to(1);
  CHECK(scene::shown_weights(d.workspace()) == std::vector<double>{1, 0, 0});
  d.go_to(110);
  const double share = scene::shown_weights(d.workspace())[0];
  CHECK(share > 0.2);
  CHECK(share < 0.9);
  d.show("weights_played");
  const auto played = d.pose();
  d.click("pose_weight/0/typed");
  d.press_key('A', true);
  d.type("100");
  d.press_key(scene::Key::enter);
  CHECK(d.document().library.poses[0].weight == 1);
  CHECK(d.pose() != played);
  d.press_key('Z', true);
  CHECK(d.pose() == played);
  d.press_key('Z', true);
  CHECK(d.timeline().empty());
}

TEST_CASE("keys_are_set_played_scrubbed_and_retimed") {
  Timed d;
  const auto rest = d.pose();
  d.press_key('I');
  REQUIRE(d.timeline().keys.size() == 1);
  CHECK(d.workspace().preferences.layout.timeline);
  d.frame(3);
  d.key_pose_of("pose_alert", 24);
  const auto alert = d.pose();
  d.key_pose_of("pose_flight", 48);
  REQUIRE(d.timeline().keys.size() == 3);
  d.show("timeline");

  // The ruler scrubs; at a key the pose is that key, bit for bit.
  d.drag(d.on_track(30, ruler), d.on_track(24, ruler));
  CHECK(d.document().frame == 24);
  CHECK(d.pose() == alert);
  d.click(d.on_track(12, ruler));
  CHECK(d.document().frame == 12);
  const auto halfway = d.pose();
  CHECK(halfway != rest);
  CHECK(halfway != alert);
  d.press_key(scene::Key::right);
  CHECK(d.document().frame == 13);
  d.press_key(scene::Key::up);
  CHECK(d.document().frame == 24);
  d.press_key(scene::Key::left, false, true);
  CHECK(d.document().frame == 1);

  // Playback advances with time, and stops at a whole frame.
  d.press_key(scene::Key::space);
  CHECK(d.workspace().playback.playing);
  CHECK(d.viewer().wants_frame());
  d.frame(30);
  CHECK(d.document().frame > 5);
  d.press_key(scene::Key::space);
  CHECK_FALSE(d.workspace().playback.playing);
  CHECK(d.document().frame == std::round(d.document().frame));

  // A key is dragged to another frame; Esc cancels it, and undo reverts it.
  d.drag(d.on_track(24, keys), d.on_track(30, keys));
  CHECK(scene::key_at(d.timeline(), 30));
  CHECK_FALSE(scene::key_at(d.timeline(), 24));
  d.press_key('Z', true);
  CHECK(scene::key_at(d.timeline(), 24));
  d.press_and_move(d.on_track(24, keys), d.on_track(36, keys));
  CHECK(scene::key_at(d.timeline(), 36));
  d.press_key(scene::Key::escape);
  d.button(0, false);
  CHECK(scene::key_at(d.timeline(), 24));
  CHECK_FALSE(scene::key_at(d.timeline(), 36));

  // Delete applies to keys while the pointer is over the timeline.
  d.click(d.on_track(48, keys));
  d.press_key(scene::Key::delete_key);
  CHECK(d.timeline().keys.size() == 2);
  d.press_key('Z', true);
  CHECK(d.timeline().keys.size() == 3);
}

TEST_CASE("easing_is_chosen") {
  Timed d;
  d.press_key('I');
  d.key_pose_of("pose_alert", 25);
  d.go_to(7);
  const auto smooth = d.pose();
  d.choose("time/easing", "time/easing_linear");
  CHECK(d.timeline().keys[0].easing == Easing::linear);
  CHECK(d.pose() != smooth);
  d.choose("time/easing", "time/easing_hold");
  CHECK(d.pose() == d.timeline().keys[0].pose->cage.positions);
}

TEST_CASE("auto_key_keeps_what_the_hand_does_and_without_it_undo_leads_back") {
  Timed d;
  d.press_key('I');
  d.key_pose_of("pose_alert", 25);
  d.go_to(13);
  const std::uint32_t v = d.free_vertex();
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(40, -20));
  const auto moved = d.pose();
  CHECK(d.timeline().keys.size() == 2);
  d.go_to(20);
  CHECK(d.pose() != moved);
  d.press_key('Z', true);
  CHECK(d.pose() == moved);
  d.go_to(20);
  d.click("time/toggle_auto_key");
  d.go_to(13);
  const std::uint32_t again = d.free_vertex();
  d.drag(d.vertex(again), d.vertex(again) + glm::vec2(40, -20));
  REQUIRE(d.timeline().keys.size() == 3);
  const auto keyed = d.pose();
  d.go_to(20);
  d.go_to(13);
  CHECK(d.pose() == keyed);
}

TEST_CASE("a_session_brings_poses_keys_and_frame_back") {
  const test::TemporaryFolder folder;
  std::vector<mesh::Point> there;
  {
    Timed d;
    d.keep("pose_coil");
    d.go_to(1);
    d.press_key('I');
    d.key_pose_of("pose_alert", 25);
    d.press_key('I', false, true);
    d.go_to(11);
    there = d.pose();
    d.workspace().requests.save_session = folder / "a.viete";
    d.frame(2);
    CHECK_FALSE(scene::has_unsaved_edits(d.workspace()));
  }
  Timed d;
  REQUIRE(d.open({folder / "a.viete"}));
  d.frame(3);
  CHECK(d.document().library.poses.size() == 1);
  CHECK(d.timeline().keys.size() == 2);
  CHECK(d.timeline().cameras.size() == 1);
  CHECK(d.document().frame == 11);
  CHECK(d.pose() == there);
  CHECK_FALSE(scene::has_unsaved_edits(d.workspace()));
}
