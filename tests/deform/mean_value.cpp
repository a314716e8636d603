#include "deform/point_weights.h"

#include <doctest/doctest.h>

#include <numeric>

#include "base/error.h"
#include "deform/bound.h"

using namespace viete::test;

namespace {

struct Answer {
  std::vector<double> weights;
  bool exists;

  double sum() const { return std::accumulate(weights.begin(), weights.end(), 0.0); }
};

Answer at(const Cage& cage, const Vec3& p) {
  Answer a{std::vector<double>(cage.surface.positions.size()), false};
  a.exists = mean_value_weights(cage, p, a.weights);
  return a;
}

Vec3 blended(const Cage& cage, const Answer& a) {
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 0; i < a.weights.size(); ++i) sum = sum + a.weights[i] * cage.surface.positions[i];
  return sum;
}

}  // namespace

TEST_CASE("weights_reproduce_points_inside_and_outside_a_closed_cage") {
  Random random(9);
  for (const auto& surface : {box({1, 2, 3}), tube(7, 9, 0.5, 3)}) {
    const Cage cage = make_cage(surface);
    for (int n = 0; n < 300; ++n) {
      const Vec3 p = random.vector(4);
      const Answer a = at(cage, p);
      CHECK(a.exists);
      CHECK(a.sum() == doctest::Approx(1).epsilon(1e-13));
      CHECK(norm(blended(cage, a) - p) < 1e-12 * cage.diagonal);
    }
  }
}

TEST_CASE("weights_in_the_middle_of_an_octahedron_are_equal") {
  const Cage cage = make_cage(viete::mesh::from_triangles(
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}));
  for (const double w : at(cage, {0, 0, 0}).weights) CHECK(w == doctest::Approx(1.0 / 6).epsilon(1e-14));
}

TEST_CASE("weights_inside_a_convex_cage_are_positive") {
  const Cage cage = make_cage(box());
  Random random(10);
  for (int n = 0; n < 200; ++n) {
    for (const double w : at(cage, random.vector(0.999)).weights) CHECK(w > 0);
  }
}

TEST_CASE("an_inside_out_cage_has_the_same_weights") {
  auto t = box({1, 2, 3}).triangles;
  for (auto& x : t) std::swap(x[1], x[2]);
  const Cage cage = make_cage(box({1, 2, 3})),
             turned = make_cage(viete::mesh::from_triangles(cage.surface.positions, t));
  const auto a = at(cage, {0.3, 0.4, 0.5}).weights, b = at(turned, {0.3, 0.4, 0.5}).weights;
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-13));
}

TEST_CASE("on_a_vertex_weight_one_on_an_edge_linear_on_a_face_barycentric") {
  const Cage cage = make_cage(box());
  const auto& x = cage.surface.positions;
  for (std::size_t v = 0; v < x.size(); ++v)
    CHECK(at(cage, x[v]).weights[v] == doctest::Approx(1).epsilon(1e-13));
  const auto edge = at(cage, 0.25 * x[0] + 0.75 * x[1]).weights;
  CHECK(edge[0] == doctest::Approx(0.25));
  CHECK(edge[1] == doctest::Approx(0.75));
  const auto& t = cage.surface.triangles[5];
  const auto face = at(cage, 0.5 * x[t[0]] + 0.2 * x[t[1]] + 0.3 * x[t[2]]).weights;
  CHECK(face[t[0]] == doctest::Approx(0.5));
  CHECK(face[t[1]] == doctest::Approx(0.2));
  CHECK(face[t[2]] == doctest::Approx(0.3));
}

TEST_CASE("towards_vertex_edge_and_face_weights_stay_exact_and_reach_the_limit") {
  const Cage cage = make_cage(box({1, 2, 3}));
  const auto& x = cage.surface.positions;
  const auto& t = cage.surface.triangles[2];
  const Vec3 inward{0.3, 0.2, -1};
  for (const Vec3& limit : {x[4], 0.5 * (x[t[0]] + x[t[1]]), (1.0 / 3) * (x[t[0]] + x[t[1]] + x[t[2]])}) {
    const auto on = at(cage, limit).weights;
    for (double d = 1e-2; d > 1e-18; d /= 10) {
      for (const double side : {1.0, -1.0}) {
        const Vec3 p = limit + (side * d) * inward;
        const Answer a = at(cage, p);
        CHECK(a.exists);
        CHECK(norm(blended(cage, a) - p) < 1e-13 * cage.diagonal);
        for (std::size_t i = 0; i < on.size(); ++i)
          CHECK(std::abs(a.weights[i] - on[i]) < 20 * d * (1 - std::log(d)) + 1e-12);
      }
    }
  }
}

TEST_CASE("in_the_plane_of_a_face_but_outside_of_it_weights_are_exact_and_continuous") {
  const Cage cage = make_cage(box());
  Random random(11);
  for (int n = 0; n < 50; ++n) {
    const Vec3 p{random(1.5, 4), random(-4, 4), 1};  // in the plane of the top
    const auto in = at(cage, p);
    CHECK(in.exists);
    CHECK(norm(blended(cage, in) - p) < 1e-12 * cage.diagonal);
    for (double d = 1e-16; d < 1e-5; d *= 10) {
      const Vec3 q = p + Vec3{0, 0, d};
      const auto near = at(cage, q);
      CHECK(norm(blended(cage, near) - q) < 1e-12 * cage.diagonal);
      for (std::size_t i = 0; i < in.weights.size(); ++i)
        CHECK(std::abs(near.weights[i] - in.weights[i]) < 1e-6 + 10 * d);
    }
  }
}

TEST_CASE("far_away_weights_are_finite_and_sum_to_one") {
  const Cage cage = make_cage(box({1, 2, 3}));
  for (double r = 10; r < 1e12; r *= 10) {
    const Answer a = at(cage, {0.5 * r, r, -0.3 * r});
    for (const double w : a.weights) CHECK(std::isfinite(w));
    CHECK(a.sum() == doctest::Approx(1).epsilon(1e-6));
    if (r < 1e3) CHECK(a.exists);
  }
}

TEST_CASE("an_open_cage_has_finite_weights_that_sum_to_one") {
  auto t = box().triangles;
  t.resize(7);
  const Cage cage = make_cage(viete::mesh::from_triangles(box().positions, t));
  Random random(12);
  for (int n = 0; n < 300; ++n) {
    const Answer a = at(cage, random.vector(2));
    for (const double w : a.weights) CHECK(std::isfinite(w));
    CHECK(a.sum() == doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("where_the_sum_vanishes_the_closest_point_of_the_cage_is_used_and_said_so") {
  // One triangle: in its plane outside of it every weight is 0.
  const Cage cage = make_cage(viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  const Answer a = at(cage, {0.25, -1, 0});
  CHECK_FALSE(a.exists);
  CHECK(a.weights[0] == doctest::Approx(0.75));
  CHECK(a.weights[1] == doctest::Approx(0.25));
  CHECK(a.weights[2] == doctest::Approx(0));
}

TEST_CASE("weights_are_the_same_at_every_length_scale") {
  for (const double s : {1e-30, 1e30}) {
    const auto a = at(make_cage(box({1, 2, 3})), {0.2, 0.9, -1.3}).weights;
    const auto b = at(make_cage(box({s, 2 * s, 3 * s})), {0.2 * s, 0.9 * s, -1.3 * s}).weights;
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-12));
  }
}

TEST_CASE("a_cage_whose_faces_disagree_follows_as_one_whose_faces_agree") {
  const auto sound = tube(7, 9, 0.5, 3);
  auto some = sound.triangles, twice = sound.triangles;
  for (std::size_t t = 0; t < some.size(); t += 3) std::swap(some[t][1], some[t][2]);
  for (const auto& [a, b, c] : sound.triangles) twice.push_back({b, a, c});
  const auto model = tube(12, 10, 0.3, 2);
  Bound reference(model, sound, mean_values, 2, Blend::linear);
  const auto motion = similarity({1, 2, 3}, 37 * degree);
  for (const auto& triangles : {some, twice}) {
    Bound b(model, viete::mesh::from_triangles(sound.positions, triangles), mean_values, 2, Blend::linear);
    CHECK(b.error(motion) < 1e-12);
    REQUIRE(b.binding->warnings.size() == 1);
    CHECK(b.binding->warnings[0].starts_with("mean value coordinates turn, or leave out, "));
    auto posed = sound.positions;
    posed[3] = posed[3] + Vec3{0.4, 0.2, 0.1};
    CHECK(largest_distance(b.deform({posed, {}}), reference.deform({posed, {}})) < 1e-12);
  }
}

TEST_CASE("a_cage_that_has_no_outside_is_refused_for_mean_value_coordinates_alone") {
  std::vector<viete::mesh::Point> positions;
  std::vector<viete::mesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < 6; ++i) {  // a Moebius strip
    for (int j = 0; j < 2; ++j) positions.push_back({std::cos(1.0 * i), std::sin(1.0 * i), 1.0 * j});
    const std::uint32_t a = 2 * i, b = a + 1, c = i < 5 ? a + 2 : 1, d = i < 5 ? a + 3 : 0;
    triangles.push_back({a, c, b}), triangles.push_back({b, c, d});
  }
  const auto strip = viete::mesh::from_triangles(positions, triangles);
  const auto model = tube(6, 5, 0.3, 1);
  CHECK_THROWS_WITH_AS(Bound(model, strip, mean_values, 2, Blend::linear), doctest::Contains("cannot agree"),
                       viete::base::Error);
  CHECK_NOTHROW(Bound(model, strip, faces));
}
