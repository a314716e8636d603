#include "app/first_motion.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "deform/pose_io.h"
#include "scene/document/edit.h"
#include "scene/document/record.h"
#include "scene/files/open.h"
#include "scene/workspace/apply_opened.h"
#include "scene/workspace/playing.h"
#include "scene/workspace/saving.h"
#include "support/commands.h"
#include "support/data.h"
#include "support/folder.h"

using namespace viete;

namespace {

const std::filesystem::path folder = test::assets_dir() / "dragon", pose_file = folder / "pose_alert.obj";

struct Start {
  Start() {
    REQUIRE(
        scene::open_now(w, {scene::OpenRequest::What::model, {folder / "dragon.ply", folder / "cage.obj"}}));
  }
  bool at_goal() {
    std::vector<std::string> warnings;
    return w.document.pose.positions == deform::read_pose(pose_file, *w.document.cage, warnings).positions;
  }
  scene::Workspace w;
  app::FirstMotion motion{pose_file};
};

}  // namespace

TEST_CASE("the_first_motion_leads_from_rest_into_the_pose_and_is_no_edit") {
  Start s;
  s.motion.step(s.w, false, 0.1);
  CHECK_FALSE(s.motion.moving());
  s.motion.step(s.w, true, 0.1);
  CHECK(s.motion.moving());
  CHECK_FALSE(scene::differs_from_rest(s.w.document));
  const auto before = s.w.document.revisions().pose;
  s.motion.step(s.w, true, 0.3);
  CHECK(scene::differs_from_rest(s.w.document));
  CHECK(s.w.document.revisions().pose > before);
  CHECK_FALSE(s.at_goal());
  CHECK_FALSE(scene::has_unsaved_edits(s.w));
  s.motion.step(s.w, true, 0.31);
  CHECK_FALSE(s.motion.moving());
  CHECK(s.at_goal());
  CHECK_FALSE(scene::has_unsaved_edits(s.w));
  CHECK_FALSE(s.w.document.history.can_undo());
  s.motion.step(s.w, true, 1);
  CHECK_FALSE(s.motion.moving());
}

TEST_CASE(
    "the_loop_of_the_bundled_model_is_added_when_asked_for_and_plays_from_where_the_first_motion_ends") {
  Start s;
  CHECK(s.w.document.timeline.empty());
  s.motion.step(s.w, true, 0);
  s.motion.step(s.w, true, 1);
  CHECK(s.at_goal());
  CHECK_FALSE(test::run_command(s.w, "add_example"));  // the session's location is unknown
  s.w.example = folder / "loop.viete";
  CHECK(test::run_command(s.w, "add_example"));
  scene::follow_time(s.w, 0);
  CHECK(s.w.document.library.poses.size() == 3);
  CHECK(s.w.preferences.layout.timeline);
  CHECK(s.at_goal());  // the motion starts there
  double farthest = 0;
  for (int i = 0; i < 60; ++i) {
    scene::follow_time(s.w, 0.1);
    CHECK(s.w.playback.playing);
    CHECK_FALSE(scene::has_unsaved_edits(s.w));
    farthest = std::max(farthest, deform::norm(s.w.document.pose.positions.back() -
                                               s.w.document.cage->surface.positions.back()));
  }
  CHECK(farthest > 0.2);
  CHECK(s.w.saved.session.empty());  // Save asks for a name
  scene::stop_playing(s.w);
  CHECK_FALSE(test::run_command(s.w, "add_example"));  // it would replace keys
  scene::undo(s.w.document);
  CHECK(s.w.document.timeline.empty());
  CHECK(s.w.document.library.poses.empty());
  CHECK(test::run_command(s.w, "add_example"));
}

TEST_CASE("the_loop_keeps_own_poses_and_unsaved_work") {
  Start s;
  s.w.example = folder / "loop.viete";
  test::run_command(s.w, "keep_pose");
  scene::record_edit(s.w.document, "move");
  s.w.document.changed_pose().positions[0][0] += 0.1;
  const auto posed = s.w.document.pose.positions;
  test::run_command(s.w, "add_example");
  scene::follow_time(s.w, 0.1);
  CHECK(s.w.document.library.poses.size() == 4);
  CHECK(scene::has_unsaved_edits(s.w));
  bool comes_back = false;
  while (!comes_back && s.w.document.history.can_undo()) {
    scene::undo(s.w.document);
    comes_back = s.w.document.pose.positions == posed;
  }
  CHECK(comes_back);
}

TEST_CASE("another_model_and_another_cage_get_no_loop_and_stay_as_they_are") {
  Start other;
  other.w.example = folder / "loop.viete";
  REQUIRE(scene::open_now(
      other.w, {scene::OpenRequest::What::model, {folder / "dragon.ply", folder / "pose_coil.obj"}}));
  test::run_command(other.w, "add_example");
  CHECK(other.w.messages.all().back().severity == scene::Severity::error);
  CHECK(other.w.document.library.poses.empty());
  CHECK(other.w.document.timeline.empty());
  CHECK_FALSE(other.w.preferences.layout.timeline);
  CHECK_FALSE(scene::add_motion(other.w, folder / "none.viete"));
  CHECK_FALSE(other.w.document.history.can_undo());
  const test::TemporaryFolder elsewhere;
  std::filesystem::copy(folder / "cage.obj", elsewhere / "dragon.ply.obj");
  REQUIRE(scene::open_now(
      other.w, {scene::OpenRequest::What::model, {elsewhere / "dragon.ply.obj", folder / "cage.obj"}}));
  CHECK_FALSE(test::run_command(other.w, "add_example"));
}

TEST_CASE("user_input_ends_the_first_motion_or_prevents_it") {
  Start begun;
  begun.motion.step(begun.w, true, 0);
  begun.motion.step(begun.w, true, 0.2);
  begun.motion.finish(begun.w);
  CHECK_FALSE(begun.motion.moving());
  CHECK(begun.at_goal());

  Start waiting;
  waiting.motion.finish(waiting.w);
  waiting.motion.step(waiting.w, true, 0.1);
  CHECK_FALSE(waiting.motion.moving());
  CHECK_FALSE(scene::differs_from_rest(waiting.w.document));
}

TEST_CASE("nothing_moves_once_the_hints_are_gone_or_where_unsaved_work_waits") {
  Start seen;
  seen.w.view.hints = false;
  seen.motion.step(seen.w, true, 0.1);
  CHECK_FALSE(seen.motion.moving());
  Start left;
  left.w.offers_recovery = true;
  left.motion.step(left.w, true, 0.1);
  CHECK_FALSE(left.motion.moving());
}
