#include "deform/part_coupling.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/bound.h"
#include "deform/shapes.h"
#include "mesh/edge_paths.h"
#include "mesh/repair.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr Weighting plates{.weights = Weights::biharmonic};

// Separate triangles, corners displaced by up to `moved`.
mesh::Surface soup_of(const mesh::Surface& surface, double moved) {
  Random random(7);
  return mapped(loose_triangles(surface), [&](const Vec3& x) { return x + random.vector(moved); });
}

Binding bound(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, int threads = 2) {
  base::WorkerPool pool(threads);
  return bind(model, cage, weighting, pool);
}

// The largest difference between the weights of a vertex of each binding.
double apart(const Binding& a, std::size_t v, const Binding& b, std::size_t w) {
  double most = 0;
  for (std::size_t h = 0; h < a.handles; ++h)
    most = std::max(most, std::abs(a.weights[v * a.handles + h] - b.weights[w * b.handles + h]));
  return most;
}

std::size_t nearest(const mesh::Surface& surface, const mesh::Point& p) {
  const auto at = std::ranges::min_element(surface.positions, {}, [&](const Vec3& x) { return norm(x - p); });
  return static_cast<std::size_t>(at - surface.positions.begin());
}

double most_apart_from_nearest(const Binding& b, const mesh::Surface& inner, const mesh::Surface& outer) {
  double most = 0;
  for (std::size_t i = 0; i < inner.positions.size(); ++i) {
    const std::size_t j = nearest(outer, inner.positions[i]);
    most = std::max(most, apart(b, i, b, inner.positions.size() + j));
  }
  return most;
}

std::vector<Coupling> couplings_of(const mesh::Surface& surface, int threads = 2) {
  base::WorkerPool pool(threads);
  const mesh::Surface joined = mesh::welded(surface);
  return part_couplings(joined, mesh::EdgePaths(joined), intrinsic_laplacian(joined).masses, pool);
}

}  // namespace

TEST_CASE("a_model_of_one_part_that_nowhere_touches_itself_has_no_couplings") {
  CHECK(couplings_of(tube(20, 16, 0.5, 3)).empty());
}

TEST_CASE("a_tube_in_a_tube_takes_weights_like_those_of_the_tube_around_it") {
  const auto outer = tube(30, 24, 0.5, 3);
  const Cage cage = make_cage(tube(5, 6, 0.7, 3.4));
  for (const double radius : {0.49, 0.4, 0.3}) {
    CAPTURE(radius);
    const auto inner = tube(26, 20, radius, 2.9);
    const auto model = together(inner, outer);
    CHECK(most_apart_from_nearest(bound(model, cage, plates), inner, outer) < 0.005 + 0.25 * (0.5 - radius));
  }
}

TEST_CASE("a_rod_in_a_sleeve_stays_there_about_as_well_as_with_mean_value_coordinates") {
  const auto outer = tube(30, 24, 0.5, 3);
  const auto bent = [](const Vec3& p) {
    const double radius = 2, angle = p[2] / radius;
    return Vec3{radius - (radius - p[0]) * std::cos(angle), p[1], (radius - p[0]) * std::sin(angle)};
  };
  const Twist twist{2, {0, 0, 0}, -1.7, 1.7, -100 * degree, 100 * degree};
  for (const double gap : {0.005, 0.01}) {
    const auto inner = tube(26, 20, 0.5 - 3 * gap, 2.9);
    const auto model = together(inner, outer), cage = tube(6, 8, 0.8, 3.6);
    Bound smooth(model, cage, biharmonics), mean_value(model, cage, mean_values, 2, Blend::linear);
    CAPTURE(gap);
    const auto apart = [&](Bound& b, const auto& map) {
      const auto posed = b.deform(b.pose(map));
      double most = 0;
      for (std::size_t i = 0; i < inner.positions.size(); ++i) {
        const auto distance = [&](const std::vector<mesh::Point>& at, std::size_t j) {
          return norm(at[i] - at[inner.positions.size() + j]);
        };
        const std::size_t j = nearest(outer, inner.positions[i]);
        most = std::max(most, std::abs(distance(posed, j) - distance(model.positions, j)));
      }
      return most;
    };
    CHECK(apart(smooth, twist) < 1.5 * apart(mean_value, twist));
    CHECK(apart(smooth, bent) < 1.5 * apart(mean_value, bent));
  }
}

TEST_CASE("a_coarse_part_is_coupled_to_the_nearest_points_and_not_to_the_nearest_vertices") {
  // A large triangle, and a small one above its middle.
  const auto model = mesh::from_triangles(
      {{-2, -1, 0}, {2, -1, 0}, {0, 2, 0}, {-0.1, -0.1, 0.01}, {0.1, -0.1, 0.01}, {0, 0.1, 0.01}},
      {{0, 1, 2}, {3, 4, 5}});
  const auto couplings = couplings_of(model);
  REQUIRE(couplings.size() == 3);
  for (const auto& [vertex, t, shares, strength] : couplings) {
    const auto& p = model.positions;
    const Vec3 point = shares[0] * p[t[0]] + shares[1] * p[t[1]] + shares[2] * p[t[2]];
    CHECK(vertex >= 3);
    CHECK(norm(p[vertex] - point) == doctest::Approx(0.01));
  }
}

TEST_CASE("a_triangle_soup_has_the_weights_of_its_surface") {
  Random random(3);  // makes nearest vertices unique
  const auto whole = mapped(tube(24, 18, 0.5, 3), [&](const Vec3& x) { return x + random.vector(0.01); });
  const Cage cage = make_cage(tube(5, 6, 0.7, 3.4));
  for (const Weighting& weighting : {harmonics, biharmonics}) {
    const Binding expected = bound(whole, cage, weighting);
    for (const double moved : {0.0, 1e-7, 1e-5, 1e-3}) {
      CAPTURE(moved);
      if (moved > 0 && weighting == harmonics) continue;
      const Binding soup = bound(soup_of(whole, moved), cage, weighting);
      double most = 0;
      for (std::size_t i = 0; i < soup.vertices; ++i)
        most = std::max(most, apart(soup, i, expected, whole.triangles[i / 3][i % 3]));
      CHECK(most < (moved > 0 ? 0.15 : 1e-9));
    }
  }
}

TEST_CASE("folds_that_touch_are_coupled_and_neighbours_along_the_surface_are_not") {
  // A strip that folds back 0.0005 above itself.
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (std::uint32_t i = 0; i <= 20; ++i) {
    const double x = 0.1 * std::min(i, 20 - i), z = i > 10 ? 0.0005 : 0;
    p.push_back({x, 0, z}), p.push_back({x, 1, z});
    if (i == 0) continue;
    const std::uint32_t a = 2 * i - 2;
    t.push_back({a, a + 1, a + 2}), t.push_back({a + 2, a + 1, a + 3});
  }
  const auto couplings = couplings_of(mesh::from_triangles(p, t));
  CHECK(couplings.size() == 2 * 2 * 10);
  for (const auto& [a, triangle, shares, strength] : couplings) {
    const auto b = triangle[0];
    CHECK(a / 2 + b / 2 == 20);
    CHECK(a % 2 == b % 2);
    CHECK(shares[0] == 1);
    CHECK(strength > 0);
  }
}

TEST_CASE("couplings_and_weights_of_many_parts_do_not_depend_on_the_number_of_threads") {
  const auto model = soup_of(tube(16, 12, 0.5, 3), 1e-3);
  const Cage cage = make_cage(tube(4, 6, 0.7, 3.4));
  const auto one = couplings_of(model, 1), four = couplings_of(model, 4);
  REQUIRE(one.size() == four.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    CHECK((one[i].vertex == four[i].vertex && one[i].triangle == four[i].triangle &&
           one[i].shares == four[i].shares && one[i].strength == four[i].strength));
  CHECK(bound(model, cage, plates, 1).weights == bound(model, cage, plates, 4).weights);
}

TEST_CASE("harmonic_weights_of_several_parts_stay_between_0_and_1") {
  const auto model = together(tube(20, 16, 0.5, 3), tube(18, 14, 0.45, 2.9));
  const Binding b = bound(model, make_cage(tube(4, 6, 0.7, 3.4)), {.weights = Weights::harmonic});
  for (const double w : b.weights) CHECK((w > -1e-9 && w < 1 + 1e-9));
}
