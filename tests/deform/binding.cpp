#include <doctest/doctest.h>
#include <numeric>

#include "base/error.h"
#include "deform/bind.h"
#include "deform/bind_kernel.h"
#include "deform/binding.h"
#include "deform/bound.h"
#include "deform/factoring.h"
#include "deform/shapes.h"

using namespace viete::test;

TEST_CASE("low_rank_rows_are_factored_by_a_few_rows_on_every_instruction_set") {
  // 64 rows of 40 columns, of rank 5 plus noise.
  constexpr std::size_t tiles = 4, columns = 40, lanes = 16;
  Random random(23);
  std::vector<std::vector<double>> left(64, std::vector<double>(5)), right(5, std::vector<double>(columns));
  for (auto& row : left)
    for (double& x : row) x = random(-1, 1);
  for (auto& row : right)
    for (double& x : row) x = random(-1, 1);
  viete::base::AlignedVector<float> rows(tiles * lanes * columns);
  const auto entry = [&](std::size_t s, std::size_t j) {
    return rows[s / lanes * lanes * columns + j * lanes + s % lanes];
  };
  for (std::size_t s = 0; s < 64; ++s) {
    for (std::size_t j = 0; j < columns; ++j) {
      double sum = random(-1e-6, 1e-6);
      for (int t = 0; t < 5; ++t) sum += left[s][t] * right[t][j];
      rows[s / lanes * lanes * columns + j * lanes + s % lanes] = static_cast<float>(sum);
    }
  }
  for (const auto& kernel : viete::sym3::kernels()) {
    CAPTURE(kernel.name);
    viete::base::AlignedVector<float> work = rows;
    const Factors f = factor_rows({work.data(), tiles, columns}, 64, 1e-4, 20, bind_kernel(kernel));
    REQUIRE(f.pivots.size() == 5);
    double worst = 0;
    for (std::size_t s = 0; s < 64; ++s) {
      double squared = 0;
      for (std::size_t j = 0; j < columns; ++j) {
        double sum = 0;
        for (std::size_t t = 0; t < 5; ++t)
          sum += f.factors[s / lanes * lanes * 5 + t * lanes + s % lanes] * entry(f.pivots[t], j);
        squared += (sum - entry(s, j)) * (sum - entry(s, j));
      }
      worst = std::max(worst, std::sqrt(squared));
    }
    CHECK(worst < 1e-4);
    work = rows;
    CHECK(factor_rows({work.data(), tiles, columns}, 64, 1e-4, 4, bind_kernel(kernel)).pivots.empty());
  }
}

using viete::base::WorkerPool;

TEST_CASE("every_row_of_weights_sums_to_one") {
  const Cage cage = make_cage(tube(9, 7, 0.4, 2.2));
  const auto model = tube(20, 12, 0.3, 2);
  WorkerPool pool(2);
  for (const auto& c : {faces, mean_values}) {
    const Binding b = bind(model, cage, c, pool);
    CHECK(b.handles == (c == faces ? cage.element_count() : cage.surface.positions.size()));
    CHECK(b.vertices == model.positions.size());
    REQUIRE(b.weights.size() == b.vertices * b.handles);
    for (std::size_t i = 0; i < b.vertices; ++i) {
      const auto row = b.weights.begin() + static_cast<std::ptrdiff_t>(i * b.handles);
      CHECK(std::accumulate(row, row + static_cast<std::ptrdiff_t>(b.handles), 0.0) ==
            doctest::Approx(1).epsilon(1e-13));
    }
    CHECK(b.warnings.empty());
  }
}

TEST_CASE("binding_has_the_same_bits_for_any_number_of_threads") {
  const Cage cage = make_cage(tube(9, 7, 0.4, 2.2));
  const auto model = tube(20, 12, 0.3, 2);
  for (const auto& c : {faces, mean_values}) {
    WorkerPool one(1), three(3);
    const Binding a = bind(model, cage, c, one), b = bind(model, cage, c, three);
    CHECK(a.weights == b.weights);
    CHECK(a.offsets == b.offsets);
  }
}

TEST_CASE("binding_reports_progress_up_to_one") {
  const Cage cage = make_cage(box());
  WorkerPool pool(2);
  viete::base::Progress progress;
  bind(tube(40, 12, 0.3, 1), cage, faces, pool, &progress);
  CHECK(progress.done() > 0.5);
  CHECK(progress.done() <= 1);
}

TEST_CASE("binding_can_be_cancelled") {
  const Cage cage = make_cage(box());
  WorkerPool pool(2);
  viete::base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(bind(tube(40, 12, 0.3, 1), cage, faces, pool, &progress), viete::base::Cancelled);
  CHECK(bind(tube(4, 12, 0.3, 1), cage, faces, pool).vertices == 50);
}

TEST_CASE("a_binding_that_cannot_fit_is_refused_with_numbers") {
  // 3 million vertices by 2 million triangles: 48 TB.
  Cage cage = make_cage(box());
  cage.centers.resize(2'000'000);
  viete::mesh::Surface model;
  model.positions.resize(3'000'000);
  WorkerPool pool(1);
  try {
    bind(model, cage, faces, pool);
    FAIL("accepted");
  } catch (const viete::base::Error& error) {
    CHECK(error.problem().find("3000000 vertices") != std::string::npos);
    CHECK(error.problem().find("2000000 cage") != std::string::npos);
    CHECK(error.problem().find("GB") != std::string::npos);
    CHECK_FALSE(error.advice().empty());
  }
  CHECK(binding_bytes(3'000'000, 2'000'000) > 48'000'000'000'000u);
  CHECK(binding_bytes(SIZE_MAX, SIZE_MAX) == std::size_t(1) << 63);
}

TEST_CASE("a_model_without_vertices_is_refused") {
  WorkerPool pool(1);
  CHECK_THROWS_AS(bind({}, make_cage(box()), faces, pool), viete::base::Error);
}

TEST_CASE("mean_value_binding_to_an_open_cage_warns_and_face_binding_does_not") {
  auto t = box().triangles;
  t.pop_back();
  const Cage cage = make_cage(viete::mesh::from_triangles(box().positions, t));
  WorkerPool pool(1);
  CHECK(bind(tube(4, 12, 0.3, 1), cage, mean_values, pool).warnings.size() == 1);
  CHECK(bind(tube(4, 12, 0.3, 1), cage, faces, pool).warnings.empty());
}
