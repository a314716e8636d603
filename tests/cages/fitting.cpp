// Fitting cages to models.
#include <doctest/doctest.h>

#include "cages/enclose.h"
#include "cages/models.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr double margin = 0.01;

}  // namespace

TEST_CASE("fitted_cage_encloses_the_box_with_the_same_shape") {
  const Surface model = stool(), cage = stretched(torus(8, 6), {3, 2, 0.5}, {10, -20, 5});
  const mesh::Bounds box = mesh::used_bounds(model);
  const cages::Fitted fitted = cages::fitted_to_box(cage, model, margin);
  const mesh::Bounds now = mesh::bounds(fitted.positions);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(now.high[k] - now.low[k] >=
          doctest::Approx(box.high[k] - box.low[k] + 2 * margin * box.diagonal()));
    CHECK(0.5 * (now.high[k] + now.low[k]) == doctest::Approx(box.center()[k]));
  }
  for (std::size_t v = 1; v < cage.positions.size(); ++v) {
    const Point way = fitted.scale * (cage.positions[v] - cage.positions[0]);
    CHECK(mesh::norm(fitted.positions[v] - fitted.positions[0] - way) < 1e-9);
  }
}
