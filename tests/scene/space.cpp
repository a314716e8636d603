#include "scene/document/space.h"

#include <doctest/doctest.h>

using namespace viete;

TEST_CASE("every_model_has_diagonal_two_in_view_wherever_it_is_and_however_large") {
  for (const double size : {1e-30, 1.0, 1e30}) {
    for (const double offset : {0.0, 1e7}) {
      const mesh::Bounds box{{offset * size, 0, 0}, {(offset + 3) * size, 4 * size, 0}};
      const auto space = scene::space_for(box);
      const glm::vec3 a = space.to_view(box.low), b = space.to_view(box.high);
      CHECK(glm::distance(a, b) == doctest::Approx(2).epsilon(1e-6));
      CHECK(glm::length(a + b) < 1e-6f);
    }
  }
}

TEST_CASE("a_single_point_still_has_a_space") {
  const auto space = scene::space_for({{1, 2, 3}, {1, 2, 3}});
  CHECK(space.to_view({1, 2, 3}) == glm::vec3(0));
}

TEST_CASE("grid_cell_is_a_round_number_that_suits_the_model") {
  CHECK(scene::grid_cell(20) == doctest::Approx(1));
  CHECK(scene::grid_cell(2.9) == doctest::Approx(0.1));
  CHECK(scene::grid_cell(90) == doctest::Approx(5));
  CHECK(scene::grid_cell(1e-6) == doctest::Approx(5e-8));
  CHECK(scene::grid_cell(0) == 1);
}
