#include "cages/soundness.h"

#include <doctest/doctest.h>

#include "cages/models.h"

using namespace viete;
using namespace viete::test;

TEST_CASE("closeness_of_a_cube_in_a_cube_is_what_it_is_by_hand") {
  base::WorkerPool pool(2);
  const mesh::Surface model = cube();
  for (const double scale : {1e-50, 1.0, 1e50}) {
    const auto close =
        cages::closeness(moved(stretched(cube(), {2, 2, 3}), scale), moved(model, scale), pool);
    const double expected = 1 / (2 * std::sqrt(3.0));
    CHECK(close.least == doctest::Approx(expected).epsilon(1e-12));
    CHECK(close.mean == doctest::Approx(expected).epsilon(1e-12));
    CHECK(close.most == doctest::Approx(expected).epsilon(1e-12));
    CHECK(close.volume == doctest::Approx(12).epsilon(1e-12));
  }
}

TEST_CASE("a_model_that_is_not_closed_has_no_volume_to_compare_with") {
  base::WorkerPool pool(1);
  const auto close = cages::closeness(stretched(cube(), {2, 2, 2}), without_lower_half(sphere(3)), pool);
  CHECK(close.volume == 0);
  CHECK(close.least > 0);
  CHECK(close.least <= close.mean);
  CHECK(close.mean <= close.most);
}

TEST_CASE("vertices_that_no_triangle_uses_do_not_count") {
  base::WorkerPool pool(1);
  mesh::Surface model = cube();
  const auto before = cages::closeness(stretched(cube(), {2, 2, 2}), model, pool);
  model.positions.push_back({1.99, 0, 0});
  const auto after = cages::closeness(stretched(cube(), {2, 2, 2}), model, pool);
  CHECK(after.least == before.least);
  CHECK(after.mean == before.mean);
}
