#include "scene/workspace/motion_path.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "scene/cube.h"
#include "scene/document/edit.h"
#include "scene/document/time_edit.h"
#include "scene/document/pose_edit.h"
#include "scene/workspace/playing.h"

using namespace viete;
using namespace viete::scene;

namespace {

// Half a turn about z, from frame 1 to frame `last`.
Workspace turning_workspace(int last) {
  Workspace w = test::cube_workspace();
  set_key(w.document, 1);
  deform::Pose turned = w.document.pose;
  for (auto& p : turned.positions) p = {-p[0], -p[1], p[2]};
  turned.turns = {{0, 0, M_PI}};
  set_pose(w.document, turned);
  set_key(w.document, last);
  return w;
}

}  // namespace

TEST_CASE("what_turns_goes_on_an_arc_and_through_the_axis_in_a_straight_line") {
  Workspace w = turning_workspace(11);
  const auto animation = animation_of(w);
  REQUIRE(animation);
  const std::array<std::uint32_t, 1> vertices{7};
  const MotionPaths paths = motion_paths(*animation, w.document.timeline, vertices);
  REQUIRE(paths.paths.size() == 1);
  REQUIRE(paths.frames.size() == 11);
  CHECK(paths.keys == std::vector<std::size_t>{0, 10});
  const double radius = std::hypot(1.5, 1.5);
  for (const auto& p : paths.paths[0].by_logs) CHECK(std::hypot(p[0], p[1]) == doctest::Approx(radius));
  const auto& middle = paths.paths[0].straight[5];
  CHECK(std::hypot(middle[0], middle[1]) < 1e-12);
}

TEST_CASE("long_ways_have_keys_and_as_many_places_between_them_as_can_be_told_apart") {
  Workspace w = turning_workspace(100'001);
  const std::array<std::uint32_t, 1> vertices{7};
  const MotionPaths paths = motion_paths(*animation_of(w), w.document.timeline, vertices);
  CHECK(paths.frames.size() < 200);
  CHECK(paths.frames.front() == 1);
  CHECK(paths.frames.back() == 100'001);
}

TEST_CASE("paths_are_of_what_is_selected_and_follow_the_timeline") {
  Workspace w = turning_workspace(11);
  CHECK(w.paths.of(w.document, animation_of(w)).paths.empty());
  w.document.selection.apply(std::array<std::uint32_t, 2>{1, 4}, SelectMode::replace);
  CHECK(w.paths.of(w.document, animation_of(w)).paths.size() == 2);
  const auto* before = &w.paths.of(w.document, animation_of(w)).paths[0].by_logs[3];
  CHECK(before == &w.paths.of(w.document, animation_of(w)).paths[0].by_logs[3]);  // kept
  set_easing(w.document, std::array{1}, Easing::hold);
  CHECK(w.paths.of(w.document, animation_of(w)).paths[0].by_logs[3] == w.paths.of(w.document, animation_of(w)).paths[0].by_logs[0]);
  remove_keys(w.document, std::array{1, 11});
  CHECK(w.paths.of(w.document, animation_of(w)).paths.empty());
}
