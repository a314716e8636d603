#include "shapes/pose_space.h"

#include <doctest/doctest.h>

#include "support/caged_shapes.h"

using namespace viete;
using namespace viete::test;

namespace {

struct Posed {
  std::shared_ptr<const Cage> cage;
  PoseSpace space;

  explicit Posed(mesh::Surface surface)
      : cage(std::make_shared<const Cage>(make_cage(std::move(surface)))), space(cage) {}

  const std::vector<mesh::Point>& rest() const { return cage->surface.positions; }
  Pose by(const Affine& map) const { return {mapped(rest(), map), {}}; }
  // Returns a pose between rest and `pose`.
  Pose share(const Pose& pose, double factor) const {
    const LogVector v = space.vector(pose);
    const std::array terms{LogTerm{&v, factor}};
    return space.pose(terms, space.logs().anchors_from(space.logs().at_rest(), terms));
  }
  Pose between(const LogVector& a, const LogVector& b, double t) const {
    const std::array terms{LogTerm{&a, 1 - t}, LogTerm{&b, t}};
    return space.pose(terms, space.logs().anchors_between(a, b));
  }
  double error(const Pose& pose, const std::vector<mesh::Point>& expected) const {
    return largest_distance(pose.positions, expected) / cage->diagonal;
  }
};

std::vector<mesh::Point> shaken(const Posed& p, double size) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, size * p.cage->diagonal);
  auto positions = p.rest();
  for (auto& x : positions) x = x + Vec3{normal(random), normal(random), normal(random)};
  return positions;
}

}  // namespace

TEST_CASE("half_of_a_half_turn_is_a_quarter_turn") {
  const Posed p(tube(9, 7, 0.3, 2));
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 2, -3}}) {
    for (const double angle : {180.0, 179.999, 90.0, 20.0, -150.0}) {
      const Pose half = p.share(p.by(similarity(axis, angle * degree)), 0.5);
      const auto quarter = mapped(p.rest(), similarity(axis, angle * degree / 2));
      // At 180 degrees, both directions of rotation are valid.
      const auto other = mapped(p.rest(), similarity(axis, -angle * degree / 2));
      const double error = p.error(half, quarter);
      CHECK((angle == 180 ? std::min(error, p.error(half, other)) : error) < 1e-12);
    }
  }
}

TEST_CASE("a_pose_comes_back_from_its_vector_even_if_it_collapses_or_mirrors") {
  const Posed p(tube(9, 7, 0.3, 2));
  std::vector<Pose> poses;
  for (const double size : {0.001, 0.01, 0.1, 1.0}) poses.push_back({shaken(p, size), {}});
  for (const Vec3& scale : {Vec3{1, 1, 0}, Vec3{-1, 1, 1}, Vec3{0, 0, 0}, Vec3{1, 1e-9, 1}})
    poses.push_back(p.by({{scale[0], 0, 0, 0, scale[1], 0, 0, 0, scale[2]}, {0.5, 0, 0}}));
  for (const Pose& pose : poses) {
    CHECK(p.error(p.share(pose, 1), pose.positions) < 1e-12);
    CHECK(p.error(p.share(pose, 0), p.rest()) == 0);
    for (const double share : {0.5, 1.5}) CHECK(all_finite(p.share(pose, share).positions));
  }
}

TEST_CASE("540_degrees_are_three_half_turns") {
  const Posed p(box());
  const double whole = 540 * degree;
  Pose pose = p.by(similarity({0, 0, 1}, whole));
  pose.turns = {{0, 0, whole}};
  for (const double share : {1.0 / 3, 2.0 / 3, 1.0, 0.25}) {
    const Pose part = p.share(pose, share);
    CHECK(p.error(part, mapped(p.rest(), similarity({0, 0, 1}, share * whole))) < 1e-12);
    CHECK(part.turns[0][2] == doctest::Approx(share * whole));
  }
}

TEST_CASE("a_pose_without_whole_turns_takes_those_nearest_to_the_preceding_pose") {
  const Posed p(box());
  LogVector before = p.space.vector(p.by({}));
  for (double angle = 0; angle <= 720; angle += 90) {
    const LogVector v = p.space.vector(p.by(similarity({0, 0, 1}, angle * degree)), before.turns);
    CHECK(v.turns[0][2] == doctest::Approx(angle * degree));
    if (angle > 0)
      CHECK(p.error(p.between(before, v, 0.5),
                    mapped(p.rest(), similarity({0, 0, 1}, (angle - 45) * degree))) < 1e-12);
    before = v;
  }
}

TEST_CASE("resting_parts_stay_and_a_limb_rotates_about_its_joint") {
  const Posed p(tube(9, 8, 0.3, 4));
  // The upper half of the tube rotates by 90 degrees about y.
  Pose pose{p.rest(), {}};
  const Affine turn = similarity({0, 1, 0}, 90 * degree);
  for (auto& x : pose.positions)
    if (x[2] > 0.1) x = turn(x);
  const LogVector rest = p.space.vector({p.rest(), {}}), posed = p.space.vector(pose);
  double tip = 0, least = 1e9;
  for (int i = 0; i <= 20; ++i) {
    const Pose part = p.between(rest, posed, i / 20.0);
    for (std::size_t v = 0; v < p.rest().size(); ++v)
      if (p.rest()[v][2] < -0.1) CHECK(norm(part.positions[v] - p.rest()[v]) < 2e-2);
    tip = norm(part.positions.back());
    least = std::min(least, tip);
  }
  // Linear interpolation would reduce the tip's distance to 1.41.
  CHECK(least > 1.9);
  const std::array half{LogTerm{&rest, 0.5}, LogTerm{&posed, 0.5}};
  CHECK(norm(p.space.linear(half).positions.back()) == doctest::Approx(std::sqrt(2.0)));
}

TEST_CASE("coincident_vertices_stay_together_between_poses") {
  const mesh::Surface surface = tube(5, 6, 0.5, 2);
  const Posed whole(surface), p(loose_triangles(surface));
  const auto bend = [](const mesh::Point& x) {
    return mesh::Point{x[0] + 0.3 * x[2] * x[2], x[1] + 0.2 * x[0] * x[2], x[2]};
  };
  const Pose half = p.share({mapped(p.rest(), bend), {}}, 0.5);
  const Pose expected = whole.share({mapped(whole.rest(), bend), {}}, 0.5);
  for (std::size_t e = 0; e < surface.triangles.size(); ++e)
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(norm(half.positions[3 * e + k] - expected.positions[surface.triangles[e][k]]) < 0.01);
}

TEST_CASE("poses_far_from_rest_lose_only_rounding") {
  const Posed p(tube(9, 7, 0.3, 2));
  const Vec3 far{1e6, -3e5, 7e5};
  const LogVector a = p.space.vector(p.by({.shift = far}));
  const LogVector b = p.space.vector(p.by(similarity({0, 0, 1}, 120 * degree, 1, far)));
  CHECK(p.error(p.between(a, b, 0.5), mapped(p.rest(), similarity({0, 0, 1}, 60 * degree, 1, far))) < 1e-9);
  CHECK_THROWS(p.space.vector({{{0, 0, 0}}, {}}));  // wrong number of vertices
}

TEST_CASE("a_posed_cage_makes_its_whole_turns_about_any_axis") {
  const Posed p(tube(9, 7, 0.3, 2));
  const auto posed = shaken(p, 0.02);
  const Vec3 middle = pose::middle(posed);
  for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0.6, 0, -0.8}}) {
    for (const double count : {1.0, -2.0}) {
      const LogVector from = p.space.vector({posed, {{0, 0, 0}}});
      const LogVector to = p.space.vector({posed, {count * 360 * degree * axis}});
      for (const double share : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
        auto expected = posed;
        const Affine turn = similarity(axis, share * count * 360 * degree);
        for (Vec3& x : expected) x = middle + turn(x - middle);
        // About 2 % of the shape is not represented by logs. This part does not rotate between the keys.
        const bool is_key = share == 0 || share == 1;
        CHECK(p.error(p.between(from, to, share), expected) < (is_key ? 1e-12 : 0.04));
      }
    }
  }
}
