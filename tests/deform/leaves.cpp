#include "deform/leaves.h"

#include <doctest/doctest.h>

#include <set>

#include "deform/shapes.h"

using namespace viete::test;

TEST_CASE("leaves_hold_every_vertex_once_and_fill_the_last_one") {
  for (const std::size_t n : {1, 31, 32, 33, 512, 513, 5000}) {
    Random random(3);
    std::vector<viete::mesh::Point> points(n);
    std::vector<std::uint32_t> triangles(n);
    for (auto& p : points) p = random.vector(1);
    for (auto& t : triangles) t = static_cast<std::uint32_t>(random(3, 9));
    const Leaves leaves = make_leaves(points, triangles);
    CHECK(leaves.vertices == n);
    CHECK(leaves.slot_count() % slot_block == 0);
    CHECK(leaves.slot_count() < n + slot_block);
    CHECK(std::set<std::uint32_t>(leaves.order.begin(), leaves.order.begin() + std::ptrdiff_t(n)).size() ==
          n);
    for (std::size_t s = n; s < leaves.slot_count(); ++s) CHECK(leaves.order[s] == leaves.order[n - 1]);
    for (std::size_t leaf = 0; leaf < leaves.count(); ++leaf) {
      for (std::size_t s = leaves.begin(leaf) + 1; s < std::min(n, leaves.end(leaf)); ++s)
        CHECK(triangles[leaves.order[s - 1]] <= triangles[leaves.order[s]]);
    }
  }
}

TEST_CASE("leaves_are_small_boxes") {
  Random random(5);
  std::vector<viete::mesh::Point> points(64 * leaf_slots);
  for (auto& p : points) p = random.vector(1);
  const Leaves leaves = make_leaves(points, std::vector<std::uint32_t>(points.size(), 6));
  for (std::size_t leaf = 0; leaf < leaves.count(); ++leaf) {
    std::vector<viete::mesh::Point> inside;
    for (std::size_t s = leaves.begin(leaf); s < leaves.end(leaf); ++s)
      inside.push_back(points[leaves.order[s]]);
    CHECK(viete::mesh::bounds(inside).diagonal() < 0.3 * viete::mesh::bounds(points).diagonal());
  }
}
