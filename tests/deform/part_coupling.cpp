#include "deform/part_coupling.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/bound.h"
#include "deform/shapes.h"
#include "mesh/edge_paths.h"
#include "mesh/repair.h"
#include "mesh/triangle.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr Weighting plates{.weights = Weights::biharmonic};

// Separate triangles, corners displaced by up to `moved`.
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

// The largest difference between the weights of a vertex of each binding.
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

// Rows of triangles around an axis: place(u, v) for u from `from` to `to` and v over a full turn.
template <class Place>
mesh::Surface rows_around(std::uint32_t rows, std::uint32_t sides, double from, double to,
                          const Place& place) {
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (std::uint32_t r = 0; r <= rows; ++r) {
    for (std::uint32_t s = 0; s < sides; ++s)
      p.push_back(place(std::lerp(from, to, double(r) / rows), 2 * std::numbers::pi * s / sides));
  }
  for (std::uint32_t i = 0; i < rows * sides; ++i) {
    const std::uint32_t next = i % sides + 1 < sides ? i + 1 : i + 1 - sides;
    t.push_back({i, i + sides, next}), t.push_back({next, i + sides, next + sides});
  }
  return mesh::from_triangles(p, t);
}

Vec3 on_sphere(double u, double v) {
  return {std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)};
}

struct Eye {
  Vec3 center, outward;
  double radius;
};

// Three parts, open at gaps of 0.4 % of the diagonal, and two eyes in sockets wider by `gap`.
mesh::Surface head(double gap, double eye_radius, std::uint32_t detail, std::uint32_t eye_sides) {
  const Vec3 half{0.85, 0.75, 1};
  const double diagonal = 2 * norm(half), seam = 0.002 * diagonal;
  const auto skin = [&](double u, double v) {
    const Vec3 d = on_sphere(u, v);
    return Vec3{half[0] * d[0], half[1] * d[1], half[2] * d[2]};
  };
  std::vector<Eye> eyes;
  for (const double side : {-0.45, 0.45}) {
    const Vec3 p = skin(1.4, side), n{p[0] / (half[0] * half[0]), p[1] / (half[1] * half[1]), p[2]};
    const Vec3 outward = (1 / norm(n)) * n;
    eyes.push_back({p - 0.2 * eye_radius * outward, outward, eye_radius});
  }
  const auto with_sockets = [&](double u, double v) {
    Vec3 p = skin(u, v);
    for (const Eye& eye : eyes) {
      const double r = eye.radius + gap * diagonal;
      const Vec3 from = p - eye.center;
      if (norm(from) > r) continue;
      const Vec3 across = from - dot(from, eye.outward) * eye.outward;
      p = eye.center + across - std::sqrt(r * r - squared_norm(across)) * eye.outward;
    }
    return p;
  };
  mesh::Surface model = together(rows_around(4 * detail, 16 * detail, 0, 0.8 - seam, with_sockets),
                                 rows_around(7 * detail, 22 * detail, 0.8 + seam, 2 - seam, with_sockets));
  model = together(model, rows_around(5 * detail, 18 * detail, 2 + seam, 2.7, with_sockets));
  for (const Eye& eye : eyes) {
    model =
        together(model, rows_around(eye_sides / 2, eye_sides, 0, std::numbers::pi, [&](double u, double v) {
                   return eye.center + eye.radius * on_sphere(u, v + 0.1);
                 }));
  }
  return model;
}

// A vertex and a near triangle of another part.
struct Beside {
  std::uint32_t vertex;
  mesh::Triangle triangle;
  Vec3 shares;

  double distance(const std::vector<mesh::Point>& p) const {
    return norm(p[vertex] -
                (shares[0] * p[triangle[0]] + shares[1] * p[triangle[1]] + shares[2] * p[triangle[2]]));
  }
};

// Each vertex with the nearest point of all other parts, if within 1 % of the diagonal.
std::vector<Beside> vertices_beside_parts(const mesh::Surface& model) {
  const mesh::Surface joined = mesh::welded(model);
  const mesh::EdgePaths paths(joined);
  const auto& p = joined.positions;
  std::vector<Beside> found;
  for (std::uint32_t v = 0; v < p.size(); ++v) {
    double least = 0.01 * mesh::bounds(p).diagonal();
    std::optional<Beside> nearest;
    for (const auto& t : mesh::proper_triangles(joined)) {
      if (paths.part(t[0]) == paths.part(v)) continue;
      const auto closest = mesh::closest_on_triangle(p[v], p[t[0]], p[t[1]], p[t[2]]);
      const double distance = std::sqrt(closest.squared_distance);
      if (distance < least) least = distance, nearest = Beside{v, t, closest.barycentric};
    }
    if (nearest) found.push_back(*nearest);
  }
  return found;
}

double most_moved_apart(const std::vector<Beside>& beside, const std::vector<mesh::Point>& rest,
                        const std::vector<mesh::Point>& posed) {
  double most = 0;
  for (const Beside& b : beside) most = std::max(most, std::abs(b.distance(posed) - b.distance(rest)));
  return most;
}

// Bends the z axis into an arc of 90 degrees towards x.
Vec3 bent_head(const Vec3& p) {
  const double radius = 2.6 / (std::numbers::pi / 2), angle = p[2] / radius;
  return {radius - (radius - p[0]) * std::cos(angle), p[1], (radius - p[0]) * std::sin(angle)};
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

TEST_CASE("eyes_stay_in_their_sockets_about_as_well_as_with_mean_value_coordinates") {
  for (const double gap : {0.005, 0.01}) {
    for (const double radius : {0.12, 0.25}) {
      for (const auto& [detail, sides] : {std::pair{1u, 8u}, {1u, 12u}, {2u, 10u}}) {
        const auto model = head(gap, radius, detail, sides);
        const auto cage = tube(6, 8, 1.05, 2.4);
        Bound smooth(model, cage, biharmonics), mean_value(model, cage, mean_values, 2, Blend::linear);
        const auto beside = vertices_beside_parts(model);
        CHECK(beside.size() > 20);
        const auto apart = [&](Bound& b, const auto& map) {
          return most_moved_apart(beside, model.positions, b.deform(b.pose(map)));
        };
        CAPTURE(gap);
        CAPTURE(radius);
        CAPTURE(detail);
        CAPTURE(sides);
        const Twist twist{2, {0, 0, 0}, -1.2, 1.2, -100 * degree, 100 * degree};
        CHECK(apart(smooth, twist) < 1.5 * apart(mean_value, twist));
        CHECK(apart(smooth, bent_head) < 1.5 * apart(mean_value, bent_head));
      }
    }
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
