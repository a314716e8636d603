#include <doctest/doctest.h>
#include <set>

#include "support/caged_shapes.h"
#include "weights/leaves.h"

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
    for (std::size_t leaf = 0; leaf < leaves.count(); ++leaf)
      for (std::size_t s = leaves.begin(leaf) + 1; s < std::min(n, leaves.end(leaf)); ++s)
        CHECK(triangles[leaves.order[s - 1]] <= triangles[leaves.order[s]]);
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

TEST_CASE("neighbours_on_a_closed_surface_form_rings_or_end_where_they_began") {
  const auto model = tube(40, 20, 0.3, 1);
  std::vector<std::uint32_t> counts(model.positions.size());
  for (const auto& t : model.triangles)
    for (const auto v : t) ++counts[v];
  const Leaves leaves = make_leaves(model.positions, counts);
  const Rings rings = make_rings(leaves, model.triangles);
  REQUIRE(rings.position_starts.size() == leaves.count() + 1);
  std::size_t at = 0, closed_groups = 0;
  for (std::size_t group = 0; group < rings.lengths.size(); ++group) {
    const std::size_t length = rings.lengths[group] % closed_ring;
    const bool closed = rings.lengths[group] >= closed_ring;
    closed_groups += closed;
    CHECK((closed || length % 2 == 1));
    for (std::size_t k = 0; k < ring_group; ++k) {
      const std::size_t s = ring_group * group + k, leaf = s / leaf_slots;
      const auto neighbour = [&](std::size_t i) { return rings.neighbours[at + ring_group * i + k]; };
      const std::size_t ring = s < leaves.vertices ? counts[leaves.order[s]] : 0;
      if (closed) {
        CHECK(length == ring);
        continue;
      }
      REQUIRE(ring < length);
      if (ring > 0) CHECK(neighbour(0) == neighbour(ring));
      for (std::size_t i = ring > 0 ? ring + 1 : 0; i < length; ++i)
        CHECK(neighbour(i) == 4 / index_floats * (s - leaves.begin(leaf)));
    }
    at += ring_group * length;
  }
  CHECK(at == rings.neighbours.size());
  CHECK(2 * closed_groups > rings.lengths.size());
  CHECK(rings.high_valence.empty());
}

TEST_CASE("leaf_positions_fit_16_bits_for_any_number_of_fans") {
  constexpr std::uint32_t centers = leaf_slots, fans = 40;
  Leaves leaves;
  leaves.vertices = centers * (1 + 2 * fans);
  std::vector<viete::mesh::Triangle> triangles;
  for (std::uint32_t v = 0; v < leaves.vertices; ++v) leaves.order.push_back(v);
  for (std::uint32_t v = centers; v < leaves.vertices; v += 2)
    triangles.push_back({(v - centers) / (2 * fans), v, v + 1});
  const Rings rings = make_rings(leaves, triangles);
  for (std::size_t leaf = 0; leaf < leaves.count(); ++leaf)
    CHECK(rings.position_starts[leaf + 1] - rings.position_starts[leaf] <= 1u << 15);
  CHECK(rings.high_valence.size() == centers);
}

TEST_CASE("ghosts_are_the_neighbours_in_other_leaves") {
  const auto model = tube(40, 20, 0.3, 1);
  const Leaves leaves = make_leaves(model.positions, std::vector<std::uint32_t>(model.positions.size(), 6));
  const Rings rings = make_rings(leaves, model.triangles);
  CHECK(rings.position_count() == leaves.slot_count() + rings.ghosts.size());
  CHECK(rings.ghosts.size() > 0);
  CHECK(rings.ghosts.size() < leaves.vertices / 3);
  for (std::size_t leaf = 0; leaf < leaves.count(); ++leaf) {
    const std::size_t first = rings.position_starts[leaf], end = rings.position_starts[leaf + 1];
    for (std::size_t i = first - leaves.begin(leaf); i < end - leaves.end(leaf); ++i)
      CHECK((rings.ghosts[i] < first || rings.ghosts[i] >= end));
    for (auto i = rings.neighbour_starts[leaf]; i < rings.neighbour_starts[leaf + 1]; ++i)
      CHECK(rings.neighbours[i] < 4 / index_floats * (end - first));
  }
}
