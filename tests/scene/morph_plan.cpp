#include "scene/files/morph_plan.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "support/text.h"

using namespace viete;
using namespace viete::scene;
using mesh::Point;

namespace {

using Positions = std::vector<Point>;

Positions line_of_points(std::size_t count) {
  Positions points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({double(i) / double(count), 0.1, 0.2});
  return points;
}

Positions turned(const Positions& points, double angle, double along = 0) {
  Positions result;
  for (const Point& p : points)
    result.push_back({std::cos(angle) * p[0] - std::sin(angle) * p[1] + along,
                      std::sin(angle) * p[0] + std::cos(angle) * p[1], p[2]});
  return result;
}

MorphPlan plan(const Positions& rest, const std::vector<double>& frames, const MotionAt& at,
               MorphWish wish = {.tolerance = 1e-4}) {
  base::WorkerPool pool(2);
  return plan_morphs(rest, frames, at, wish, pool);
}

// As a player of floats shows it.
Positions shown(const MorphPlan& plan, const Positions& rest, const MotionAt& at, double frame) {
  std::size_t b = 1;
  while (b + 1 < plan.frames.size() && plan.frames[b] < frame) ++b;
  const double t = (frame - plan.frames[b - 1]) / (plan.frames[b] - plan.frames[b - 1]);
  Positions sum = rest;
  const std::size_t count = plan.targets.size();
  for (std::size_t k = 0; k < count; ++k) {
    const double from = plan.weights[(b - 1) * count + k], to = plan.weights[b * count + k];
    const Positions target = plan.positions(k, rest, at);
    for (std::size_t v = 0; v < rest.size(); ++v)
      sum[v] = sum[v] + (from + t * (to - from)) * (target[v] - rest[v]);
  }
  return sum;
}

double off_by(const Positions& a, const Positions& b) {
  double worst = 0;
  for (std::size_t v = 0; v < a.size(); ++v) worst = std::max(worst, mesh::norm(a[v] - b[v]));
  return worst;
}

std::string refused(const Positions& rest, const std::vector<double>& frames, const MotionAt& at,
                    const MorphWish& wish = {.tolerance = 1e-4}) {
  try {
    plan(rest, frames, at, wish);
  } catch (const base::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a_turn_takes_many_lines_and_three_targets") {
  const Positions rest = line_of_points(40);
  const MotionAt at = [&](double frame) { return turned(rest, 0.1 * frame, 0.02 * frame); };
  const MorphPlan made = plan(rest, {0, 30}, at);
  CHECK(made.frames.size() > 40);
  CHECK(made.targets.size() == 4);  // two of the turn, one of the way, and the steady one
  for (double frame = 0; frame <= 30; frame += 0.37)
    CHECK(off_by(shown(made, rest, at, frame), at(frame)) < 1e-4);
  CHECK(made.error < 1e-4);
  bool within = true;
  for (const float w : made.weights) within &= w >= 0 && w <= 1;
  CHECK(within);
}

TEST_CASE("what_stays_within_the_tolerance_of_rest_moves_nothing") {
  const Positions rest = line_of_points(40);
  const MorphPlan still = plan(rest, {0, 10}, [&](double frame) {
    Positions p = rest;
    p[3][2] += 3e-5 * std::sin(frame);
    return p;
  });
  CHECK(still.targets.empty());
  const MorphPlan one = plan(rest, {0, 10}, [&](double frame) {
    Positions p = rest;
    for (auto& x : p) x[1] += 1e-6;
    p[7][2] += 0.1 * frame;
    return p;
  });
  CHECK(one.targets.size() == 1);
  CHECK(std::ranges::count(one.moves, 1) == 1);
  CHECK(one.moves[7] == 1);
}

TEST_CASE("a_jump_stays_one_and_given_frames_are_moments_alone") {
  const Positions rest = line_of_points(10);
  const MotionAt at = [&](double frame) { return turned(rest, frame < 5 ? 0 : 1); };
  CHECK(plan(rest, {0, 5 - jump_frames, 5, 9}, at).frames.size() == 4);
  const MotionAt turning = [&](double frame) { return turned(rest, frame); };
  const MorphPlan coarse = plan(rest, {0, 1, 2, 3}, turning, {.tolerance = 1e-4, .refines = false});
  CHECK(coarse.frames == std::vector<double>{0, 1, 2, 3});
  for (const double frame : coarse.frames)
    CHECK(off_by(shown(coarse, rest, turning, frame), turning(frame)) < 1e-4);
}

TEST_CASE("far_vertices_are_held_to_what_floats_hold_and_near_ones_to_the_tolerance") {
  const Positions rest = line_of_points(30);
  for (const double far : {1e6, 1e9, 1e30}) {
    CAPTURE(far);
    const MotionAt at = [&](double frame) {
      Positions p = turned(rest, 0.2 * frame);
      const double t = frame / 8;
      p[5] = p[5] + Point{far * t * t * (3 - 2 * t), 0, 0};
      return p;
    };
    const MorphPlan made = plan(rest, {0, 8}, at);
    CHECK(made.targets.size() <= 6);
    CHECK(made.bytes(24) < 1e6);
    CHECK(made.farthest == doctest::Approx(far));
    for (double frame = 0; frame <= 8; frame += 0.31) {
      Positions found = shown(made, rest, at, frame), expected = at(frame);
      CHECK(mesh::norm(found[5] - expected[5]) < float_noise * far * 1.1);
      found[5] = expected[5] = {0, 0, 0};
      CHECK(off_by(found, expected) < 1e-4);
    }
  }
}

TEST_CASE("more_than_is_allowed_is_refused_with_numbers_before_it_is_held") {
  const Positions rest = line_of_points(400);
  const auto noise = [](std::size_t i) { return std::fmod(std::sin(double(i)) * 43758.5453, 1.0); };
  const MotionAt at = [&](double frame) {
    Positions p = rest;
    for (std::size_t v = 0; v < p.size(); ++v) p[v][1] += noise(v + 1000 * static_cast<std::size_t>(frame));
    return p;
  };
  std::vector<double> frames;
  for (int i = 0; i < 200; ++i) frames.push_back(i);
  const std::string problem =
      refused(rest, frames, at, {.tolerance = 1e-4, .refines = false, .most_bytes = 1e5});
  CHECK(test::mentions(problem, "morph targets of 400 vertices"));
  CHECK(test::mentions(problem, "allow a larger tolerance"));
  std::size_t asked = 0;
  const MotionAt fast = [&](double frame) {
    ++asked;
    return turned(rest, 1e4 * frame);
  };
  CHECK(test::mentions(refused(rest, {0, 300, 600}, fast, {.tolerance = 1e-7}), "straight lines, more than"));
  CHECK(asked < 50000);
}

TEST_CASE("positions_that_floats_do_not_hold_are_refused_with_the_first_vertex") {
  const Positions rest = line_of_points(10);
  for (const double bad :
       {1e39, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const MotionAt at = [&](double frame) {
      Positions p = rest;
      if (frame > 1) p[4][1] = bad;
      return p;
    };
    const std::string problem = refused(rest, {0, 2}, at);
    CHECK(test::mentions(problem, "vertex 4"));
    CHECK(test::mentions(problem, "floats of glTF"));
  }
}
