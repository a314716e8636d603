#include "deform/laplacian.h"

#include <doctest/doctest.h>

#include <map>

#include "deform/shapes.h"

using namespace viete;
using namespace viete::test;

namespace {

using Dense = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;

Dense entries_of(const SparseMatrix& m) {
  Dense entries;
  for (std::uint32_t j = 0; j < m.size(); ++j) {
    for (auto i = m.starts[j]; i < m.starts[j + 1]; ++i)
      entries[{static_cast<std::uint32_t>(m.rows[i]), j}] = m.values[i];
  }
  return entries;
}

double largest_difference(const SparseMatrix& a, const SparseMatrix& b) {
  Dense difference = entries_of(a);
  for (const auto& [place, value] : entries_of(b)) difference[place] -= value;
  double largest = 0;
  for (const auto& [place, value] : difference) largest = std::max(largest, std::abs(value));
  return largest;
}

// The plane grid of n x n squares over [0, 1]^2, its vertices moved, cut along diagonals of either kind at
// random.
mesh::Surface cut_grid(std::uint32_t n, double moved, unsigned seed) {
  Random place(1), cut(seed);
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double dx = place(-moved, moved), dy = place(-moved, moved);
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      p.push_back({(i + (inner ? dx : 0)) / n, (j + (inner ? dy : 0)) / n, 0});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      if (cut(0, 1) < 0.5) {
        t.push_back({a, b, b + 1}), t.push_back({a, b + 1, a + 1});
      } else {
        t.push_back({a, b, a + 1}), t.push_back({b, b + 1, a + 1});
      }
    }
  }
  return mesh::from_triangles(p, t);
}

// Triangles of any corners: edges of one to many of them, needles, folds, repeated corners, doubles.
mesh::Surface soup(unsigned seed, std::uint32_t vertices, std::size_t triangles) {
  Random random(seed);
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (std::uint32_t i = 0; i < vertices; ++i)
    p.push_back(i % 5 ? random.vector(1) : Vec3{random(0, 1), 0, 0});
  p[1] = p[2];
  const auto any = [&] { return static_cast<std::uint32_t>(random(0, vertices)); };
  for (std::size_t i = 0; i < triangles; ++i) t.push_back({any(), any(), any()});
  t.push_back(t.front());
  return mesh::from_triangles(p, t);
}

void check_laplacian(const mesh::Surface& surface) {
  const auto [stiffness, masses] = intrinsic_laplacian(surface);
  const Dense entries = entries_of(stiffness);
  std::vector<double> sums(stiffness.size(), 0), sizes(stiffness.size(), 0);
  for (const auto& [place, value] : entries) {
    const auto [i, j] = place;
    if (i != j) CHECK(value < 0);
    CHECK(entries.at({j, i}) == value);
    sums[j] += value;
    sizes[j] += std::abs(value);
  }
  for (std::size_t j = 0; j < sums.size(); ++j) CHECK(std::abs(sums[j]) <= 1e-13 * sizes[j]);
  std::vector<bool> used(surface.positions.size(), false);
  for (const auto& t : surface.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (const auto v : t) used[v] = true;
  }
  double area = 0;
  for (std::size_t v = 0; v < masses.size(); ++v) {
    CHECK((masses[v] > 0) == used[v]);
    CHECK((sizes[v] > 0) == used[v]);
    area += masses[v];
  }
  CHECK(area == doctest::Approx(1).epsilon(1e-12));
}

}  // namespace

TEST_CASE("triangles_that_are_delaunay_keep_their_cotangents_and_areas") {
  const auto tall = tube(20, 16, 0.5, 3);
  for (const auto& surface : {tall, box(), together(tall, box({1, 1, 1}, {3, 0, 0}))}) {
    const auto [stiffness, masses] = intrinsic_laplacian(surface);
    CHECK(largest_difference(stiffness, stiffness_matrix(surface.positions, surface.triangles)) < 1e-12);
    std::vector<double> thirds(surface.positions.size());
    double area = 0;
    for (const mesh::Triangle& t : surface.triangles) {
      const mesh::Point& a = surface.positions[t[0]];
      const double third = norm(cross(surface.positions[t[1]] - a, surface.positions[t[2]] - a)) / 6;
      for (const auto v : t) thirds[v] += third, area += third;
    }
    for (std::size_t v = 0; v < masses.size(); ++v) CHECK(masses[v] == doctest::Approx(thirds[v] / area));
  }
}

TEST_CASE("how_a_plane_is_cut_into_triangles_does_not_matter") {
  const auto first = intrinsic_laplacian(cut_grid(12, 0.3, 1));
  for (unsigned seed = 2; seed < 8; ++seed) {
    const auto other = intrinsic_laplacian(cut_grid(12, 0.3, seed));
    CHECK(largest_difference(first.stiffness, other.stiffness) < 1e-9);
    for (std::size_t v = 0; v < first.masses.size(); ++v)
      CHECK(std::abs(first.masses[v] - other.masses[v]) < 1e-12);
  }
  const auto grid = cut_grid(12, 0.3, 1);
  CHECK(largest_difference(first.stiffness, stiffness_matrix(grid.positions, grid.triangles)) > 0.1);
}

TEST_CASE("linear_functions_of_a_plane_are_harmonic_on_it") {
  constexpr std::uint32_t n = 12;
  const auto grid = cut_grid(n, 0.3, 1);
  const auto stiffness = intrinsic_laplacian(grid).stiffness;
  for (std::uint32_t v = 0; v < stiffness.size(); ++v) {
    const std::uint32_t i = v / (n + 1), j = v % (n + 1);
    if (i < 2 || j < 2 || i > n - 2 || j > n - 2) continue;
    double sum = 0;
    for (auto k = stiffness.starts[v]; k < stiffness.starts[v + 1]; ++k) {
      const auto& p = grid.positions[static_cast<std::size_t>(stiffness.rows[k])];
      sum += stiffness.values[k] * (2 * p[0] - 3 * p[1]);
    }
    CHECK(std::abs(sum) < 1e-12);
  }
}

TEST_CASE("no_weight_is_negative_whatever_the_triangles_are") {
  for (const double moved : {0.0, 0.3, 0.49}) check_laplacian(cut_grid(15, moved, 3));
  auto stretched = cut_grid(15, 0.4, 5);
  for (auto& p : stretched.positions) p[0] *= 1000, p[2] = std::sin(20 * p[1]);
  check_laplacian(stretched);
  for (unsigned seed = 1; seed < 20; ++seed) {
    check_laplacian(soup(seed, 30, 12));
    check_laplacian(soup(seed, 40, 200));
  }
  check_laplacian(mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  check_laplacian(mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {9, 9, 9}}, {{0, 1, 2}}));  // a line
  check_laplacian(
      mesh::from_triangles(std::vector<mesh::Point>(4, {1, 2, 3}), {{0, 1, 2}, {2, 1, 3}}));  // a point
}

TEST_CASE("lengths_have_no_scale") {
  const auto surface = soup(4, 40, 100);
  const auto here = intrinsic_laplacian(surface);
  for (const double scale : {1e-90, 1e90}) {
    auto other = surface;
    for (auto& p : other.positions) p = scale * p;
    CHECK(largest_difference(intrinsic_laplacian(other).stiffness, here.stiffness) <
          1e-6 * (1 + largest_difference(here.stiffness, sparse_matrix(here.masses.size(), {}))));
  }
}

TEST_CASE("without_triangles_there_are_no_weights") {
  mesh::Surface points;
  points.positions = {{0, 0, 0}, {1, 2, 3}};
  const auto [stiffness, masses] = intrinsic_laplacian(points);
  CHECK(stiffness.size() == 2);
  CHECK(stiffness.values.empty());
  CHECK(masses == std::vector<double>{0, 0});
}
