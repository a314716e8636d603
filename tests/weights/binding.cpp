#include <Eigen/Dense>

#include "deform/bound.h"
#include "weights/binding.h"
#include "weights/factoring.h"

using namespace viete::test;

TEST_CASE("low_rank_rows_are_factored_by_a_few_rows_on_every_instruction_set") {
  // A matrix of 64 rows and 40 columns. It has rank 5, plus noise.
  constexpr int count = 64, columns = 40, lanes = 16;
  const auto random = [](int n, int m) -> Eigen::MatrixXd { return Eigen::MatrixXd::Random(n, m); };
  const Eigen::MatrixXd whole = random(count, 5) * random(5, columns) + 1e-6 * random(count, columns);
  viete::base::AlignedVector<float> rows(count * columns);
  for (int s = 0; s < count; ++s)
    for (int j = 0; j < columns; ++j)
      rows[s / lanes * lanes * columns + j * lanes + s % lanes] = static_cast<float>(whole(s, j));
  for (const auto& kernel : viete::sym3::kernels()) {
    CAPTURE(kernel.name);
    viete::base::AlignedVector<float> work = rows;
    const Factors f =
        factor_rows({work.data(), count / lanes, columns}, count, 1e-4, 20, bind_kernel(kernel));
    REQUIRE(f.pivots.size() == 5);
    Eigen::MatrixXd factors(count, 5), pivots(5, columns);
    for (int t = 0; t < 5; ++t) {
      pivots.row(t) = whole.row(f.pivots[t]);
      for (int s = 0; s < count; ++s)
        factors(s, t) = f.factors[s / lanes * lanes * 5 + t * lanes + s % lanes];
    }
    CHECK((factors * pivots - whole).rowwise().norm().maxCoeff() < 1e-4);
    work = rows;
    CHECK(factor_rows({work.data(), count / lanes, columns}, count, 1e-4, 4, bind_kernel(kernel))
              .pivots.empty());
  }
}

using viete::base::WorkerPool;

TEST_CASE("every_row_of_weights_sums_to_one_with_the_same_bits_for_any_number_of_threads") {
  const Cage cage = make_cage(tube(9, 7, 0.4, 2.2));
  const auto model = tube(20, 12, 0.3, 2);
  WorkerPool one(1), three(3);
  for (const auto& c : {faces, mean_values}) {
    const Binding b = bind(model, cage, c, one), same = bind(model, cage, c, three);
    CHECK(b.weights == same.weights);
    CHECK(b.offsets == same.offsets);
    CHECK(b.handles == (c == faces ? cage.element_count() : cage.surface.positions.size()));
    REQUIRE(b.weights.size() == model.positions.size() * b.handles);
    for (std::size_t i = 0; i < b.weights.size(); i += b.handles)
      CHECK(std::accumulate(&b.weights[i], &b.weights[i] + b.handles, 0.0) ==
            doctest::Approx(1).epsilon(1e-13));
    CHECK(b.warnings.empty());
  }
}

TEST_CASE("binding_reports_progress_and_can_be_cancelled_and_models_without_vertices_are_refused") {
  const Cage cage = make_cage(box());
  const auto model = tube(40, 12, 0.3, 1);
  WorkerPool pool(2);
  viete::base::Progress progress;
  bind(model, cage, faces, pool, &progress);
  CHECK(progress.done() > 0.5);
  CHECK(progress.done() <= 1);
  progress.cancel();
  CHECK_THROWS_AS(bind(model, cage, faces, pool, &progress), viete::base::Cancelled);
  CHECK_THROWS_AS(bind({}, cage, faces, pool), viete::base::Error);
}

TEST_CASE("a_binding_that_cannot_fit_is_refused_with_numbers") {
  // 3 million vertices and a cage of 2 million triangles would need 48 TB.
  Cage cage = make_cage(box());
  cage.centers.resize(2'000'000);
  viete::mesh::Surface model;
  model.positions.resize(3'000'000);
  WorkerPool pool(1);
  for (const char* text : {"3000000 vertices", "2000000 cage", "GB"})
    CHECK_THROWS_WITH_AS(bind(model, cage, faces, pool), doctest::Contains(text), viete::base::Error);
  CHECK(binding_bytes(3'000'000, 2'000'000) > 48'000'000'000'000u);
  CHECK(binding_bytes(SIZE_MAX, SIZE_MAX) == std::size_t(1) << 63);
}

TEST_CASE("mean_value_binding_to_an_open_cage_warns_and_face_binding_does_not") {
  auto t = box().triangles;
  t.pop_back();
  const Cage cage = make_cage(viete::mesh::from_triangles(box().positions, t));
  WorkerPool pool(1);
  CHECK(bind(tube(4, 12, 0.3, 1), cage, mean_values, pool).warnings.size() == 1);
  CHECK(bind(tube(4, 12, 0.3, 1), cage, faces, pool).warnings.empty());
}
