#include "document/timeline.h"

#include <doctest/doctest.h>

#include "support/posed_cube.h"

using namespace viete;
using namespace viete::document;

namespace {

// Interpolates one number per key instead of a pose.
struct EasedKeys {
  Timeline timeline;
  std::vector<double> values;

  void add(int frame, double value, Easing easing = Easing::smooth) {
    timeline.keys.push_back(test::key(frame, test::turned_cube(value), easing));
    values.push_back(value);
    timeline.last = frame;
  }
  double at(double frame) const {
    double sum = 0;
    for (const auto& [key, factor] : moment_at(timeline, frame).shares) sum += factor * values[key];
    return sum;
  }
  double slope(double frame, double step) const { return (at(frame + step) - at(frame)) / step; }
};

EasedKeys all_easings_in_turn() {
  EasedKeys n;
  const Easing all[] = {Easing::smooth, Easing::smooth, Easing::constant_speed,
                        Easing::smooth, Easing::hold,   Easing::smooth};
  int frame = -7;
  for (const Easing easing : all) {
    n.add(frame, frame * 1.7 - (frame % 3) * 20, easing);
    frame += 2 + std::abs(frame % 5);
  }
  return n;
}

double total(const Moment& moment) {
  double sum = 0;
  for (const auto& [key, factor] : moment.shares) sum += factor;
  return sum;
}

CameraKey camera(int frame, float yaw, float distance = 4, float x = 0) {
  return {frame, {{x, 0, 0}, distance, yaw, 0.3f}};
}

}  // namespace

TEST_CASE("shares_of_keys_sum_to_1_at_any_moment") {
  EasedKeys n = all_easings_in_turn();
  for (const bool closed : {false, true}) {
    if (closed) n.timeline.keys.back().pose = n.timeline.keys.front().pose;
    for (double frame = -20; frame < 60; frame += 0.13) {
      const Moment moment = moment_at(n.timeline, frame);
      CHECK(total(moment) == doctest::Approx(1).epsilon(1e-14));
      CHECK(moment.shares.size() <= 4);
      CHECK(moment.from < n.timeline.keys.size());
    }
  }
}

TEST_CASE("a_keys_frame_is_that_key_alone_and_outside_of_all_keys_the_nearest_one_stays") {
  const EasedKeys n = all_easings_in_turn();
  for (std::size_t i = 0; i < n.values.size(); ++i) {
    const Moment moment = moment_at(n.timeline, n.timeline.keys[i].frame);
    REQUIRE(moment.shares.size() == 1);
    CHECK(moment.shares[0].key == i);
    CHECK(moment.shares[0].factor == 1);
    CHECK(moment.from == i);
  }
  CHECK(n.at(-1e6) == n.values.front());
  CHECK(n.at(1e6) == n.values.back());
  CHECK(n.at(std::nan("")) == n.values.front());
}

TEST_CASE("motion_is_continuous_except_at_hold_keys") {
  const EasedKeys n = all_easings_in_turn();
  for (std::size_t i = 1; i < n.values.size(); ++i) {
    const int frame = n.timeline.keys[i].frame;
    const bool held = n.timeline.keys[i - 1].easing == Easing::hold;
    CHECK((std::abs(n.at(frame - 1e-9) - n.values[i]) < 1e-6) == !held);
    CHECK(std::abs(n.at(frame + 1e-9) - n.values[i]) < 1e-6);
  }
}

TEST_CASE("smooth_keys_flow_with_one_slope_at_uneven_times_and_rest_at_both_ends") {
  EasedKeys n;
  for (const auto& [frame, value] : {std::pair(1, 0.0), {4, 5.0}, {20, -3.0}, {21, 4.0}, {50, 4.0}})
    n.add(frame, value);
  for (const int frame : {4, 20, 21})
    CHECK(n.slope(frame, -1e-5) == doctest::Approx(n.slope(frame, 1e-5)).epsilon(1e-4));
  CHECK(n.slope(1, 1e-5) == doctest::Approx(0).scale(1).epsilon(1e-4));
  CHECK(n.slope(50, -1e-5) == doctest::Approx(0).scale(1).epsilon(1e-4));
  // The intervals differ, but the value is linear in the frame. The curve is linear between inner keys.
  EasedKeys even;
  for (const int frame : {0, 1, 7, 9, 30}) even.add(frame, 2.5 * frame);
  for (double frame = 1; frame <= 9; frame += 0.25) CHECK(even.at(frame) == doctest::Approx(2.5 * frame));
}

TEST_CASE("beside_a_linear_piece_a_smooth_one_has_its_slope_and_beside_a_hold_it_rests") {
  EasedKeys n;
  n.add(0, 0);
  n.add(10, 1, Easing::constant_speed);
  n.add(20, 4);
  n.add(30, 3, Easing::hold);
  n.add(40, 9);
  n.add(50, 1);
  CHECK(n.slope(10, -1e-5) == doctest::Approx(0.3).epsilon(1e-4));
  CHECK(n.slope(20, 1e-5) == doctest::Approx(0.3).epsilon(1e-4));
  CHECK(n.at(15) == doctest::Approx(2.5));
  CHECK(n.slope(30, -1e-5) == doctest::Approx(0).scale(1).epsilon(1e-4));
  CHECK(n.at(39.999) == 3);
  CHECK(n.slope(40, 1e-5) == doctest::Approx(0).scale(1).epsilon(1e-4));
}

TEST_CASE("a_loop_whose_last_key_is_the_first_one_flows_through_it") {
  EasedKeys n;
  for (const auto& [frame, value] : {std::pair(1, 2.0), {5, 7.0}, {16, 1.0}, {22, 2.0}}) n.add(frame, value);
  CHECK(n.slope(1, 1e-5) == doctest::Approx(n.slope(22, -1e-5)).epsilon(1e-4));
  CHECK(std::abs(n.slope(1, 1e-5)) > 0.1);
  n.timeline.repeat = Repeat::once;
  CHECK(n.slope(1, 1e-5) == doctest::Approx(0).scale(1).epsilon(1e-4));
  // A looped wheel with keys over a whole turn rotates at constant speed.
  EasedKeys wheel;
  for (int i = 0; i <= 4; ++i) wheel.add(10 * i, 90 * i);
  wheel.timeline.keys.back().pose =
      test::whole({wheel.timeline.keys.front().pose->cage.positions, {{0, 0, 2 * std::numbers::pi}}});
  for (double frame = 0; frame <= 40; frame += 0.5) CHECK(wheel.at(frame) == doctest::Approx(9 * frame));
}

TEST_CASE("playing_goes_by_seconds_and_ends_loops_or_turns_round") {
  Timeline t;
  t.first = 11;
  t.last = 31;
  t.rate = 10;
  bool backward = false;
  t.repeat = Repeat::once;
  CHECK(*played(t, 11, 0.5, backward) == doctest::Approx(16));
  CHECK(*played(t, 30, 0.1, backward) == doctest::Approx(31));
  CHECK_FALSE(played(t, 30, 0.2, backward));
  CHECK(*played(t, -50, 0.5, backward) == doctest::Approx(16));  // starts at the first frame
  t.repeat = Repeat::loop;
  CHECK(*played(t, 30, 0.2, backward) == doctest::Approx(12));
  CHECK(*played(t, 30, 0.2 + 2e6, backward) == doctest::Approx(12));  // a million loops
  CHECK_FALSE(backward);
  t.repeat = Repeat::ping_pong;
  CHECK(*played(t, 30, 0.3, backward) == doctest::Approx(29));
  CHECK(backward);
  CHECK(*played(t, 12, 0.3, backward) == doctest::Approx(13));
  CHECK_FALSE(backward);
  CHECK(*played(t, 12, 4, backward) == doctest::Approx(12));
  CHECK_FALSE(backward);
  CHECK(*played(t, 12, 2, backward) == doctest::Approx(30));
  CHECK(backward);
  CHECK(*played(t, 30, 2, backward) == doctest::Approx(12));
  CHECK_FALSE(backward);
  CHECK_FALSE(played(t, 12, std::numeric_limits<double>::infinity(), backward));
}

TEST_CASE("cameras_go_smoothly_from_key_to_key") {
  Timeline t;
  CHECK_FALSE(camera_at(t, 1));
  t.cameras = {camera(1, 0, 1), camera(11, 1, 4, 2), camera(31, 1, 1)};
  CHECK(*camera_at(t, 11) == t.cameras[1].camera);
  CHECK(*camera_at(t, -9) == t.cameras[0].camera);
  CHECK(*camera_at(t, 99) == t.cameras[2].camera);
  double yaw = 0;
  for (double frame = 1; frame < 11; frame += 0.5) {
    const CameraPose pose = *camera_at(t, frame);
    CHECK(pose.yaw >= yaw);
    CHECK(pose.distance > 0);
    yaw = pose.yaw;
  }
  // The spline overshoots, but the pitch is at most vertical.
  t.cameras = {camera(1, 0), camera(11, 0), camera(21, 0), camera(31, 0)};
  t.cameras[1].camera.pitch = t.cameras[2].camera.pitch = 1.57f;
  for (double frame = 1; frame < 31; frame += 0.5) CHECK(camera_at(t, frame)->pitch <= 1.5707964f);
}

TEST_CASE("a_camera_that_turns_whole_turns_goes_on_at_an_even_speed") {
  Timeline t;
  const auto whole = static_cast<float>(2 * std::numbers::pi);
  t.cameras = {camera(1, 1), camera(31, 1 + whole / 2), camera(61, 1 + whole)};
  for (const Repeat repeat : {Repeat::once, Repeat::loop}) {
    t.repeat = repeat;
    for (double frame = 1; frame <= 61; frame += 1.5)
      CHECK(camera_at(t, frame)->yaw == doctest::Approx(1 + whole * (frame - 1) / 60).epsilon(1e-6));
  }
}
