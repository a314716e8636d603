#include "mesh/point_index.h"

#include <doctest/doctest.h>

#include <map>
#include <random>

using namespace viete::mesh;

TEST_CASE("equal_points_share_an_index_and_others_do_not") {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> few(0, 19);
  PointIndex index;
  std::vector<Point> positions;
  std::map<Point, std::uint32_t> reference;
  for (int i = 0; i < 20000; ++i) {
    const Point p = {few(random) / 7.0, few(random) * 1e30, few(random) * 1e-30};
    const auto expected = reference.try_emplace(p, static_cast<std::uint32_t>(positions.size()));
    const std::uint32_t found = index.find_or_add(p, positions);
    REQUIRE(found == expected.first->second);
    if (found == positions.size()) positions.push_back(p);
  }
  CHECK(positions.size() == reference.size());
  CHECK(positions.size() > 5000);
}
