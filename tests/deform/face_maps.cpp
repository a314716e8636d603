#include "deform/maps.h"

#include <doctest/doctest.h>

#include "deform/shapes.h"

using namespace viete::test;

namespace {

Vec3 apply_map(const AffineMap& map, const Vec3& x) {
  return Affine{map.linear, map.center}(x);
}

const viete::sym3::Mat3<double> unmoved = {1, 0, 0, 0, 1, 0, 0, 0, 1};

}  // namespace

TEST_CASE("unmoved_elements_have_exactly_the_identity") {
  const Cage cage = make_cage(tube(9, 7, 0.31, 2.3));
  for (const auto& map : maps_of(cage, cage.surface.positions)) CHECK(map.linear == unmoved);
}

TEST_CASE("a_map_takes_the_corners_of_its_element_to_their_posed_places") {
  const Cage cage = make_cage(box({1, 2, 3}));
  Random random(7);
  auto posed = cage.surface.positions;
  for (auto& p : posed) p = p + random.vector(0.5);
  const auto maps = maps_of(cage, posed);
  const Vec3 origin = pose_origin(cage, posed);
  for (std::size_t e = 0; e < maps.size(); ++e) {
    for (const auto v : cage.surface.triangles[e]) {
      const Vec3 image = apply_map(maps[e], cage.surface.positions[v] - cage.centers[e]) + origin;
      CHECK(norm(image - posed[v]) < 1e-14);
    }
  }
}

TEST_CASE("a_similarity_is_reproduced_off_the_plane_too") {
  const Cage cage = make_cage(box({1, 2, 3}));
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const auto map = similarity({1, -1, 2}, 2.2, scale, {scale, 0, 0});
    for (const auto& m : maps_of(cage, mapped(cage.surface.positions, map))) {
      for (int i = 0; i < 9; ++i) CHECK(std::abs(m.linear[i] - map.linear[i]) < 1e-13 * scale);
    }
  }
}

TEST_CASE("orientation_of_an_element_does_not_change_its_map") {
  auto t = box().triangles;
  for (auto& x : t) std::swap(x[1], x[2]);
  const Cage cage = make_cage(box()), turned = make_cage(viete::mesh::from_triangles(box().positions, t));
  const auto posed = mapped(cage.surface.positions, shear());
  const auto a = maps_of(cage, posed), b = maps_of(turned, posed);
  for (std::size_t e = 0; e < a.size(); ++e) {
    for (int i = 0; i < 9; ++i) CHECK(std::abs(a[e].linear[i] - b[e].linear[i]) < 1e-14);
  }
}

TEST_CASE("length_scales_from_1e-30_to_1e30_give_the_same_maps") {
  const auto unit = make_cage(box({1, 2, 3}));
  const auto expected = maps_of(unit, mapped(unit.surface.positions, shear()));
  for (const double s : {1e-30, 1e30}) {
    const Cage cage = make_cage(box({s, 2 * s, 3 * s}));
    Affine map = shear();
    map.shift = s * map.shift;
    const auto maps = maps_of(cage, mapped(cage.surface.positions, map));
    for (std::size_t e = 0; e < maps.size(); ++e) {
      for (int i = 0; i < 9; ++i) CHECK(std::abs(maps[e].linear[i] - expected[e].linear[i]) < 1e-13);
    }
  }
}

TEST_CASE("elements_without_area_have_defined_maps") {
  const auto surface =
      viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
  const Cage cage = make_cage(surface);
  auto posed = surface.positions;
  CHECK(maps_of(cage, posed)[1].linear == unmoved);
  posed.assign(4, {5, 5, 5});
  const auto maps = maps_of(cage, posed);
  CHECK(maps[0].linear == viete::sym3::Mat3<double>{});
  CHECK(maps[1].linear == unmoved);
}
