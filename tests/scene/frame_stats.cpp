#include "scene/workspace/frame_stats.h"

#include <doctest/doctest.h>

using namespace viete::scene;
using viete::deform::Link;

namespace {

FrameTimes frame(double when, double blend) {
  FrameTimes t;
  t.when = when;
  t.links[Link::blend] = blend;
  t.draw = 2;
  t.frame = blend + 3;
  return t;
}

}  // namespace

TEST_CASE("frames_that_did_not_deform_do_not_count") {
  FrameStats stats;
  stats.add(frame(0, 0));
  CHECK_FALSE(stats.median());
}

TEST_CASE("the_median_is_over_the_last_half_second") {
  FrameStats stats;
  for (int i = 0; i < 10; ++i) stats.add(frame(0.01 * i, 100));
  for (int i = 0; i < 5; ++i) stats.add(frame(10 + 0.01 * i, i == 2 ? 50 : 4));
  REQUIRE(stats.median());
  CHECK(stats.median()->links[Link::blend] == 4);
  CHECK(stats.median()->other() == doctest::Approx(1));
}

TEST_CASE("the_history_is_bounded") {
  FrameStats stats;
  for (int i = 0; i < 1000; ++i) stats.add(frame(i, 1));
  CHECK(stats.history().size() == 240);
}

TEST_CASE("while_only_the_camera_moves_the_frame_is_that_of_the_camera_and_links_stay_known") {
  FrameStats stats;
  stats.add(frame(1, 4));
  for (int i = 0; i < 3; ++i) stats.add({.when = 2 + 0.01 * i, .links = {}, .draw = 7, .frame = 8});
  CHECK(stats.median()->frame == 8);
  CHECK(stats.median()->links.total() == 0);
  CHECK(stats.deforming_median()->links[Link::blend] == 4);
  CHECK(stats.history().size() == 1);
  stats.add(frame(3, 6));
  CHECK(stats.median()->links[Link::blend] == 6);
}
