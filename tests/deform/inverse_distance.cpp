#include "deform/inverse_distance.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "deform/shapes.h"
#include "deform/weight_checks.h"
#include "mesh/triangle.h"

using namespace viete::test;

namespace {

std::vector<double> weights_at(const Cage& cage, const Vec3& p, double reach = whole_cage) {
  std::vector<double> w(cage.element_count());
  inverse_distance_weights(cage, p, w, reach);
  return w;
}

constexpr double reaches[] = {lowest_reach, 2, 3, 5, 100};

using Long3 = std::array<long double, 3>;

long double long_dot(const Long3& a, const Long3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// To the plane where the foot lies inside, else to the nearest edge.
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

// As the header defines them.
std::vector<long double> defined_weights(const Cage& cage, const Vec3& p, double reach) {
  std::vector<long double> d2, w;
  long double sixth = 0, eighth = 0, sum = 0;
  for (std::size_t e = 0; e < cage.element_count(); ++e) {
    d2.push_back(squared_distance(cage, e, p));
    sixth += 1 / (d2[e] * d2[e] * d2[e]);
    eighth += 1 / (d2[e] * d2[e] * d2[e] * d2[e]);
  }
  const long double radius2 = reach * (long double)reach * sixth / eighth;
  for (const long double d : d2) {
    const long double left = std::max(0.0L, 1 - d / radius2);
    w.push_back(left * left / d);
    sum += w.back();
  }
  for (auto& x : w) x /= sum;
  return w;
}

// Largest change of a weight over each of n steps from a to b: of the weights, or of their slope.
struct Steps {
  double first = 0, second = 0;
};

Steps steps(const Cage& cage, const Vec3& a, const Vec3& b, int n, double reach) {
  Steps largest;
  std::vector<std::vector<double>> w;
  for (int i = 0; i <= n; ++i) w.push_back(weights_at(cage, a + (double(i) / n) * (b - a), reach));
  for (int i = 1; i < n; ++i) {
    for (std::size_t e = 0; e < cage.element_count(); ++e) {
      largest.first = std::max(largest.first, std::abs(w[i][e] - w[i - 1][e]));
      largest.second = std::max(largest.second, n * std::abs(w[i + 1][e] - 2 * w[i][e] + w[i - 1][e]));
    }
  }
  return largest;
}

double sum(const std::vector<double>& w) {
  return std::accumulate(w.begin(), w.end(), 0.0);
}

}  // namespace

TEST_CASE("weights_are_inverse_squared_distances_normalised") {
  const Cage cage = make_cage(box({1, 2, 3}));
  const Vec3 p{0.3, -0.7, 1.1};
  const auto w = weights_at(cage, p);
  CHECK(sum(w) == doctest::Approx(1).epsilon(1e-15));
  const auto inverse = [&](std::size_t e) {
    const auto& t = cage.surface.triangles[e];
    const auto& x = cage.surface.positions;
    return 1 / viete::mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance;
  };
  double total = 0;
  for (std::size_t e = 0; e < w.size(); ++e) total += inverse(e);
  for (std::size_t e = 0; e < w.size(); ++e)
    CHECK(w[e] == doctest::Approx(inverse(e) / total).epsilon(1e-14));
}

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

TEST_CASE("on_a_face_its_element_has_all_the_weight") {
  const Cage cage = make_cage(box());
  for (std::size_t e = 0; e < cage.element_count(); ++e)
    CHECK(weights_at(cage, cage.centers[e])[e] == doctest::Approx(1));
}

TEST_CASE("near_an_element_weights_approach_the_limit_without_a_jump") {
  const Cage cage = make_cage(box());
  const Vec3 c = cage.centers[0];
  for (double d = 1e-1; d > 1e-20; d /= 10) {
    const auto w = weights_at(cage, c + Vec3{0, 0, d});
    CHECK(w[0] > 1 - 100 * d * d - 1e-14);
    CHECK(sum(w) == doctest::Approx(1));
  }
}

TEST_CASE("weights_are_the_same_at_every_length_scale_and_finite_everywhere") {
  check_every_length_scale([](const Cage& cage, const Vec3& p) { return weights_at(cage, p); });
}

TEST_CASE("elements_without_area_have_no_weight") {
  auto surface = box();
  surface = viete::mesh::from_triangles(surface.positions, [&] {
    auto t = surface.triangles;
    t.push_back({0, 1, 1});
    return t;
  }());
  const Cage cage = make_cage(surface);
  CHECK(weights_at(cage, {0.1, 0.2, 0.3}).back() == 0);
  CHECK(weights_at(cage, surface.positions[0]).back() == 0);
  CHECK(sum(weights_at(cage, surface.positions[1])) == doctest::Approx(1));
}

TEST_CASE("weights_with_a_reach_are_their_definition_in_long_double") {
  Random random(3);
  for (const auto& surface : {box({1, 2, 3}), tube(7, 12, 0.6, 2)}) {
    const Cage cage = make_cage(surface);
    for (const double reach : reaches) {
      CAPTURE(reach);
      double worst = 0;
      for (int n = 0; n < 500; ++n) {
        const Vec3 p = random.vector(2.5);
        const auto w = weights_at(cage, p, reach);
        const auto expected = defined_weights(cage, p, reach);
        for (std::size_t e = 0; e < w.size(); ++e)
          worst = std::max(worst, static_cast<double>(std::abs(w[e] - expected[e])));
      }
      CHECK(worst < 2e-13);
    }
  }
}

TEST_CASE("a_reach_without_end_gives_the_same_bits_as_none") {
  const Cage cage = make_cage(tube(7, 12, 0.6, 2));
  Random random(4);
  for (int n = 0; n < 100; ++n) {
    const Vec3 p = random.vector(2);
    std::vector<double> plain;
    for (const auto& t : cage.surface.triangles) {
      const auto& x = cage.surface.positions;
      plain.push_back(viete::mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance);
    }
    const double nearest = *std::min_element(plain.begin(), plain.end());
    double total = 0;
    for (double& w : plain) total += w = nearest / w;
    for (double& w : plain) w /= total;
    CHECK(weights_at(cage, p, whole_cage) == plain);
  }
}

TEST_CASE("weights_with_a_reach_sum_to_one_and_vanish_beyond_it") {
  const Cage cage = make_cage(tube(7, 12, 0.6, 2));
  Random random(6);
  for (const double reach : reaches) {
    std::size_t none = 0;
    for (int n = 0; n < 200; ++n) {
      const Vec3 p = random.vector(2);
      const auto w = weights_at(cage, p, reach);
      CHECK(sum(w) == doctest::Approx(1).epsilon(1e-14));
      long double least = 1e300L;
      for (std::size_t e = 0; e < w.size(); ++e) least = std::min(least, squared_distance(cage, e, p));
      for (std::size_t e = 0; e < w.size(); ++e) {
        const long double d2 = squared_distance(cage, e, p);
        CHECK(w[e] >= 0);
        if (d2 <= least) CHECK(w[e] > 0);
        if (d2 < 0.999L * reach * reach * least) CHECK(w[e] > 0);
        none += w[e] == 0;
      }
    }
    const bool some = none > 0;
    CHECK(some == (reach < 100));
  }
}

TEST_CASE("weights_with_a_reach_have_neither_jumps_nor_creases") {
  const Cage cage = make_cage(tube(7, 12, 0.6, 2));
  for (const double reach : {lowest_reach, 2.0, 3.0}) {
    CAPTURE(reach);
    // Through the cage, and inside where every element is some way off.
    for (const auto& [a, b] : {std::pair{Vec3{-1, 0.3, 0.2}, Vec3{1, -0.2, 0.1}},
                               {Vec3{-0.2, -0.9, 0.1}, Vec3{0.15, 0.8, -0.2}}}) {
      const Steps coarse = steps(cage, a, b, 4000, reach), fine = steps(cage, a, b, 16000, reach);
      CHECK(fine.first < 0.3 * coarse.first);
      if (std::abs(a[0]) < 0.5) CHECK(fine.second < 0.3 * coarse.second);
    }
  }
}

TEST_CASE("a_growing_reach_ends_in_weights_without_one") {
  const Cage cage = make_cage(box({1, 2, 3}));
  const Vec3 p{0.3, -0.7, 1.1};
  const auto limit = weights_at(cage, p);
  for (const double reach : {10.0, 1e3, 1e6}) {
    const auto w = weights_at(cage, p, reach);
    for (std::size_t e = 0; e < w.size(); ++e) CHECK(std::abs(w[e] - limit[e]) < 3 / (reach * reach));
  }
}

TEST_CASE("on_the_cage_a_reach_leaves_only_what_is_touched_at_every_length_scale") {
  const auto unit = box({1, 2, 3});
  for (const double s : {1e-30, 1.0, 1e30}) {
    auto scaled = unit;
    for (auto& p : scaled.positions) p = s * p;
    const Cage cage = make_cage(scaled);
    for (const double reach : reaches) {
      for (std::size_t v = 0; v < 8; ++v) {
        const auto w = weights_at(cage, scaled.positions[v], reach);
        const auto corner = [&](std::size_t e) {
          const auto& t = scaled.triangles[e];
          return t[0] == v || t[1] == v || t[2] == v;
        };
        double touching = 0;
        for (std::size_t e = 0; e < w.size(); ++e) touching += corner(e);
        for (std::size_t e = 0; e < w.size(); ++e)
          CHECK(w[e] == (corner(e) ? doctest::Approx(1 / touching) : doctest::Approx(0)));
      }
      Random random(9);
      const Vec3 p = random.vector(1);
      const auto here = weights_at(cage, s * p, reach), there = weights_at(make_cage(unit), p, reach);
      for (std::size_t e = 0; e < here.size(); ++e)
        CHECK(here[e] == doctest::Approx(there[e]).epsilon(1e-10));
    }
  }
}
