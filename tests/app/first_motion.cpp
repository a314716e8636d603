#include "app/first_motion.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "deform/pose_io.h"
#include "scene/document/edit.h"
#include "scene/document/record.h"
#include "scene/files/open.h"
#include "scene/workspace/playing.h"
#include "scene/workspace/saving.h"
#include "scene/workspace/taking.h"
#include "support/data.h"

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

TEST_CASE("the_bundled_model_has_a_loop_that_plays_from_where_the_first_motion_ends") {
  Start s;
  CHECK(app::add_loop(s.w, folder / "loop.viete"));
  CHECK_FALSE(app::add_loop(s.w, folder / "loop.viete"));  // it has one
  s.motion.step(s.w, true, 0);
  s.motion.step(s.w, true, 0.3);
  scene::follow_time(s.w, 0.3);
  CHECK_FALSE(s.at_goal());
  s.motion.step(s.w, true, 1);
  CHECK(s.at_goal());
  scene::follow_time(s.w, 0);
  CHECK_FALSE(scene::has_unsaved_edits(s.w));
  scene::start_playing(s.w);
  CHECK(s.at_goal());  // it begins there
  double farthest = 0;
  for (int i = 0; i < 60; ++i) {
    scene::follow_time(s.w, 0.1);
    CHECK(s.w.playback.playing);
    CHECK_FALSE(scene::has_unsaved_edits(s.w));
    farthest = std::max(farthest, deform::norm(s.w.document.pose.positions.back() -
                                               s.w.document.cage->surface.positions.back()));
  }
  CHECK(farthest > 0.2);
  CHECK_FALSE(s.w.document.history.can_undo());
  CHECK(s.w.saved.session.empty());  // Save asks for a name
}

TEST_CASE("another_model_and_one_that_was_changed_get_no_loop") {
  Start changed;
  scene::record_edit(changed.w.document, "move");
  CHECK_FALSE(app::add_loop(changed.w, folder / "loop.viete"));
  Start other;
  REQUIRE(scene::open_now(other.w,
                          {scene::OpenRequest::What::model, {folder / "cage.obj", folder / "cage.obj"}}));
  CHECK_FALSE(app::add_loop(other.w, folder / "loop.viete"));
  CHECK_FALSE(app::add_loop(other.w, folder / "none.viete"));
  CHECK(other.w.document.library.poses.empty());
}

TEST_CASE("a_hand_ends_the_first_motion_or_keeps_it_from_beginning") {
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
  left.w.offers_leftovers = true;
  left.motion.step(left.w, true, 0.1);
  CHECK_FALSE(left.motion.moving());
}
