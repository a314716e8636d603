#include "app/assets.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "mesh/formats/read.h"

using namespace viete;

TEST_CASE("the_bundled_model_has_poses_of_its_cage_in_order_of_their_names") {
  const app::BundledModel bundled = app::bundled_model();
  const std::size_t vertices = mesh::read(bundled.cage).surface.positions.size();
  CHECK(bundled.poses.size() == 3);
  CHECK(std::is_sorted(bundled.poses.begin(), bundled.poses.end()));
  for (const auto& pose : bundled.poses) CHECK(mesh::read(pose).surface.positions.size() == vertices);
}
