#include "workspace/frame_stats.h"

#include <doctest/doctest.h>

using namespace viete::workspace;
using viete::pose::Stage;

namespace {

FrameTimes frame(double when, double blend) {
  FrameTimes t;
  t.when = when;
  t.stages[Stage::blend] = blend;
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
  CHECK(stats.median()->stages[Stage::blend] == 4);
}

TEST_CASE("the_median_changes_at_most_four_times_a_second") {
  FrameStats stats;
  int changes = 0;
  double shown = 0;
  for (int i = 0; i < 200; ++i) {
    stats.add(frame(0.01 * i, i + 1));
    changes += std::exchange(shown, stats.median()->frame) != stats.median()->frame;
  }
  CHECK(changes > 4);
  CHECK(changes <= 8);
}

TEST_CASE("frames_of_another_method_are_no_part_of_the_median") {
  FrameStats stats;
  for (int i = 0; i < 10; ++i) stats.add(frame(0.01 * i, 100));
  auto other = frame(0.11, 2);
  other.method = viete::sym3::Method::diag;
  stats.add(other);
  CHECK(stats.median()->stages[Stage::blend] == 2);
  CHECK(stats.median()->method == viete::sym3::Method::diag);
}

TEST_CASE("camera_motion_keeps_the_last_deformation_timings") {
  FrameStats stats;
  stats.add(frame(1, 4));
  for (int i = 0; i < 3; ++i) stats.add({.when = 2 + 0.01 * i, .stages = {}, .draw = 7, .frame = 8});
  CHECK(stats.median()->frame == 8);
  CHECK(stats.median()->stages.total() == 0);
  CHECK(stats.deforming_median()->stages[Stage::blend] == 4);
  stats.add(frame(3, 6));
  CHECK(stats.median()->stages[Stage::blend] == 6);
}

TEST_CASE("medians_say_that_the_computer_is_busy_if_threads_wait_for_the_processor") {
  const auto of = [](double wall, double processor) {
    FrameTimes t = frame(1, 4);
    t.cost = {.longest = processor, .wall = wall};
    return t;
  };
  const auto busy = [](const std::vector<FrameTimes>& frames) {
    return viete::workspace::median_of(frames).busy;
  };
  CHECK_FALSE(busy({of(0.040, 0.039), of(0.041, 0.039)}));
  CHECK(busy({of(0.040, 0.039), of(0.091, 0.039)}));
  CHECK(busy({of(0.080, 0.039), of(0.070, 0.039)}));
  CHECK_FALSE(busy({of(0.0003, 0.0001), of(0.0003, 0.0001)}));  // threads need some time to wake up
  CHECK_FALSE(busy({frame(1, 4)}));
}
