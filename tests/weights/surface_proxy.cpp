#include "weights/surface_proxy.h"

#include "base/os.h"
#include "deform/bound.h"
#include "support/shapes.h"
#include "support/skip.h"

using namespace viete;

namespace {

// Returns a torus of about `count` vertices, tilted so that each side of its box touches only one vertex.
mesh::Surface ring(std::size_t count) {
  const auto across = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(count) / 3));
  mesh::Surface torus = test::torus(3 * across, across);
  for (auto& p : torus.positions)
    p = {0.9 * p[0] + 0.2 * p[2], p[1] + 0.1 * p[2], 0.95 * p[2] - 0.15 * p[0] + 0.07 * p[1]};
  return torus;
}

const pose::Cage& box_cage() {
  static const pose::Cage cage = pose::make_cage(test::box({3, 3, 1}));
  return cage;
}

constexpr pose::Weighting biharmonic{pose::Elements::face, pose::Weights::biharmonic};

}  // namespace

TEST_CASE("factors_of_a_proxy_sum_to_one_and_reproduce_positions") {
  base::WorkerPool pool(1);
  const mesh::Surface model = ring(20'000);
  const weights::SurfaceProxy proxy(model, &box_cage(), pose::Elements::face, 2000, pool);
  CHECK(proxy.surface().positions.size() <= 2100);
  CHECK(proxy.surface().positions.size() > 500);
  std::vector<weights::SurfaceProxy::Term> terms;
  const double size = mesh::bounds(model.positions).diagonal();
  double worst = 0;
  for (std::uint32_t v = 0; v < model.positions.size(); v += 7) {
    proxy.terms(v, terms);
    double sum = 0;
    mesh::Point place{0, 0, 0};
    for (const auto& [cluster, factor] : terms) {
      sum += factor;
      place = place + factor * proxy.surface().positions[cluster];
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-9));
    worst = std::max(worst, norm(place - model.positions[v]));
  }
  CHECK(worst < 2e-3 * size);
}

TEST_CASE("values_of_a_proxy_are_not_extrapolated_at_sharp_edges") {
  base::WorkerPool pool(1);
  mesh::Surface model = ring(20'000);
  for (auto& p : model.positions) p[2] *= 0.02;
  const weights::SurfaceProxy proxy(model, &box_cage(), pose::Elements::face, 2000, pool);
  std::vector<weights::SurfaceProxy::Term> terms;
  double worst = 0;
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
    proxy.terms(v, terms);
    double sum = 0;
    for (const auto& term : terms) sum += std::abs(term.factor);
    worst = std::max(worst, sum);
  }
  CHECK(worst < 2);
}

TEST_CASE("weights_by_a_proxy_are_near_those_of_the_whole_model") {
  base::WorkerPool pool;
  const mesh::Surface model = ring(30'000);
  const pose::Cage& cage = box_cage();
  const weights::Binding whole = weights::bind(model, cage, biharmonic, pool);
  const weights::ProxyWeights weights(model, cage, biharmonic, pool, nullptr, 4000);
  std::vector<double> row(whole.handles);
  double worst = 0;
  for (std::uint32_t v = 0; v < whole.vertices; v += 11) {
    weights.row(v, row);
    CHECK(std::accumulate(row.begin(), row.end(), 0.0) == doctest::Approx(1).epsilon(1e-9));
    for (std::size_t j = 0; j < row.size(); ++j)
      worst = std::max(worst, std::abs(row[j] - whole.weights[v * whole.handles + j]));
  }
  CHECK(worst < 0.02);
}

TEST_CASE("many_small_parts_share_clusters_that_move_them_as_one") {
  base::WorkerPool pool;
  test::Random random(5);
  const auto flakes = [&](std::size_t count, const mesh::Surface& flake) {
    mesh::Surface all;
    std::vector<mesh::Triangle> triangles;
    for (std::size_t i = 0; i < count; ++i) {
      const auto first = std::uint32_t(all.positions.size());
      const mesh::Vec3 center = random.vector(1);
      for (const auto& p : flake.positions) all.positions.push_back(center + 0.01 * (p + random.vector(0.1)));
      for (const auto& [a, b, c] : flake.triangles) triangles.push_back({first + a, first + b, first + c});
    }
    return mesh::from_triangles(std::move(all.positions), triangles);
  };
  const mesh::Surface leaf = mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  mesh::Surface card;  // longer than a cluster, and narrower
  std::vector<mesh::Triangle> strip;
  for (std::uint32_t i = 0; i < 20; ++i) {
    card.positions.push_back({4.0 * i, 0, 0});
    card.positions.push_back({4.0 * i, 0.3, 0});
    if (i > 0) {
      strip.push_back({2 * i - 2, 2 * i - 1, 2 * i});
      strip.push_back({2 * i, 2 * i - 1, 2 * i + 1});
    }
  }
  card = mesh::from_triangles(card.positions, strip);
  const pose::Cage cage = pose::make_cage(test::box({1.5, 1.5, 1.5}));
  for (const mesh::Surface& model : {flakes(8000, leaf), flakes(4000, test::box()), flakes(400, card)}) {
    const weights::ProxyWeights weights(model, cage, biharmonic, pool, nullptr, 3000);
    const weights::SurfaceProxy& proxy = weights.proxy();
    CHECK(proxy.surface().positions.size() < 4100);
    CHECK(proxy.gathered() > model.positions.size() / 2);
    std::vector<weights::SurfaceProxy::Term> terms;
    std::vector<double> row(cage.centers.size()), next(row.size());
    for (std::uint32_t v = 0; v + 1 < model.positions.size(); v += 5) {
      proxy.terms(v, terms);
      mesh::Point place{0, 0, 0};
      for (const auto& [cluster, factor] : terms) place = place + factor * proxy.surface().positions[cluster];
      REQUIRE(norm(place - model.positions[v]) < 0.2);
      weights.row(v, row);
      weights.row(v + 1, next);
      const double apart = norm(model.positions[v + 1] - model.positions[v]);
      for (std::size_t h = 0; h < row.size(); ++h) REQUIRE(std::abs(row[h] - next[h]) < 0.02 + apart);
    }
  }
}

TEST_CASE("layers_closer_than_a_cell_stay_apart_in_a_proxy") {
  base::WorkerPool pool(1);
  mesh::Surface model = ring(10'000);
  const std::size_t first = model.positions.size();
  mesh::Surface other = model;
  for (auto& p : other.positions) p[2] += 1e-4;
  model = test::both(model, other);
  const weights::SurfaceProxy proxy(model, &box_cage(), pose::Elements::face, 1000, pool);
  std::vector<weights::SurfaceProxy::Term> terms;
  std::vector<int> layer(proxy.surface().positions.size(), 0);
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
    proxy.terms(v, terms);
    for (const auto& term : terms) layer[term.cluster] |= v < first ? 1 : 2;
  }
  CHECK(std::ranges::count(layer, 3) == 0);
}

TEST_CASE("a_large_model_at_rest_stays_at_rest_with_weights_of_a_proxy" * doctest::test_suite(test::longer)) {
  base::WorkerPool pool;
  const mesh::Surface model = ring(std::size_t(test::rounds(90'000, 3'200'000)));
  REQUIRE(model.positions.size() > weights::most_solved_vertices);
  const weights::TiledBinding tiles = weights::bind_tiles(model, box_cage(), biharmonic, pool);
  std::vector<double> row(tiles.handles);
  for (std::size_t slot = 0; slot < tiles.leaves.slot_count(); slot += 101) {
    tiles.kept_row(slot, row);
    CHECK(std::accumulate(row.begin(), row.end(), 0.0) == doctest::Approx(1).epsilon(1e-4));
    CHECK(*std::ranges::min_element(row) > -1e-3);
  }
}

TEST_CASE("weights_compressed_per_cluster_are_within_the_tolerance") {
  base::WorkerPool pool;
  const mesh::Surface model = ring(weights::most_solved_vertices + 10'000);
  mesh::Surface around = test::torus(14, 7);
  for (auto& p : around.positions) p = 1.3 * p;
  const pose::Cage cage = pose::make_cage(around);
  const weights::TiledBinding tiles = weights::bind_tiles(model, cage, biharmonic, pool);
  REQUIRE(tiles.storage() == weights::Storage::factors);
  const auto slots = weights::slots_of(tiles.leaves);
  const auto vertices = weights::spread_vertices(tiles.leaves.vertices, weights::error_sample);
  std::vector<double> kept(tiles.handles);
  double worst = 0;
  for (std::size_t s = 0; s < vertices.size(); ++s) {
    tiles.kept_row(slots[vertices[s]], kept);
    double square = 0;
    for (std::size_t j = 0; j < kept.size(); ++j)
      square += std::pow(kept[j] - tiles.sample[s * tiles.handles + j], 2);
    worst = std::max(worst, std::sqrt(square));
  }
  CHECK(worst <= weights::usual_tolerance);
  CHECK(worst > 0.01 * weights::usual_tolerance);
}

TEST_CASE("springs_of_a_proxy_are_at_the_same_points_as_those_of_the_model") {
  base::WorkerPool pool(1);
  const mesh::Surface one = ring(20'000);
  mesh::Surface inner = one;
  for (auto& p : inner.positions) p = 0.97 * p;
  for (const mesh::Surface& model : {one, test::both(one, inner)}) {
    const weights::SurfaceProxy proxy(model, &box_cage(), pose::Elements::face, 2000, pool);
    const auto whole = weights::owned_vertices(model, box_cage(), pose::Elements::face, pool);
    const auto coarse = weights::owned_vertices(proxy.surface(), box_cage(), pose::Elements::face, pool);
    for (std::size_t h = 0; h < whole.of_handle.size(); ++h)
      CHECK(proxy.surface().positions[coarse.of_handle[h][0].vertex] ==
            model.positions[whole.of_handle[h][0].vertex]);
  }
}

TEST_CASE("binding_by_a_proxy_reports_its_progress_and_can_be_cancelled") {
  base::WorkerPool pool;
  const mesh::Surface model = ring(weights::most_solved_vertices + 10'000);
  base::Progress progress;
  weights::bind(model, box_cage(), biharmonic, pool, &progress);
  CHECK(progress.done() == 1);
  weights::bind_tiles(model, box_cage(), biharmonic, pool, weights::usual_tolerance, &progress);
  CHECK(progress.done() == 1);
  progress.cancel();
  CHECK_THROWS_AS(weights::bind(model, box_cage(), biharmonic, pool, &progress), base::Cancelled);
  CHECK_THROWS_AS(
      weights::bind_tiles(model, box_cage(), biharmonic, pool, weights::usual_tolerance, &progress),
      base::Cancelled);
}

TEST_CASE("a_model_too_large_for_memory_is_refused_before_its_weights_are_solved") {
  if (!base::os::free_memory()) return;
  base::WorkerPool pool(1);
  mesh::Surface model = test::torus(60, 20);
  model.positions.resize(4'000'000, model.positions[0]);
  const pose::Cage cage = pose::make_cage(test::torus(300, 100));
  base::Progress progress;
  CHECK_THROWS_WITH_AS(
      weights::bind_tiles(model, cage, biharmonic, pool, weights::usual_tolerance, &progress),
      doctest::Contains("GB of memory, of which"), base::Error);
  CHECK(progress.done() == 0);
}
