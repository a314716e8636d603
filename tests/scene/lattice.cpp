// Boxes side by side as a surface: closed, outward, corners shared.
#include "scene/pictures/lattice.h"

#include <doctest/doctest.h>

#include "deform/cage.h"

using namespace viete;
using scene::even, scene::lattice_surface;

namespace {

double volume_of(const mesh::Surface& s) {
  double sum = 0;
  for (const auto& [a, b, c] : s.triangles)
    sum += mesh::dot(s.positions[a], mesh::cross(s.positions[b], s.positions[c])) / 6;
  return sum;
}

}  // namespace

TEST_CASE("a_lattice_is_closed_and_outward_with_shared_corners") {
  const mesh::Surface bar = lattice_surface({even(-3, 3, 6), even(-1, 1, 2), {0, 0.5, 3}});
  CHECK(bar.positions.size() == 7 * 3 * 3 - 5);  // all but those inside
  CHECK(bar.polygon_count() == 2 * (6 * 2 + 6 * 2 + 2 * 2));
  CHECK(volume_of(bar) == doctest::Approx(6 * 2 * 3));
  CHECK(deform::make_cage(bar).closed);
}

TEST_CASE("cells_that_are_not_filled_are_left_out") {
  const auto fork = [](int x, int y, int) { return x == 0 || y != 1; };
  const mesh::Surface surface = lattice_surface({even(0, 3, 3), even(0, 3, 3), even(0, 1, 1)}, fork);
  CHECK(volume_of(surface) == doctest::Approx(7));
  const deform::Cage cage = deform::make_cage(surface);
  CHECK(cage.closed);
  CHECK(cage.roots.size() == 1);
  const auto ends = [](int x, int, int) { return x != 1; };
  CHECK(
      deform::make_cage(lattice_surface({even(0, 3, 3), even(0, 1, 1), even(0, 1, 1)}, ends)).roots.size() ==
      2);
}

TEST_CASE("even_steps_end_where_they_should") {
  CHECK(even(-3.2, 3.2, 3).front() == -3.2);
  CHECK(even(-3.2, 3.2, 3).back() == 3.2);
  CHECK(even(0, 1, 4) == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
}
