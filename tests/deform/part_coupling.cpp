#include "deform/part_coupling.h"

#include <doctest/doctest.h>

#include <random>

#include "deform/binding.h"
#include "deform/shapes.h"
#include "mesh/repair.h"
#include "deform/bind.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr Weighting plates{.weights = Weights::biharmonic};
constexpr Weighting plates_apart{.weights = Weights::biharmonic, .as_before = true};

// Every triangle by itself, its corners moved by up to this.
mesh::Surface soup_of(const mesh::Surface& surface, double moved) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> offset(-moved, moved);
  std::vector<mesh::Point> positions;
  std::vector<mesh::Triangle> triangles;
  for (const auto& t : surface.triangles) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const auto v : t) {
      const Vec3 by{offset(random), offset(random), offset(random)};
      positions.push_back(surface.positions[v] + by);
    }
    triangles.push_back({first, first + 1, first + 2});
  }
  return mesh::from_triangles(positions, triangles);
}

Binding bound(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, int threads = 2) {
  base::WorkerPool pool(threads);
  return bind(model, cage, weighting, pool);
}

// The largest difference of weights of a vertex of either.
double apart(const Binding& a, std::size_t v, const Binding& b, std::size_t w) {
  double most = 0;
  for (std::size_t h = 0; h < a.handles; ++h)
    most = std::max(most, std::abs(a.weights[v * a.handles + h] - b.weights[w * b.handles + h]));
  return most;
}

double most_apart_from_nearest(const Binding& b, const mesh::Surface& inner, const mesh::Surface& outer) {
  double most = 0;
  for (std::size_t i = 0; i < inner.positions.size(); ++i) {
    std::size_t nearest = 0;
    for (std::size_t j = 1; j < outer.positions.size(); ++j)
      if (norm(inner.positions[i] - outer.positions[j]) < norm(inner.positions[i] - outer.positions[nearest]))
        nearest = j;
    most = std::max(most, apart(b, i, b, inner.positions.size() + nearest));
  }
  return most;
}

std::vector<Coupling> couplings_of(const mesh::Surface& surface, int threads = 2) {
  base::WorkerPool pool(threads);
  const mesh::Surface joined = mesh::welded(surface);
  return part_couplings(joined, mesh::EdgePaths(joined), intrinsic_laplacian(joined).masses, pool);
}

}  // namespace

TEST_CASE("a_model_of_one_part_that_nowhere_touches_itself_has_the_weights_of_its_surface_alone") {
  const auto model = tube(20, 16, 0.5, 3);
  const Cage cage = make_cage(tube(4, 6, 0.8, 3.4));
  CHECK(couplings_of(model).empty());
  CHECK(bound(model, cage, plates).weights == bound(model, cage, plates_apart).weights);
}

TEST_CASE("a_tube_in_a_tube_takes_weights_like_those_of_the_tube_around_it") {
  const auto outer = tube(30, 24, 0.5, 3);
  const Cage cage = make_cage(tube(5, 6, 0.7, 3.4));
  for (const double radius : {0.49, 0.4, 0.3}) {
    CAPTURE(radius);
    const auto inner = tube(26, 20, radius, 2.9);
    const auto model = together(inner, outer);
    const double apart = most_apart_from_nearest(bound(model, cage, plates_apart), inner, outer),
                 together = most_apart_from_nearest(bound(model, cage, plates), inner, outer);
    CAPTURE(together);
    CAPTURE(apart);
    CHECK(together < 0.7 * apart);
  }
}

TEST_CASE("a_soup_of_triangles_has_the_weights_of_the_surface_that_it_was") {
  const auto whole = tube(24, 18, 0.5, 3);
  const Cage cage = make_cage(tube(5, 6, 0.7, 3.4));
  const Binding expected = bound(whole, cage, plates);
  for (const double moved : {1e-7, 1e-5, 1e-3}) {
    CAPTURE(moved);
    const Binding soup = bound(soup_of(whole, moved), cage, plates);
    double most = 0;
    for (std::size_t i = 0; i < soup.vertices; ++i)
      most = std::max(most, apart(soup, i, expected, whole.triangles[i / 3][i % 3]));
    CHECK(most < 0.15);
  }
}

TEST_CASE("folds_that_touch_are_coupled_and_neighbours_along_the_surface_are_not") {
  // A strip that goes out and comes back 0.0005 above itself.
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
  for (const auto& [a, b, strength] : couplings) {
    CHECK(a / 2 + b / 2 == 20);
    CHECK(a % 2 == b % 2);
    CHECK(strength > 0);
  }
}

TEST_CASE("couplings_and_weights_of_many_parts_do_not_depend_on_the_number_of_threads") {
  const auto model = soup_of(tube(16, 12, 0.5, 3), 1e-3);
  const Cage cage = make_cage(tube(4, 6, 0.7, 3.4));
  const auto one = couplings_of(model, 1), four = couplings_of(model, 4);
  REQUIRE(one.size() == four.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    CHECK((one[i].a == four[i].a && one[i].b == four[i].b && one[i].strength == four[i].strength));
  CHECK(bound(model, cage, plates, 1).weights == bound(model, cage, plates, 4).weights);
}

TEST_CASE("harmonic_weights_of_several_parts_stay_between_0_and_1") {
  const auto model = together(tube(20, 16, 0.5, 3), tube(18, 14, 0.45, 2.9));
  const Binding b = bound(model, make_cage(tube(4, 6, 0.7, 3.4)), {.weights = Weights::harmonic});
  for (const double w : b.weights) CHECK((w > -1e-9 && w < 1 + 1e-9));
}
