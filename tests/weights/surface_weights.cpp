#include "weights/surface_weights.h"

#include <Eigen/Dense>

#include "deform/bound.h"
#include "deform/exact.h"
#include "mesh/drawing.h"
#include "weights/point_weights.h"

using namespace viete;
using namespace viete::test;

namespace {

using std::numbers::pi;

// Returns a cage of small triangles at these places. The cage encloses nothing.
Cage triangles_at(const std::vector<Vec3>& places) {
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (const Vec3& place : places) {
    const auto first = static_cast<std::uint32_t>(p.size());
    for (const Vec3 corner : {Vec3{0.02, 0, 0}, Vec3{-0.01, 0.02, 0}, Vec3{-0.01, -0.02, 0}})
      p.push_back(place + corner);
    t.push_back({first, first + 1, first + 2});
  }
  return make_cage(mesh::from_triangles(p, t));
}

// Solves for the weights. The result has one row per vertex.
Eigen::MatrixXd solved_weights(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
                               int threads = 2) {
  base::WorkerPool pool(threads);
  const SurfaceSystem system(model, cage, weighting, pool);
  CHECK(system.vertices() == model.positions.size());
  Eigen::MatrixXd weights(system.vertices(), system.handles());
  system.solve(
      [&](const SurfaceSystem::Solved& s) {
        for (std::size_t v = 0; v < system.vertices(); ++v)
          for (std::size_t c = 0; c < s.count; ++c)
            weights(Eigen::Index(v), Eigen::Index(s.first + c)) = s.of(v)[c];
      },
      pool, nullptr);
  return weights;
}

double off_one(const Eigen::MatrixXd& weights) {
  return (weights.rowwise().sum().array() - 1).abs().maxCoeff();
}

mesh::Surface wavy_sphere(std::uint32_t rings, std::uint32_t sides) {
  auto surface = tube(rings, sides, 1, 2);
  for (auto& p : surface.positions) {
    const double z = p[2], r = std::sqrt(std::max(0.0, 1 - z * z)) + 0.01;
    const double wave = 1 + 0.2 * std::sin(5 * p[0] + 3 * z);
    p = {wave * r * p[0], 0.6 * wave * r * p[1], z};
  }
  return surface;
}

}  // namespace

TEST_CASE("each_handle_owns_the_vertex_that_is_nearest_to_it") {
  const auto model = wavy_sphere(30, 20);
  const Cage cage = make_cage(tube(5, 7, 1.3, 3));
  base::WorkerPool pool(2);
  for (const auto elements : {Elements::face, Elements::point}) {
    const auto owned = owned_vertices(model, cage, elements, pool);
    REQUIRE(owned.of_handle.size() == handle_count(cage, elements));
    double owners = 0;
    for (const auto count : owned.owners) owners += count;
    CHECK(owners == doctest::Approx(double(owned.of_handle.size())));
    for (std::uint32_t h = 0; h < owned.of_handle.size(); ++h) {
      const auto t = handle_shape(cage, elements, h).corners;
      const auto& x = cage.elements.positions;
      const auto distance = [&](const Vec3& p) {
        return mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance;
      };
      REQUIRE(!owned.of_handle[h].empty());
      const auto v = owned.of_handle[h][0].vertex;
      const double least = distance(model.positions[v]) - 1e-5;
      CHECK(owned.owners[v] >= owned.of_handle[h][0].part);
      for (const auto& p : model.positions) CHECK(distance(p) >= least);
    }
  }
}

TEST_CASE("handles_without_area_and_vertices_without_triangles_own_nothing_and_are_not_owned") {
  auto cage_surface = box();
  cage_surface = mesh::from_triangles(cage_surface.positions, cage_surface.triangles);
  cage_surface.positions.push_back({0, 0, 1});  // this vertex has no triangle
  cage_surface.triangles.push_back({0, 0, 1});  // this triangle has no area
  const Cage cage = make_cage(mesh::from_triangles(cage_surface.positions, cage_surface.triangles));
  auto model = box({0.5, 0.5, 0.5});
  model.positions.push_back({0.99, 0, 0});  // nearest to a side of the cage, but in no triangle
  base::WorkerPool pool(1);
  const auto faces_own = owned_vertices(model, cage, Elements::face, pool);
  CHECK(faces_own.of_handle.back().empty());
  CHECK(faces_own.owners.back() == 0);
  CHECK(owned_vertices(model, cage, Elements::point, pool).of_handle.back().empty());
  const auto weights = solved_weights(model, cage, harmonics);
  CHECK(weights.col(weights.cols() - 1).cwiseAbs().maxCoeff() == 0);
  CHECK(off_one(weights) < 1e-14);
}

TEST_CASE("along_a_tube_harmonic_weights_are_those_of_resistors_in_a_row") {
  constexpr std::uint32_t rings = 12, sides = 10;
  constexpr double radius = 0.5, length = 3;
  const auto model = tube(rings, sides, radius, length);
  const auto weights = solved_weights(model, triangles_at({{0, 0, -2}, {0, 0, 2}}), harmonics);
  const double chord = 2 * radius * std::sin(pi / sides), step = length / (rings - 1);
  const double cap = 1 / (sides * std::tan(pi / sides)), ring = step / (sides * chord);
  const double total = 2 * cap + (rings - 1) * ring;
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < sides; ++s) {
      const double expected = (cap + r * ring) / total;
      CHECK(weights(r * sides + s, 1) == doctest::Approx(expected).epsilon(1e-12));
      CHECK(weights(r * sides + s, 0) == doctest::Approx(1 - expected).epsilon(1e-12));
    }
  CHECK(weights(rings * sides, 0) == 1);
  CHECK(weights(rings * sides, 1) == 0);
  CHECK(weights(rings * sides + 1, 1) == 1);
}

TEST_CASE("handles_share_a_vertex_that_is_nearest_to_several") {
  const auto model = tube(12, 10, 0.5, 3);
  const std::uint32_t low = 120, high = 121;  // the middles of the caps
  for (const auto& weighting : {harmonics, biharmonics}) {
    const auto alone = solved_weights(model, triangles_at({{0, 0, -2}, {0, 0, 2}}), weighting);
    const auto three = solved_weights(
        model, triangles_at({{0, 0, -2}, {0, 0, 2}, {0, 0, -2.1}, {0.01, 0, -2.2}}), weighting);
    for (const auto k : {0, 2, 3}) {
      if (weighting == harmonics) {
        CHECK((three.col(k) - alone.col(0) / 3).cwiseAbs().maxCoeff() < 1e-14);
        CHECK(three(low, k) == 1.0 / 3);
        CHECK(three(high, k) == 0);
      }
      CHECK((three.col(k) - three.col(0)).cwiseAbs().maxCoeff() < 1e-9);
    }
    CHECK(off_one(three) < 1e-9);
  }
}

TEST_CASE("harmonic_weights_are_between_0_and_1_for_any_triangles") {
  Random random(11);
  auto bad = wavy_sphere(25, 30);
  for (auto& p : bad.positions) p = p + random.vector(0.1);  // makes folds and needles
  auto open = bad;
  open.triangles.resize(open.triangles.size() * 2 / 3);
  auto sewn = bad;  // has edges with three triangles
  for (std::uint32_t i = 0; i < 50; ++i) sewn.triangles.push_back({i, i + 31, i + 200});
  auto flat = bad;  // has triangles without area, and coincident vertices
  for (auto& p : flat.positions) {
    p[1] = 0;
    p[0] = std::round(4 * p[0]);
  }
  const Cage cage = make_cage(tube(6, 8, 1.5, 3));
  for (const auto& model : {bad, open, sewn, flat}) {
    const auto weights =
        solved_weights(mesh::from_triangles(model.positions, model.triangles), cage, harmonics);
    CHECK(weights.minCoeff() == 0);
    CHECK(weights.maxCoeff() <= 1 + 1e-12);
    CHECK(off_one(weights) < 1e-9);
  }
}

TEST_CASE("biharmonic_weights_are_the_least_of_bending_and_springs") {
  const auto model = wavy_sphere(12, 11);
  const Cage cage = make_cage(tube(4, 5, 1.3, 3));
  base::WorkerPool pool(1);
  const auto owned = owned_vertices(model, cage, Elements::face, pool);
  const auto [stiffness, masses] = intrinsic_laplacian(model);
  const auto n = Eigen::Index(model.positions.size()), k = Eigen::Index(cage.element_count());
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(n, n), target = Eigen::MatrixXd::Zero(n, k);
  for (std::size_t j = 0; j < stiffness.size(); ++j)
    for (auto i = stiffness.starts[j]; i < stiffness.starts[j + 1]; ++i)
      l(stiffness.rows[i], Eigen::Index(j)) = stiffness.values[i];
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index v = 0; v < n; ++v) system += l.col(v) * l.row(v) / masses[v];
  for (Eigen::Index h = 0; h < k; ++h)
    for (const auto& one : owned.of_handle[std::size_t(h)])
      target(one.vertex, h) = double(k) * std::min(1.0, owned.owners[one.vertex]) * owned.value(one);
  for (Eigen::Index v = 0; v < n; ++v) system(v, v) += double(k) * std::min(1.0, owned.owners[v]);
  const Eigen::MatrixXd expected = system.ldlt().solve(target);
  const auto weights = solved_weights(model, cage, biharmonics);
  CHECK((weights - expected).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(off_one(weights) < 1e-9);
  CHECK(weights.minCoeff() < -1e-3);  // biharmonic weights may be negative
}

TEST_CASE("biharmonic_weights_hardly_depend_on_how_fine_the_model_is") {
  const Cage cage = triangles_at({{0, 0, -2}, {0, 0, 2}, {1, 0, 0.4}, {0, -1, -0.3}});
  const std::uint32_t rings = 25, sides = 12;
  const auto coarse = solved_weights(tube(rings, sides, 0.5, 3), cage, biharmonics);
  const auto fine = solved_weights(tube(2 * rings - 1, 2 * sides, 0.5, 3), cage, biharmonics);
  double worst = 0;
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < sides; ++s)
      worst = std::max(worst,
                       (coarse.row(r * sides + s) - fine.row(4 * r * sides + 2 * s)).cwiseAbs().maxCoeff());
  CHECK(worst < 0.02);
}

TEST_CASE("parts_that_no_handle_owns_and_stray_vertices_follow_the_nearest_part_as_one") {
  const auto main = tube(12, 10, 0.5, 3), other = mapped(tube(4, 5, 0.1, 0.3), scaling(1, {0.9, 0, 1.05}));
  auto model = together(main, other);
  model.positions.push_back({-0.7, 0, -0.8});
  const Cage cage = triangles_at({{0, 0, -2}, {0, 0, 2}, {-1, 0, 0}});
  const auto nearest = [&](const Vec3& p) {
    std::size_t best = 0;
    for (std::size_t v = 0; v < main.positions.size(); ++v)
      if (norm(main.positions[v] - p) < norm(main.positions[best] - p)) best = v;
    return Eigen::Index(best);
  };
  for (const auto& weighting : {harmonics, biharmonics}) {
    const auto weights = solved_weights(model, cage, weighting);
    CHECK(off_one(weights) < 1e-9);
    const auto middle = nearest({0.9, 0, 1.05});
    for (std::size_t v = main.positions.size(); v + 1 < model.positions.size(); ++v)
      CHECK((weights.row(Eigen::Index(v)) - weights.row(middle)).cwiseAbs().maxCoeff() == 0);
    const auto stray = weights.rows() - 1;
    CHECK((weights.row(stray) - weights.row(nearest(model.positions.back()))).cwiseAbs().maxCoeff() == 0);
    CHECK(weights.row(stray).maxCoeff() < 1);
  }
}

TEST_CASE("surface_weights_have_the_same_bits_for_any_number_of_threads") {
  const auto model = wavy_sphere(20, 20);
  const Cage cage = make_cage(tube(6, 8, 1.5, 3));
  for (const auto& weighting : {harmonics, biharmonics})
    CHECK(solved_weights(model, cage, weighting, 1) == solved_weights(model, cage, weighting, 3));
}

TEST_CASE("solving_for_surface_weights_can_be_cancelled") {
  const Cage cage = make_cage(box({2, 2, 2}));
  base::WorkerPool pool(1);
  for (const auto& weighting : {harmonics, biharmonics}) {
    base::Progress progress;
    bind(wavy_sphere(8, 8), cage, weighting, pool, &progress);
    CHECK(progress.done() == 1);
    bind_tiles(wavy_sphere(8, 8), cage, weighting, pool, usual_tolerance, &progress);
    CHECK(progress.done() == 1);
    progress.cancel();
    CHECK_THROWS_AS(bind(wavy_sphere(8, 8), cage, weighting, pool, &progress), base::Cancelled);
    CHECK_THROWS_AS(bind_tiles(wavy_sphere(8, 8), cage, weighting, pool, usual_tolerance, &progress),
                    base::Cancelled);
  }
}

TEST_CASE("bound_rows_sum_to_1_to_the_last_bits_and_clamped_plates_are_not_negative") {
  for (const auto& weighting : {harmonics, biharmonics}) {
    const Bound b(wavy_sphere(60, 50), tube(6, 8, 1.5, 3), weighting);
    const auto& w = b.binding->weights;
    for (std::size_t v = 0; v < w.size(); v += b.binding->handles)
      CHECK(std::abs(std::accumulate(&w[v], &w[v] + b.binding->handles, 0.0) - 1) < 1e-14);
    const auto [low, high] = std::ranges::minmax(w);
    CHECK(low == 0);
    CHECK(high <= 1.2);
  }
}

TEST_CASE("tiles_and_samples_have_the_surface_weights_of_the_staged_engine") {
  for (const auto& weighting : {harmonics, biharmonics}) {
    Bound b(wavy_sphere(60, 50), tube(6, 8, 1.5, 3), weighting);
    const auto& all = *b.binding;
    std::vector<std::size_t> vertices(all.vertices);
    for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = v;
    const Weigher weigher(*b.cage, weighting);
    for (const auto storage : {Storage::dense, Storage::factors, Storage::lists}) {
      Binding tiled = all;
      tiled.weights.clear();
      tiled.tiles = std::make_shared<const TiledBinding>(
          bind_tiles(b.model, *b.cage, weighting, b.pool, usual_tolerance, nullptr, storage));
      CHECK(tiled.tiles->storage() == storage);
      const Binding part = bind_vertices(weigher, *tiled.rest, known_row(tiled), nullptr, vertices).binding;
      double worst = 0;
      for (std::size_t i = 0; i < all.weights.size(); ++i)
        worst = std::max(worst, std::abs(part.weights[i] - all.weights[i]));
      CHECK(worst < (storage == Storage::factors ? usual_tolerance : 1e-7));
      const auto sampled = spread_vertices(all.vertices, error_sample);
      REQUIRE(tiled.tiles->sample.size() == sampled.size() * all.handles);
      for (std::size_t s = 0; s < sampled.size(); ++s)
        for (std::size_t j = 0; j < all.handles; ++j)
          CHECK(tiled.tiles->sample[s * all.handles + j] == all.weights[sampled[s] * all.handles + j]);
    }
    CHECK(bind_vertices(weigher, *all.rest, known_row(all), nullptr, vertices).binding.weights ==
          all.weights);
  }
}

TEST_CASE("a_part_with_known_weights_moves_like_the_whole_model") {
  const Bound b(wavy_sphere(60, 50), tube(6, 8, 1.5, 3), biharmonics);
  mesh::Draft draft;
  for (std::uint32_t v = 0; v < b.model.positions.size(); v += 3) draft.vertices.push_back(v);
  draft.surface =
      mesh::from_triangles(mesh::picked(std::span<const mesh::Point>(b.model.positions), draft.vertices), {});
  const auto row = [&](std::uint32_t v, std::span<double> weights) {
    std::copy_n(b.binding->weights.data() + draft.vertices[v] * weights.size(), weights.size(),
                weights.data());
  };
  base::WorkerPool pool;
  auto tiles = std::make_shared<const TiledBinding>(
      bind_tiles(draft.surface, *b.cage, biharmonics, pool, usual_tolerance, nullptr, {}, row));
  const auto part = std::make_shared<const Binding>(
      weights::with_tiles(mesh::lent(draft.surface), *b.cage, std::move(tiles)));
  FusedFrame whole(
      b.cage,
      with_tiles(b, std::make_shared<const TiledBinding>(bind_tiles(b.model, *b.cage, biharmonics, pool, 0))),
      pool),
      moved(b.cage, part, pool);
  const Pose pose = b.pose(Twist{2, {0, 0, 0}, -1, 1, -60 * degree, 60 * degree});
  whole.deform(pose);
  moved.deform(pose);
  const auto expected = whole.positions();
  CHECK(largest_distance(moved.positions(),
                         mesh::picked(std::span<const mesh::Point>(expected), draft.vertices)) <
        3 * usual_tolerance * b.cage->diagonal);
}
