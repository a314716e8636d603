#include "deform/patch_maps.h"

#include <doctest/doctest.h>

#include "deform/all_maps.h"
#include "deform/binding.h"
#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

namespace {

std::vector<AffineMap> patch_maps_of(const Cage& cage, std::span<const mesh::Point> posed) {
  std::vector<AffineMap> maps(posed.size());
  VertexPatches(cage, cage.size).compute(posed, pose_origin(cage, posed), first(maps.size()), maps);
  return maps;
}

double patch_difference(const AffineMap& map, const Affine& affine) {
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(map.linear[i] - affine.linear[i]));
  return largest;
}

std::vector<mesh::Surface> solid_cages() {
  return {box({1, 1.1, 1.2}), box({1, 1, 0.02}), tube(9, 7, 0.4, 2.2), tube(40, 24, 0.5, 8),
          together(box(), box({0.3, 0.3, 2}))};
}

}  // namespace

TEST_CASE("an_affine_pose_is_the_map_of_every_patch") {
  for (const auto& surface : solid_cages()) {
    for (const double size : {1e-30, 1.0, 1e30}) {
      auto scaled = surface;
      for (auto& p : scaled.positions) p = size * p;
      const Cage cage = make_cage(scaled);
      Affine map = shear();
      map.shift = size * map.shift;
      for (const auto& m : patch_maps_of(cage, mapped(scaled.positions, map)))
        CHECK(patch_difference(m, map) < 2e-13);
    }
  }
}

TEST_CASE("unmoved_patches_and_vertices_of_no_polygon_have_exactly_the_identity") {
  auto surface = tube(9, 7, 0.4, 2.2);
  const std::size_t moved = surface.positions.size() - 1;
  surface.positions.push_back({0, 0, 3});
  const Cage cage = make_cage(surface);
  auto posed = surface.positions;
  posed[moved][2] += 0.3;
  const VertexPatches patches(cage, cage.size);
  const auto maps = patch_maps_of(cage, posed);
  std::size_t still = 0;
  for (std::size_t e = 0; e < maps.size(); ++e) {
    if (std::ranges::any_of(patches.members(e), [&](const auto& m) { return m.vertex == moved; })) continue;
    ++still;
    CHECK(maps[e].linear == sym3::Mat3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  }
  CHECK(patches.members(moved + 1).empty());
  CHECK(still > maps.size() / 2);
  CHECK(still < maps.size());
}

TEST_CASE("a_flat_cage_takes_its_normals_and_follows_similarities") {
  const auto plane =
      mesh::from_triangles({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Cage cage = make_cage(plane);
  const auto map = similarity({1, -2, 3}, 2.5, 3, {1, 2, 3});
  for (const auto& m : patch_maps_of(cage, mapped(plane.positions, map)))
    CHECK(patch_difference(m, map) < 1e-14);
}

TEST_CASE("patches_are_one_ring_on_round_cages_and_grow_on_flat_sides") {
  const Cage round = make_cage(tube(12, 8, 1, 2)), far = make_cage(tube(2, 400, 1, 1));
  CHECK(VertexPatches(round, round.size).members(40).size() == 7);
  const VertexPatches patches(far, far.size);
  for (std::size_t v = 0; v < far.surface.positions.size(); ++v)
    CHECK(patches.members(v).size() <= 256 + 800);
}

TEST_CASE("dragging_a_vertex_updates_its_patches_with_the_bits_of_a_full_frame") {
  const auto cage = std::make_shared<const Cage>(make_cage(tube(12, 8, 0.5, 3)));
  CageState dragged(cage, Elements::point, RowForm::maps);
  Pose pose = rest_pose(*cage);
  dragged.set_pose(pose);
  const std::uint32_t vertex[] = {40};
  dragged.begin_drag(vertex);
  CHECK(dragged.moving().size() > 6);
  CHECK(dragged.moving().size() < pose.positions.size() / 3);
  for (int step = 1; step <= 3; ++step) {
    pose.positions[40][0] += 0.05;
    dragged.set_pose(pose);
  }
  CageState whole(cage, Elements::point, RowForm::maps);
  whole.set_pose(pose);
  CHECK(std::ranges::equal(dragged.rows().values, whole.rows().values));
}
