// Boxes of cells.
#include <doctest/doctest.h>

#include "cages/make.h"
#include "cages/models.h"
#include "mesh/summary.h"

using namespace viete;
using namespace viete::test;

TEST_CASE("a_box_has_its_cells_on_every_side_and_its_margin_around") {
  base::WorkerPool pool(1);
  const auto made = cages::make(cube(), {.kind = cages::Kind::box, .margin = 0.1, .cells = {2, 3, 4}}, pool);
  CHECK(made.surface.polygon_count() == 2 * (2 * 3 + 3 * 4 + 2 * 4));
  CHECK(made.surface.triangles.size() == 2 * made.surface.polygon_count());
  const double side = 1 + 0.1 * 2 * std::sqrt(3.0);
  const mesh::Bounds box = mesh::bounds(made.surface.positions);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(box.low[k] == doctest::Approx(-side).epsilon(1e-14));
    CHECK(box.high[k] == doctest::Approx(side).epsilon(1e-14));
  }
}

TEST_CASE("a_box_along_own_axes_fits_a_turned_model_better") {
  base::WorkerPool pool(1);
  const mesh::Surface model = turned(stretched(cube(), {3, 1, 0.3}), 0.6);
  const auto volume = [&](bool own_axes) {
    return mesh::summarize(cages::make(model, {.kind = cages::Kind::box, .own_axes = own_axes}, pool).surface)
        .volume;
  };
  CHECK(volume(true) == doctest::Approx(8 * 3 * 1 * 0.3).epsilon(0.05));
  CHECK(volume(false) > 1.5 * volume(true));
}
