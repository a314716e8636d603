#include "weights/point_weights.h"
#include "deform/bound.h"
#include "support/shapes.h"

using namespace viete::test;

namespace {

std::vector<double> weights_at(const Cage& cage, const Vec3& p) {
  return bind_part(Weigher(cage, faces), std::array{p}).binding.weights;
}

// Returns the cut-off weights and the share.
std::vector<double> cut_off_at(const Cage& cage, const Vec3& p, double radius) {
  Binding part = bind_part(Weigher(cage, viete::test::cut_off(radius)), std::array{p}).binding;
  part.weights.push_back(part.shares[0]);
  return part.weights;
}

using Long3 = std::array<long double, 3>;

long double long_dot(const Long3& a, const Long3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

long double squared_distance(const Cage& cage, std::size_t e, const Vec3& point) {
  const auto difference = [](const auto& a, const auto& b) {
    return Long3{(long double)a[0] - b[0], (long double)a[1] - b[1], (long double)a[2] - b[2]};
  };
  const auto& x = cage.surface.positions;
  const auto& t = cage.surface.triangles[e];
  const Long3 u = difference(x[t[1]], x[t[0]]), v = difference(x[t[2]], x[t[0]]);
  const Long3 n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  long double least = std::numeric_limits<long double>::infinity();
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    const Long3 d = difference(x[t[(i + 1) % 3]], x[t[i]]), q = difference(point, x[t[i]]);
    const Long3 inward{n[1] * d[2] - n[2] * d[1], n[2] * d[0] - n[0] * d[2], n[0] * d[1] - n[1] * d[0]};
    inside = inside && long_dot(inward, q) >= 0;
    const long double s = std::clamp<long double>(long_dot(d, q) / long_dot(d, d), 0, 1);
    const Long3 left{q[0] - s * d[0], q[1] - s * d[1], q[2] - s * d[2]};
    least = std::min(least, long_dot(left, left));
  }
  const long double height = long_dot(n, difference(point, x[t[0]]));
  return inside ? height * height / long_dot(n, n) : least;
}

double sum(const std::vector<double>& w) {
  return std::accumulate(w.begin(), w.end(), 0.0);
}

struct Answer {
  std::vector<double> weights;
  bool exists;
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

TEST_CASE("on_a_vertex_the_elements_that_meet_there_share_equally") {
  const Cage cage = make_cage(box());
  for (std::size_t v = 0; v < 8; ++v) {
    const auto w = weights_at(cage, cage.surface.positions[v]);
    double touching = 0;
    for (const auto& t : cage.surface.triangles) touching += t[0] == v || t[1] == v || t[2] == v;
    for (std::size_t e = 0; e < w.size(); ++e) {
      const auto& t = cage.surface.triangles[e];
      const bool touches = t[0] == v || t[1] == v || t[2] == v;
      if (touches)
        CHECK(w[e] == doctest::Approx(1 / touching));
      else
        CHECK(w[e] < 1e-20);
    }
  }
}

TEST_CASE("near_an_element_weights_approach_the_limit_without_a_jump") {
  const Cage cage = make_cage(box());
  for (std::size_t e = 0; e < cage.element_count(); ++e)
    CHECK(weights_at(cage, cage.centers[e])[e] == doctest::Approx(1));
  for (double d = 1e-1; d > 1e-20; d /= 10) {
    const auto w = weights_at(cage, cage.centers[0] + Vec3{0, 0, d});
    CHECK(w[0] > 1 - 100 * d * d - 1e-14);
    CHECK(sum(w) == doctest::Approx(1));
  }
}

TEST_CASE("weights_are_the_same_at_every_length_scale_and_finite_everywhere") {
  const auto cut_offs_at = [](const Cage& cage, const Vec3& p) { return cut_off_at(cage, p, 0.1); };
  const auto mean_values_at = [](const Cage& cage, const Vec3& p) { return at(cage, p).weights; };
  const Cage cage = make_cage(box({1, 2, 3}));
  Random random(5);
  for (const double s : {1e-30, 1e-3, 1e3, 1e30}) {
    const Cage other = make_cage(mapped(cage.surface, scaling(s)));
    const auto check = [&](const auto& weights, const Vec3& p) {
      const auto a = weights(cage, p), b = weights(other, s * p);
      for (std::size_t e = 0; e < a.size(); ++e) CHECK(a[e] == doctest::Approx(b[e]).epsilon(1e-10));
    };
    for (int n = 0; n < 50; ++n) {
      const Vec3 p = random.vector(4);
      check(weights_at, p);
      check(cut_offs_at, p);
      check(mean_values_at, p);
    }
    for (const auto& p : other.surface.positions) CHECK(sum(weights_at(other, p)) == doctest::Approx(1));
  }
}

TEST_CASE("elements_without_area_have_no_weight") {
  auto surface = box();
  surface.triangles.push_back({0, 1, 1});
  surface = viete::mesh::from_triangles(surface.positions, surface.triangles);
  const Cage cage = make_cage(surface);
  CHECK(weights_at(cage, {0.1, 0.2, 0.3}).back() == 0);
  CHECK(weights_at(cage, surface.positions[0]).back() == 0);
  CHECK(sum(weights_at(cage, surface.positions[1])) == doctest::Approx(1));
}

TEST_CASE("weights_match_their_definition_in_long_double") {
  Random random(3);
  for (const auto& surface : {box({1, 2, 3}), tube(7, 12, 0.6, 2)}) {
    const Cage cage = make_cage(surface);
    double worst = 0;
    for (int n = 0; n < 500; ++n) {
      const Vec3 p = random.vector(2.5);
      const auto w = weights_at(cage, p);
      long double total = 0;
      for (std::size_t e = 0; e < w.size(); ++e) total += 1 / squared_distance(cage, e, p);
      for (std::size_t e = 0; e < w.size(); ++e)
        worst = std::max(worst, double(std::abs(w[e] - 1 / squared_distance(cage, e, p) / total)));
    }
    CHECK(worst < 2e-13);
  }
}

TEST_CASE("cut_off_weights_and_shares_match_their_definition") {
  const Cage cage = make_cage(box({1, 2, 3}));
  Random random(5);
  std::size_t none = 0, some = 0, all = 0;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = random.vector(4);
    const auto w = cut_off_at(cage, p, 0.2);
    const double share = w.back();
    std::vector<long double> own;
    for (std::uint32_t e = 0; e < cage.element_count(); ++e) {
      const long double d = std::sqrt(squared_distance(cage, e, p)) / (0.2L * cage.size);
      own.push_back(d < 1 ? (1 - d) * (1 - d) : 0);
    }
    const double total = double(std::accumulate(own.begin(), own.end(), 0.0L));
    for (std::uint32_t e = 0; e < cage.element_count(); ++e) {
      CHECK(std::abs(w[e] * total - double(own[e])) < 1e-14);
      if (own[e] == 0) CHECK(w[e] == 0);
    }
    CHECK(share == doctest::Approx(std::min(total, 1.0)).epsilon(1e-12));
    if (total > 0) CHECK(sum(w) - share == doctest::Approx(1).epsilon(1e-14));
    none += total == 0;
    some += total > 0 && total < 1;
    all += total >= 1;
  }
  CHECK(std::min({none, some, all}) > 50);
}

TEST_CASE("on_an_element_and_on_both_sides_a_cut_off_weight_is_finite") {
  const Cage cage = make_cage(box({1, 2, 3}));
  CHECK(cut_off_at(cage, {1.1, 0, 0}, 0.05).back() ==
        doctest::Approx(cut_off_at(cage, {0.9, 0, 0}, 0.05).back()));
  const auto on = cut_off_at(cage, cage.centers[0], 0.01);
  CHECK(on.front() == doctest::Approx(1));
  CHECK(on.back() == doctest::Approx(1));
  for (const double x : cut_off_at(cage, {0, 0, 0}, 0.01)) CHECK(x == 0);
}

TEST_CASE("weights_reproduce_points_inside_and_outside_a_closed_cage") {
  Random random(9);
  for (const auto& surface : {box({1, 2, 3}), tube(7, 9, 0.5, 3)}) {
    const Cage cage = make_cage(surface);
    for (int n = 0; n < 300; ++n) {
      const Vec3 p = random.vector(4);
      const Answer a = at(cage, p);
      CHECK(a.exists);
      CHECK(sum(a.weights) == doctest::Approx(1).epsilon(1e-13));
      const bool inside = std::abs(p[0]) < 1 && std::abs(p[1]) < 2 && std::abs(p[2]) < 3;
      if (surface.positions.size() == 8 && inside) CHECK(std::ranges::min(a.weights) > 0);  // a convex cage
      CHECK(norm(blended(cage, a) - p) < 1e-12 * cage.diagonal);
    }
  }
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
    for (double d = 1e-2; d > 1e-18; d /= 10)
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

TEST_CASE("in_the_plane_of_a_face_but_outside_of_it_weights_are_exact_and_continuous") {
  const Cage cage = make_cage(box());
  Random random(11);
  for (int n = 0; n < 50; ++n) {
    const Vec3 p{random(1.5, 4), random(-4, 4), 1};  // p is in the plane of the top
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

TEST_CASE("far_away_and_for_open_cages_weights_are_finite_and_sum_to_one") {
  const auto check = [](const Cage& cage, const Vec3& p) {
    const Answer a = at(cage, p);
    for (const double w : a.weights) CHECK(std::isfinite(w));
    CHECK(sum(a.weights) == doctest::Approx(1).epsilon(1e-6));
    return a.exists;
  };
  const Cage closed = make_cage(box({1, 2, 3}));
  for (double r = 10; r < 1e12; r *= 10) CHECK((check(closed, {0.5 * r, r, -0.3 * r}) || r >= 1e3));
  auto t = box().triangles;
  t.resize(7);
  const Cage open = make_cage(viete::mesh::from_triangles(box().positions, t));
  Random random(12);
  for (int n = 0; n < 300; ++n) check(open, random.vector(2));
}

TEST_CASE("a_vanishing_sum_uses_the_closest_cage_point_and_reports_it") {
  // The cage is a single triangle. At points in the triangle's plane but outside of it, all weights are 0.
  const Cage cage = make_cage(viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  const Answer a = at(cage, {0.25, -1, 0});
  CHECK_FALSE(a.exists);
  CHECK(a.weights[0] == doctest::Approx(0.75));
  CHECK(a.weights[1] == doctest::Approx(0.25));
  CHECK(a.weights[2] == doctest::Approx(0));
}

TEST_CASE("inconsistent_faces_give_the_weights_of_consistent_ones") {
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
    CHECK(b.binding->warnings[0].find("flipped or ignored for mean value coordinates") != std::string::npos);
    auto posed = sound.positions;
    posed[3] = posed[3] + Vec3{0.4, 0.2, 0.1};
    CHECK(largest_distance(b.deform({posed, {}}), reference.deform({posed, {}})) < 1e-12);
  }
}

TEST_CASE("a_cage_without_outside_is_rejected_only_for_mean_value_coordinates") {
  const auto strip = moebius_strip();
  const auto model = tube(6, 5, 0.3, 1);
  CHECK_THROWS_WITH_AS(Bound(model, strip, mean_values, 2, Blend::linear), doctest::Contains("oriented"),
                       viete::base::Error);
  CHECK_NOTHROW(Bound(model, strip, faces));
}
