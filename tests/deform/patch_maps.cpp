#include "deform/patch_maps.h"

#include <doctest/doctest.h>

#include <set>

#include "deform/bound.h"
#include "deform/maps.h"
#include "deform/bind.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr Weighting patches{Elements::patch};

std::vector<AffineMap> patch_maps_of(const Cage& cage, std::span<const mesh::Point> posed) {
  return maps_of(cage, *face_patch_maps(cage, cage.size), posed);
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

TEST_CASE("a_patch_that_did_not_move_is_exactly_the_identity_and_so_are_triangles_without_area") {
  auto surface = tube(9, 7, 0.4, 2.2);
  surface.triangles.push_back({0, 0, 1});
  const Cage cage = make_cage(surface);
  auto posed = surface.positions;
  posed.back()[2] += 0.3;
  const auto elements = face_patch_maps(cage, cage.size);
  const auto maps = patch_maps_of(cage, posed);
  std::size_t still = 0;
  for (std::size_t e = 0; e < maps.size(); ++e) {
    const bool moves =
        std::ranges::any_of(elements->vertices(e), [&](auto v) { return v == posed.size() - 1; });
    if (moves) continue;
    ++still;
    CHECK(maps[e].linear == sym3::Mat3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  }
  CHECK(elements->graph().skipped.back() == 1);
  CHECK(maps.back().linear == sym3::Mat3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
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

TEST_CASE("a_patch_of_a_round_cage_is_its_ring_and_of_a_flat_side_it_grows_around_the_edge") {
  const auto distinct = [](const ElementMaps& elements, std::size_t map) {
    const auto v = elements.vertices(map);
    return std::set<std::uint32_t>(v.begin(), v.end()).size();
  };
  const Cage round = make_cage(tube(12, 8, 1, 2));
  CHECK(distinct(*face_patch_maps(round, round.size), 40) <= 12);
  CHECK(distinct(*vertex_patch_maps(round, round.size), 40) == 7);
  const Cage far = make_cage(tube(2, 400, 1, 1));
  for (const auto& elements : {face_patch_maps(far, far.size), vertex_patch_maps(far, far.size)}) {
    for (std::size_t e = 0; e < elements->count(); ++e) CHECK(distinct(*elements, e) <= 256 + 800);
  }
}

TEST_CASE("patches_move_every_vertex_by_an_affine_pose_in_both_engines_and_with_both_blends") {
  for (const auto& cage : solid_cages()) {
    const auto model = together(tube(12, 12, 0.3, 3), box({1, 1, 1}, {0.5, 0, 0}));
    for (const Blend blend : {Blend::srl, Blend::linear}) {
      Bound b(model, cage, patches, 2, blend);
      CHECK(b.error(shear()) < 1e-12);
      const auto tiled =
          std::make_shared<const Binding>(bind(model, *b.cage, patches, EngineKind::fused, nullptr, b.pool));
      Deformer fused(b.cage, tiled, {patches, blend}, b.pool);
      const Pose pose = b.pose(shear());
      fused.deform(pose, sym3::Method::fast);
      CHECK(largest_distance(fused.positions(), mapped(model.positions, shear())) <
            5e-6 * mesh::bounds(pose.positions).diagonal());
    }
  }
}

TEST_CASE("dragging_a_vertex_moves_the_patches_that_have_it_and_gives_the_bits_of_a_whole_frame") {
  const auto cage = std::make_shared<const Cage>(make_cage(tube(12, 8, 0.5, 3)));
  CageState dragged(cage, Elements::patch, Blend::srl);
  Pose pose = rest_pose(*cage);
  dragged.set_pose(pose);
  const std::uint32_t vertex[] = {40};
  dragged.begin_drag(vertex);
  CHECK(dragged.moving().size() > 6);
  CHECK(dragged.moving().size() < cage->element_count() / 3);
  for (int step = 1; step <= 3; ++step) {
    pose.positions[40][0] += 0.05;
    dragged.set_pose(pose);
  }
  CageState whole(cage, Elements::patch, Blend::srl);
  whole.set_pose(pose);
  CHECK(std::ranges::equal(dragged.rows().values, whole.rows().values));
}
