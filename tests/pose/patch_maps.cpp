#include "pose/patch_maps.h"

#include "deform/bound.h"
#include "pose/all_maps.h"

using namespace viete;
using namespace viete::test;

namespace {

std::vector<AffineMap> patch_maps_of(const Cage& cage, std::span<const mesh::Point> posed) {
  std::vector<AffineMap> maps(posed.size());
  VertexPatches(cage, cage.size).compute(posed, pose_origin(cage, posed), first(maps.size()), maps);
  return maps;
}

std::vector<mesh::Surface> solid_cages() {
  return {box({1, 1.1, 1.2}), box({1, 1, 0.02}), tube(9, 7, 0.4, 2.2), tube(40, 24, 0.5, 8),
          together(box(), box({0.3, 0.3, 2}))};
}

}  // namespace

TEST_CASE("an_affine_pose_is_the_map_of_every_patch") {
  for (const auto& surface : solid_cages())
    for (const double size : {1e-30, 1.0, 1e30}) {
      const auto scaled = mapped(surface, scaling(size));
      const Cage cage = make_cage(scaled);
      Affine map = shear();
      map.shift = size * map.shift;
      for (const auto& m : patch_maps_of(cage, mapped(scaled.positions, map)))
        CHECK(largest_difference(m.linear, map.linear) < 2e-13);
    }
}

TEST_CASE("patches_are_least_squares_fits_weighted_by_distance") {
  Random random(4);
  const Cage cage = make_cage(tube(9, 7, 0.4, 2.2));
  const auto& rest = cage.surface.positions;
  auto posed = mapped(rest, shear());
  for (auto& p : posed) p = p + random.vector(0.3);
  const VertexPatches patches(cage, cage.size);
  const auto maps = patch_maps_of(cage, posed);
  for (std::uint32_t v = 0; v < maps.size(); ++v) {
    sym3::Mat3<double> slope{};  // sum w * (p' - c' - M * (p - c)) * (p - c)^T
    for (const auto& member : patches.members(v)) {
      const Vec3 x = rest[member.vertex] - rest[v];
      const Vec3 off = posed[member.vertex] - posed[v] - times(maps[v].linear, x);
      const double w = 1 / (std::pow(0.03 * cage.size, 2) + squared_norm(x));
      for (std::size_t i = 0; i < 9; ++i) slope[i] += w * off[i / 3] * x[i % 3];
    }
    for (const double s : slope) CHECK(std::abs(s) < 1e-10);
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
    CHECK(largest_difference(m.linear, map.linear) < 1e-14);
}

TEST_CASE("patches_are_one_ring_on_round_cages_and_grow_on_flat_sides") {
  const Cage round = make_cage(tube(12, 8, 1, 2)), far = make_cage(tube(2, 400, 1, 1));
  CHECK(VertexPatches(round, round.size).members(40).size() == 7);
  const VertexPatches patches(far, far.size);
  for (std::size_t v = 0; v < far.surface.positions.size(); ++v)
    CHECK(patches.members(v).size() <= 256 + 800);
}
