#include <doctest/doctest.h>
#include <Eigen/SparseCore>

#include "support/caged_shapes.h"
#include "weights/laplacian.h"

using namespace viete;
using namespace viete::test;

namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse as_sparse(const SparseMatrix& k) {
  const auto n = Eigen::Index(k.size());
  return Eigen::Map<const Sparse>(n, n, Eigen::Index(k.values.size()), k.starts.data(), k.rows.data(),
                                  k.values.data());
}

Sparse stiffness(const mesh::Surface& s) {
  return as_sparse(stiffness_matrix(s.positions, s.triangles));
}

template <class Function>
Eigen::VectorXd sampled(const mesh::Surface& s, const Function& f) {
  Eigen::VectorXd values(Eigen::Index(s.positions.size()));
  for (std::size_t v = 0; v < s.positions.size(); ++v) values[Eigen::Index(v)] = f(s.positions[v]);
  return values;
}

double largest(const Sparse& m) {
  return m.nonZeros() ? m.coeffs().cwiseAbs().maxCoeff() : 0;
}

double largest_difference(const SparseMatrix& a, const SparseMatrix& b) {
  return largest(as_sparse(a) - as_sparse(b));
}

// Returns a grid of n x n squares over [0, 1]^2. Moves the vertices, and cuts squares along random diagonals.
mesh::Surface cut_grid(std::uint32_t n, double moved, unsigned seed) {
  Random place(1), cut(seed);
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double dx = place(-moved, moved), dy = place(-moved, moved);
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      p.push_back({(i + (inner ? dx : 0)) / n, (j + (inner ? dy : 0)) / n, 0});
    }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      if (cut(0, 1) < 0.5) {
        t.push_back({a, b, b + 1});
        t.push_back({a, b + 1, a + 1});
      } else {
        t.push_back({a, b, a + 1});
        t.push_back({b, b + 1, a + 1});
      }
    }
  }
  return mesh::from_triangles(p, t);
}

// Returns random triangles. Some share edges; some are needles, folds or duplicates, or repeat corners.
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
  const Sparse k = as_sparse(stiffness);
  CHECK(largest(Sparse(k - Sparse(k.transpose()))) == 0);
  std::vector<bool> used(surface.positions.size(), false);
  for (const auto& t : surface.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (const auto v : t) used[v] = true;
  }
  double area = 0;
  for (std::size_t v = 0; v < masses.size(); ++v) {
    double sum = 0, size = 0;
    for (Sparse::InnerIterator at(k, Eigen::Index(v)); at; ++at) {
      if (at.row() != at.col()) CHECK(at.value() < 0);
      sum += at.value();
      size += std::abs(at.value());
    }
    CHECK(std::abs(sum) <= 1e-13 * size);
    CHECK((masses[v] > 0) == used[v]);
    CHECK((size > 0) == used[v]);
    area += masses[v];
  }
  CHECK(area == doctest::Approx(1).epsilon(1e-12));
}

}  // namespace

TEST_CASE("half_cotangents_are_those_of_the_angles_at_every_scale_and_place") {
  const double root3 = std::sqrt(3.0);
  for (const double scale : {1e-300, 1e-70, 1.0, 1e70, 1e299}) {
    const auto at = [&](double x, double y) { return mesh::Point{scale * x, 0, scale * y}; };
    const Vec3 right = half_cotangents(at(0, 0), at(1, 0), at(0, root3));
    CHECK(std::abs(right[0]) < 1e-15);
    CHECK(right[1] == doctest::Approx(0.5 / root3).epsilon(1e-15));
    CHECK(right[2] == doctest::Approx(0.5 * root3).epsilon(1e-15));
    const Vec3 obtuse = half_cotangents(at(0, 0), at(1, 0), at(-0.5, root3 / 2));
    CHECK(obtuse[0] == doctest::Approx(-0.5 / root3).epsilon(1e-15));
    CHECK(obtuse[1] == doctest::Approx(0.5 * root3).epsilon(1e-15));
    CHECK(obtuse[2] == doctest::Approx(0.5 * root3).epsilon(1e-15));
  }
}

TEST_CASE("the_stiffness_matrix_gives_the_dirichlet_energy_of_linear_functions") {
  const mesh::Surface grid = cut_grid(9, 0.3, 1);
  const Sparse k = stiffness(grid);
  const Eigen::VectorXd f = sampled(grid, [](const auto& p) { return 3 * p[0] - 2 * p[1] + 7; });
  CHECK(f.dot(k * f) == doctest::Approx(13).epsilon(1e-13));  // |grad|^2 = 9 + 4, area 1
  const mesh::Surface cuboid = box({1, 2, 3});
  const Eigen::VectorXd z = sampled(cuboid, [](const auto& p) { return p[2]; });
  CHECK(z.dot(stiffness(cuboid) * z) == doctest::Approx(2 * 24 + 2 * 12).epsilon(1e-14));  // the sides' area
}

TEST_CASE("stiffness_is_symmetric_sums_to_zero_and_has_every_diagonal_entry") {
  mesh::Surface s = tube(20, 9, 0.7, 5);
  s.positions.push_back({9, 9, 9});  // has no triangle
  s.triangles.push_back({0, 0, 5});
  s.triangles.push_back({3, 3, 3});
  const Sparse k = stiffness(s);
  REQUIRE(k.rows() == Eigen::Index(s.positions.size()));
  CHECK(largest(Sparse(k - Sparse(k.transpose()))) == 0);
  CHECK((k * Eigen::VectorXd::Ones(k.cols())).cwiseAbs().maxCoeff() < 1e-14 * largest(k));
  for (Eigen::Index v = 0; v < k.rows(); ++v) {
    bool stored = false;
    for (Sparse::InnerIterator at(k, v); at; ++at) stored |= at.row() == v;
    CHECK(stored);
  }
  CHECK(k.coeff(k.rows() - 1, k.rows() - 1) == 0);
  CHECK(k.coeff(0, 5) == stiffness(tube(20, 9, 0.7, 5)).coeff(0, 5));
}

TEST_CASE("thin_triangles_add_a_bounded_energy_that_is_never_negative") {
  Random random(3);
  for (const double height : {1e-2, 1.1e-6, 0.9e-6, 1e-9, 1e-200, 0.0})
    for (const double foot : {0.0, 0.1, 0.5, 1.0}) {
      const std::vector<mesh::Point> p = {{0, 0, 0}, {2, 0, 0}, {2 * foot, 0, 2 * height}};
      CHECK(is_thin(p[0], p[1], p[2]) == (height <= thin_triangle));
      const Sparse k = stiffness(mesh::from_triangles(p, {{0, 1, 2}}));
      CHECK(largest(k) <= 1 / thin_triangle);
      CHECK(largest(k) > 0.1);
      for (int i = 0; i < 20; ++i) {
        const Vec3 v = random.vector(1);
        const Eigen::Vector3d f(v[0], v[1], v[2]);
        CHECK(f.dot(k * f) >= -1e-15 * largest(k));
      }
    }
}

TEST_CASE("a_triangle_that_is_one_point_adds_nothing") {
  for (const mesh::Point& p : {mesh::Point{0, 0, 0}, mesh::Point{3, 4, 5}}) {
    CHECK(half_cotangents(p, p, p) == Vec3{0, 0, 0});
    CHECK(is_thin(p, p, p));
  }
  const mesh::Point tiny{5e-324, 0, 0};  // scaling it to size 1 would overflow
  CHECK(half_cotangents({0, 0, 0}, tiny, {0, 0, 0}) == Vec3{0, 0, 0});
}

TEST_CASE("grounded_unknowns_equal_their_right_hand_sides") {
  const std::vector<MatrixEntry> entries = {{0, 0, 4}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1},
                                            {1, 1, 2}, {2, 1, 7}, {1, 2, 7}, {2, 2, 9}};
  const SparseMatrix matrix = sparse_matrix(4, entries);
  CHECK(matrix.size() == 4);
  CHECK(matrix.values == std::vector<double>{4, 1, 1, 3, 7, 7, 9});
  const SparseMatrix lower = grounded(matrix, {true, true, false, false});
  std::vector<std::array<double, 3>> found;
  for (std::uint32_t j = 0; j < 4; ++j)
    for_column(lower, j, [&](std::uint32_t i, double value) {
      found.push_back({double(i), double(j), value});
    });
  CHECK(found == std::vector<std::array<double, 3>>{{0, 0, 4}, {1, 0, 1}, {1, 1, 3}, {2, 2, 1}, {3, 3, 1}});
  mesh::UnionFind sets = connected(matrix);
  CHECK(sets.find(0) == sets.find(2));
  CHECK(sets.find(3) != sets.find(0));
}

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
      for (const auto v : t) {
        thirds[v] += third;
        area += third;
      }
    }
    for (std::size_t v = 0; v < masses.size(); ++v) CHECK(masses[v] == doctest::Approx(thirds[v] / area));
  }
}

TEST_CASE("the_triangulation_of_a_plane_does_not_matter") {
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

TEST_CASE("no_weight_is_negative_for_any_triangles") {
  for (const double moved : {0.0, 0.3, 0.49}) check_laplacian(cut_grid(15, moved, 3));
  auto stretched = cut_grid(15, 0.4, 5);
  for (auto& p : stretched.positions) {
    p[0] *= 1000;
    p[2] = std::sin(20 * p[1]);
  }
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

TEST_CASE("laplacian_weights_do_not_depend_on_scale") {
  const auto surface = soup(4, 40, 100);
  const auto here = intrinsic_laplacian(surface);
  for (const double scale : {1e-90, 1e90})
    CHECK(largest_difference(intrinsic_laplacian(mapped(surface, scaling(scale))).stiffness, here.stiffness) <
          1e-6 * (1 + largest_difference(here.stiffness, sparse_matrix(here.masses.size(), {}))));
}
