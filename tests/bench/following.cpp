#include "bench/following.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "deform/shapes.h"
#include "mesh/shapes.h"

using namespace viete;
using namespace viete::bench;
using test::box;

namespace {

const deform::Cage cage = deform::make_cage(box({1, 1, 1}, {4, 5, 6}));
const std::vector<mesh::Point> model = test::moved(test::sphere(1), 0.5, 5).positions;

// The affine map that takes three corners of the box and a fourth where they are posed.
std::vector<mesh::Point> with_the_box(const deform::Pose& pose) {
  const auto& p = pose.positions;
  std::vector<mesh::Point> moved;
  for (const mesh::Point& x : model) {
    const mesh::Point t = 0.5 * (x - cage.surface.positions[0]);
    moved.push_back(p[0] + t[0] * (p[1] - p[0]) + t[1] * (p[2] - p[0]) + t[2] * (p[4] - p[0]));
  }
  return moved;
}

// All of it by the mean motion of the box's vertices.
std::vector<mesh::Point> by_the_mean(const deform::Pose& pose) {
  mesh::Point mean{0, 0, 0};
  for (std::size_t v = 0; v < 8; ++v) mean = mean + 0.125 * (pose.positions[v] - cage.surface.positions[v]);
  return test::mapped(model, [&](const mesh::Point& x) { return x + mean; });
}

}  // namespace

TEST_CASE("what_moves_with_the_cage_reproduces_every_pose_of_the_whole") {
  for (const auto& pose : whole_poses()) CHECK(deviation(pose, cage, model, with_the_box) < 1e-14);
}

TEST_CASE("what_only_follows_the_mean_reproduces_translations_alone") {
  CHECK(deviation(whole_poses()[0], cage, model, by_the_mean) < 1e-14);
  for (const auto& pose : whole_poses().subspan(1)) CHECK(deviation(pose, cage, model, by_the_mean) > 0.01);
}

TEST_CASE("deviation_is_the_largest_distance_in_diagonals_of_the_posed_cage") {
  const Deform stays = [](const deform::Pose&) { return model; };
  const double shift = std::sqrt(0.3 * 0.3 + 0.2 * 0.2 + 0.4 * 0.4);
  CHECK(deviation(whole_poses()[0], cage, model, stays) == doctest::Approx(shift));
  const Deform one_off = [](const deform::Pose& pose) {
    auto moved = with_the_box(pose);
    moved[3][1] += 0.25;
    return moved;
  };
  CHECK(deviation(whole_poses()[0], cage, model, one_off) == doctest::Approx(0.25 / cage.diagonal));
  const Deform lost = [](const deform::Pose&) {
    return std::vector(model.size(), mesh::Point{std::nan(""), 0, 0});
  };
  CHECK(std::isnan(deviation(whole_poses()[0], cage, model, lost)));
}

TEST_CASE("each_pose_of_the_whole_is_of_its_kind_and_no_simpler") {
  const auto stretches = [](const WholePose& pose) {
    double least = HUGE_VAL, most = 0;
    for (const mesh::Point& axis : {mesh::Point{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0.8, 0}}) {
      const double length = mesh::norm(test::Affine{pose.linear}(axis));
      least = std::min(least, length), most = std::max(most, length);
    }
    return std::pair{least, most};
  };
  REQUIRE(whole_poses().size() == 4);
  CHECK(whole_poses()[0].linear == sym3::Mat3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  CHECK(whole_poses()[1].linear[1] != 0);
  CHECK(stretches(whole_poses()[1]).first == doctest::Approx(1));
  CHECK(stretches(whole_poses()[1]).second == doctest::Approx(1));
  CHECK(stretches(whole_poses()[2]).first == doctest::Approx(1.3));
  CHECK(stretches(whole_poses()[2]).second == doctest::Approx(1.3));
  CHECK(stretches(whole_poses()[3]).second > 1.1 * stretches(whole_poses()[3]).first);
}

TEST_CASE("leak_is_the_motion_of_what_is_far_from_the_vertex_that_moves") {
  // One of eight vertices moves by a tenth of the diagonal, and all of the model by an eighth of that.
  CHECK(leak(cage, model, by_the_mean) == doctest::Approx(0.1 / 8));
  const Deform near_alone = [](const deform::Pose& pose) {
    auto moved = model;
    for (std::size_t v = 0; v < 8; ++v) {
      const auto& from = cage.surface.positions[v];
      for (std::size_t i = 0; i < model.size(); ++i) {
        if (mesh::norm(model[i] - from) <= 0.25 * cage.diagonal)
          moved[i] = moved[i] + (pose.positions[v] - from);
      }
    }
    return moved;
  };
  CHECK(leak(cage, model, near_alone) == 0);
  const std::vector<mesh::Point> none;
  CHECK(std::isnan(leak(cage, none, [&](const deform::Pose&) { return none; })));
}

TEST_CASE("the_gap_is_the_mean_distance_from_where_the_nearest_points_have_gone") {
  base::WorkerPool pool(1);
  const std::vector<mesh::Point> points = {{4.9, 5.1, 6.2}, {4, 4.3, 6}};  // 0.1 and 0.3 from a face
  const auto nearest = nearest_on_cage(cage, points, pool);
  const std::vector<double> shares = {0.75, 0.25};
  const auto& rest = cage.surface.positions;
  CHECK(gap(cage, nearest, shares, rest, points) ==
        doctest::Approx((0.75 * 0.1 + 0.25 * 0.3) / cage.diagonal));
  // The cage goes along x: away from the first by 0.5 more, from the second sideways.
  const auto away = test::mapped(rest, [](const mesh::Point& p) { return p + mesh::Point{0.5, 0, 0}; });
  CHECK(gap(cage, nearest, shares, away, points) ==
        doctest::Approx((0.75 * 0.6 + 0.25 * std::hypot(0.5, 0.3)) / cage.diagonal));
}
