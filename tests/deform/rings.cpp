#include "deform/rings.h"

#include <doctest/doctest.h>

#include "deform/shapes.h"

using namespace viete::test;

TEST_CASE("walks_around_a_closed_surface_end_where_they_began") {
  const auto model = tube(40, 20, 0.3, 1);
  std::vector<std::uint32_t> counts(model.positions.size());
  for (const auto& t : model.triangles) {
    for (const auto v : t) ++counts[v];
  }
  const Leaves leaves = make_leaves(model.positions, counts);
  const Rings rings = make_rings(leaves, model.triangles);
  REQUIRE(rings.places.size() == leaves.count() + 1);
  std::size_t at = 0;
  for (std::size_t s = 0; s < leaves.slot_count(); ++s) {
    if (s >= leaves.vertices) {
      CHECK(rings.lengths[s] == 0);
      continue;
    }
    CHECK(rings.lengths[s] == counts[leaves.order[s]] + 1u);
    CHECK(rings.walk[at] == rings.walk[at + rings.lengths[s] - 1]);
    at += rings.lengths[s];
  }
  CHECK(at == rings.walk.size());
  CHECK(rings.hubs.empty());
}

TEST_CASE("the_halo_of_a_leaf_is_what_its_walks_need_of_others") {
  const auto model = tube(40, 20, 0.3, 1);
  const Leaves leaves = make_leaves(model.positions, std::vector<std::uint32_t>(model.positions.size(), 6));
  const Rings rings = make_rings(leaves, model.triangles);
  CHECK(rings.place_count() == leaves.slot_count() + rings.halo.size());
  CHECK(rings.halo.size() > 0);
  CHECK(rings.halo.size() < leaves.vertices / 3);
  for (std::size_t leaf = 0; leaf < leaves.count(); ++leaf) {
    const std::size_t first = rings.places[leaf], end = rings.places[leaf + 1];
    for (std::size_t i = first - leaves.begin(leaf); i < end - leaves.end(leaf); ++i)
      CHECK((rings.halo[i] < first || rings.halo[i] >= end));
    for (auto i = rings.walk_starts[leaf]; i < rings.walk_starts[leaf + 1]; ++i)
      CHECK(rings.walk[i] < end - first);
  }
}
