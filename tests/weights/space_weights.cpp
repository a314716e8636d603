#include "weights/space_weights.h"

#include <Eigen/Dense>

#include "deform/bound.h"
#include "weights/coarse_model.h"
#include "weights/point_weights.h"
#include "weights/tiled_binding.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr Weighting rigid_points{Elements::point, Weights::biharmonic};
constexpr Weighting in_space[] = {harmonics, biharmonics, rigid_points};

mesh::Surface cloud_of(std::vector<mesh::Point> points) {
  mesh::Surface cloud;
  cloud.positions = std::move(points);
  return cloud;
}

// Returns the weights of points as [point][handle].
std::vector<double> weights_at(const std::vector<mesh::Point>& points, const Cage& cage,
                               const Weighting& weighting, int threads = 2) {
  base::WorkerPool pool(threads);
  return bind(cloud_of(points), cage, weighting, pool).weights;
}

mesh::Surface tube_cage() {
  return tube(5, 6, 0.8, 3);
}

// Solves for all coefficients and constants by the definition of SpaceWeights, and evaluates them at p.
Eigen::VectorXd by_definition(const Cage& cage, const Weighting& weighting, const mesh::Point& p) {
  const auto centers = handle_centers(cage, weighting.elements);
  const auto n = Eigen::Index(centers.size());
  double area = 0, count = 0;
  for (const auto& t : cage.elements.triangles) area += mesh::area(cage.elements.positions, t);
  for (std::size_t h = 0; h < centers.size(); ++h) count += handle_shape(cage, weighting.elements, h).share;
  const double spacing = std::sqrt(area / count);
  const bool harmonic = weighting.weights == Weights::harmonic;
  const auto function = [&](const Vec3& x) {
    const double r = std::sqrt(squared_norm(x) + spacing * spacing) / spacing;
    return harmonic ? 1 / r : -r;
  };
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Ones(n + 1, n + 1), targets = Eigen::MatrixXd::Zero(n + 1, n);
  matrix(n, n) = 0;
  targets.topRows(n).setIdentity();
  Eigen::RowVectorXd at = Eigen::RowVectorXd::Ones(n + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    at[i] = function(p - centers[std::size_t(i)]);
    for (Eigen::Index j = 0; j < n; ++j)
      matrix(i, j) = function(centers[std::size_t(i)] - centers[std::size_t(j)]);
    matrix(i, i) += (harmonic ? 1 : 6) / handle_shape(cage, weighting.elements, std::size_t(i)).share;
  }
  Eigen::VectorXd w = (at * matrix.fullPivLu().solve(targets)).transpose();
  const double d = 0.3 / count;
  for (double& x : w) x = x <= 0 ? 0 : x < 2 * d ? x * x / (4 * d) : x - d;
  return w / w.sum();
}

}  // namespace

TEST_CASE("weights_in_space_follow_their_definition") {
  const Cage cage = make_cage(tube_cage());
  const auto points = Random(5).vectors(40, 2);
  for (const Weighting& weighting : in_space) {
    const auto weights = weights_at(points, cage, weighting);
    const std::size_t k = weights.size() / points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Map<const Eigen::VectorXd> row(weights.data() + i * k, Eigen::Index(k));
      CHECK((row - by_definition(cage, weighting, points[i])).cwiseAbs().maxCoeff() < 1e-11);
      CHECK(std::abs(row.sum() - 1) < 1e-14);
      CHECK(row.minCoeff() >= 0);
    }
  }
}

TEST_CASE("clouds_follow_similarities_of_the_cage_exactly") {
  for (const Weighting& weighting : {harmonics, biharmonics}) {
    Bound bound(cloud_of(Random(6).vectors(100, 1.5)), tube_cage(), weighting);
    CHECK(bound.error(similarity({1, -2, 3}, 150 * degree, 2, {30, 4, 5})) < 1e-13);
  }
  Bound affine(cloud_of(Random(6).vectors(100, 1.5)), tube_cage(), rigid_points, 2, Blend::mls_affine);
  CHECK(affine.error(shear()) < 1e-12);
}

TEST_CASE("weights_in_space_do_not_depend_on_other_points_or_on_threads") {
  const Cage cage = make_cage(tube_cage());
  const auto points = Random(7).vectors(101, 1.2);
  std::vector<mesh::Point> more;
  for (const auto& p : points)
    for (const double shift : {0.0, 0.01, -0.01}) more.push_back(p + Vec3{shift, 0, 0});
  for (const Weighting& weighting : in_space) {
    const auto weights = weights_at(points, cage, weighting, 1),
               others = weights_at(more, cage, weighting, 3);
    const std::size_t k = weights.size() / points.size();
    for (std::size_t i = 0; i < points.size(); ++i)
      CHECK(std::equal(weights.begin() + std::ptrdiff_t(i * k), weights.begin() + std::ptrdiff_t(i * k + k),
                       others.begin() + std::ptrdiff_t(3 * i * k)));
  }
}

TEST_CASE("weights_in_space_have_continuous_derivatives_in_and_outside_of_the_cage") {
  const Cage cage = make_cage(tube_cage());
  constexpr double step = 1e-5;
  std::vector<mesh::Point> points;
  for (int i = 0; i < 20'000; ++i) {  // along a line that crosses the cage twice
    const double t = -2 + i * 2e-4;
    for (const double s : {-step, 0.0, step}) points.push_back({t + s, 0.3 * t, 0.2 + 0.5 * (t + s)});
  }
  for (const Weighting& weighting : in_space) {
    const auto w = weights_at(points, cage, weighting);
    const std::size_t k = w.size() / points.size();
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); i += 3)
      for (std::size_t j = i * k; j < i * k + k; ++j)
        largest = std::max(largest, std::abs(w[j] - 2 * w[j + k] + w[j + 2 * k]) / step);
    CHECK(largest < 1e-3);  // a kink of a weight would have a change of about 0.1
  }
}

TEST_CASE("weights_in_space_are_symmetric_in_a_symmetric_cage") {
  const Cage cage = make_cage(box({1, 2, 3}));
  const auto points = Random(8).vectors(50, 3);
  std::vector<mesh::Point> mirrored;
  for (const auto& p : points) mirrored.push_back({-p[0], p[1], p[2]});
  const auto a = weights_at(points, cage, rigid_points), b = weights_at(mirrored, cage, rigid_points);
  for (std::size_t i = 0; i < a.size(); ++i)
    CHECK(std::abs(a[i] - b[i ^ 1]) < 1e-13);  // corner j ^ 1 mirrors j
}

TEST_CASE("distant_parts_of_a_cage_do_not_move_points_in_another_part") {
  const Cage cage =
      make_cage(together(tube(5, 6, 0.5, 2), mapped(tube(5, 6, 0.5, 2), scaling(1, {4, 0, 0}))));
  const auto points = Random(9).vectors(50, 0.4);
  const auto weights = weights_at(points, cage, biharmonics);
  const std::size_t k = weights.size() / points.size();
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (i % k >= k / 2) CHECK(weights[i] < 1e-3);
}

TEST_CASE("single_equal_and_distant_points_have_finite_weights_at_any_scale") {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    const Cage cage = make_cage(mapped(tube_cage(), scaling(scale)));
    for (const auto& points : {std::vector<mesh::Point>{{0, 0, 0}}, std::vector<mesh::Point>(20, {0, 0, 0}),
                               std::vector<mesh::Point>{{1e100, -1e100, 1e100}, {-1e60, 0, 0}}}) {
      const auto weights = weights_at(points, cage, biharmonics);
      const std::size_t k = weights.size() / points.size();
      for (std::size_t i = 0; i < points.size(); ++i)
        CHECK(std::abs(std::accumulate(weights.begin() + std::ptrdiff_t(i * k),
                                       weights.begin() + std::ptrdiff_t(i * k + k), 0.0) -
                       1) < 1e-13);
    }
  }
}

TEST_CASE("compressed_weights_of_a_cloud_are_within_the_tolerance") {
  base::WorkerPool pool(2);
  const Cage cage = make_cage(tube(12, 10, 0.8, 4));
  const auto cloud = cloud_of(tube(200, 100, 0.6, 3.8).positions);
  const TiledBinding tiles = bind_tiles(cloud, cage, biharmonics, pool);
  CHECK(tiles.compressed());
  CHECK(tiles.factor_count() + tiles.skeleton.size() < cloud.positions.size() * tiles.handles / 2);
  const Binding exact = bind(cloud, cage, biharmonics, pool);
  const auto slots = slots_of(tiles.leaves);
  std::vector<double> row(tiles.handles);
  for (std::size_t v = 0; v < slots.size(); v += 7) {
    tiles.kept_row(slots[v], row);
    double square = 0;
    for (std::size_t j = 0; j < row.size(); ++j)
      square += std::pow(row[j] - exact.weights[v * row.size() + j], 2);
    CHECK(std::sqrt(square) < 1.1 * usual_tolerance);
  }
}

TEST_CASE("a_lattice_fills_the_cage_is_symmetric_and_reproduces_linear_functions") {
  base::WorkerPool pool(2);
  const Cage cage = make_cage(box({1, 2, 3}));
  const Lattice lattice(cage, pool);
  const mesh::Surface surface = lattice.surface();
  CHECK(surface.positions.size() > 3000);
  CHECK(surface.positions.size() < 12'000);
  std::vector<mesh::Point> mirrored = mapped(surface.positions, Affine{{-1, 0, 0, 0, 1, 0, 0, 0, 1}});
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::array{std::round(1e6 * a[0]), std::round(1e6 * a[1]), std::round(1e6 * a[2])} <
           std::array{std::round(1e6 * b[0]), std::round(1e6 * b[1]), std::round(1e6 * b[2])};
  };
  auto points = surface.positions;
  std::ranges::sort(points, before);
  std::ranges::sort(mirrored, before);
  CHECK(largest_distance(points, mirrored) < 1e-12);
  std::vector<Lattice::Term> terms;
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    const mesh::Point p = {random(-0.8, 0.8), random(-1.8, 1.8), random(-2.8, 2.8)};
    lattice.terms(p, terms);
    Vec3 sum{0, 0, 0};
    for (const auto& [point, factor] : terms) sum = sum + factor * surface.positions[point];
    CHECK(norm(sum - p) < 1e-13);
  }
  for (const mesh::Point& p : {mesh::Point{1, 2, 3}, mesh::Point{-1, 2, -3}, mesh::Point{0, 0, 3}}) {
    lattice.terms(p, terms);
    CHECK_FALSE(terms.empty());
  }
  lattice.terms({1e100, 0, 0}, terms);
  CHECK(terms.empty());
}

TEST_CASE("a_lattice_does_not_connect_parts_of_the_cage_that_are_apart") {
  base::WorkerPool pool(2);
  const Lattice lattice(make_cage(together(box({1, 0.3, 0.3}), box({1, 0.3, 0.3}, {0, 1.4, 0}))), pool);
  const auto surface = lattice.surface();
  for (const auto& t : surface.triangles)
    CHECK((surface.positions[t[0]][1] < 0.7) == (surface.positions[t[1]][1] < 0.7));
}
