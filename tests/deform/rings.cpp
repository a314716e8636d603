#include "deform/rings.h"

#include <doctest/doctest.h>

#include "deform/shapes.h"

using namespace viete::test;

TEST_CASE("walks_around_a_closed_surface_are_rings_or_end_where_they_began") {
  const auto model = tube(40, 20, 0.3, 1);
  std::vector<std::uint32_t> counts(model.positions.size());
  for (const auto& t : model.triangles) {
    for (const auto v : t) ++counts[v];
  }
  const Leaves leaves = make_leaves(model.positions, counts);
  const Rings rings = make_rings(leaves, model.triangles);
  REQUIRE(rings.places.size() == leaves.count() + 1);
  std::size_t at = 0, closed_groups = 0;
  for (std::size_t group = 0; group < rings.lengths.size(); ++group) {
    const std::size_t length = rings.lengths[group] % closed_ring;
    const bool closed = rings.lengths[group] >= closed_ring;
    closed_groups += closed;
    CHECK((closed || length % 2 == 1));
    for (std::size_t k = 0; k < ring_group; ++k) {
      const std::size_t s = ring_group * group + k, leaf = s / leaf_slots;
      const auto step = [&](std::size_t i) { return rings.walk[at + ring_group * i + k]; };
      const std::size_t ring = s < leaves.vertices ? counts[leaves.order[s]] : 0;
      if (closed) {
        CHECK(length == ring);
        continue;
      }
      REQUIRE(ring < length);
      if (ring > 0) CHECK(step(0) == step(ring));
      for (std::size_t i = ring > 0 ? ring + 1 : 0; i < length; ++i)
        CHECK(step(i) == 4 / walk_floats * (s - leaves.begin(leaf)));
    }
    at += ring_group * length;
  }
  CHECK(at == rings.walk.size());
  CHECK(2 * closed_groups > rings.lengths.size());
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
      CHECK(rings.walk[i] < 4 / walk_floats * (end - first));
  }
}
