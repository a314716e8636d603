#include "deform/element_maps.h"

#include <doctest/doctest.h>

#include <set>

#include "deform/bound.h"
#include "deform/maps.h"
#include "mesh/triangulation.h"
#include "deform/all_element_maps.h"

using namespace viete;
using namespace viete::test;

namespace {

std::vector<Elements> all_affine() {
  std::vector<Elements> all;
  for (const auto& e : all_elements()) {
    if (e.affine) all.push_back(e.value);
  }
  return all;
}

// A cube of six quads, cut along other diagonals where `turned`.
using Polygons = std::vector<std::vector<std::uint32_t>>;

mesh::Surface of_polygons(std::vector<mesh::Point> positions, const Polygons& polygons) {
  mesh::Surface s;
  s.positions = std::move(positions);
  s.polygon_starts.push_back(0);
  for (const auto& polygon : polygons) {
    s.corners.insert(s.corners.end(), polygon.begin(), polygon.end());
    s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
  }
  triangulate(s);
  return s;
}

std::vector<mesh::Point> box_corners() {
  std::vector<mesh::Point> positions;
  for (int i = 0; i < 8; ++i) positions.push_back({1.0 * (i & 1), 1.1 * (i >> 1 & 1), 1.2 * (i >> 2)});
  return positions;
}

mesh::Surface quad_box(bool turned) {
  Polygons quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (auto& quad : quads) std::ranges::rotate(quad, quad.begin() + turned);
  return of_polygons(box_corners(), quads);
}

double difference(const AffineMap& a, const sym3::Mat3<double>& linear) {
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a.linear[i] - linear[i]));
  return largest;
}

double sum_of_shares(const ElementMaps& maps, std::size_t handle) {
  double sum = 0;
  for (std::size_t m = 0; m < maps.count(); ++m) sum += maps.owners()[m] == handle ? maps.shares()[m] : 0;
  return sum;
}

}  // namespace

TEST_CASE("every_element_has_maps_whose_shares_sum_to_one_and_every_map_neighbours") {
  for (const auto& surface : {tube(9, 7, 0.4, 2.2), quad_box(false), together(box(), tube(5, 4, 1, 1))}) {
    const Cage cage = make_cage(surface);
    for (const Elements e : all_affine()) {
      CAPTURE(entry(e).name);
      const auto maps = element_maps(cage, e);
      for (std::size_t h = 0; h < handle_count(cage, e); ++h)
        CHECK(sum_of_shares(*maps, h) == doctest::Approx(1));
      CHECK(std::ranges::is_sorted(maps->owners()));
      CHECK(maps->graph().roots.size() == cage.roots.size());
      CHECK(maps->graph().part_of == maps->graph().component_of);
      std::set<std::uint32_t> linked;
      for (const auto& [a, b] : maps->graph().edges) linked.insert(a), linked.insert(b);
      CHECK(linked.size() == maps->count());
    }
  }
}

TEST_CASE("all_maps_follow_similarities_and_are_exactly_the_identity_where_nothing_moved") {
  const auto map = similarity({1, -2, 3}, 2.5, 3, {1, 2, 3});
  for (const auto& surface : {tube(9, 7, 0.4, 2.2), quad_box(true), box({1, 1, 0.01})}) {
    for (const double size : {1e-30, 1.0, 1e30}) {
      auto scaled = surface;
      for (auto& p : scaled.positions) p = size * p;
      const Cage cage = make_cage(scaled);
      for (const Elements e : all_affine()) {
        CAPTURE(entry(e).name);
        const auto maps = element_maps(cage, e);
        const auto moved = [&](const Vec3& x) { return size * map((1 / size) * x); };
        for (const auto& m : maps_of(cage, *maps, mapped(scaled.positions, moved)))
          CHECK(difference(m, map.linear) < 1e-11);
        for (const auto& m : maps_of(cage, *maps, scaled.positions))
          CHECK(difference(m, {1, 0, 0, 0, 1, 0, 0, 0, 1}) == 0);
      }
    }
  }
}

TEST_CASE("a_map_moves_with_its_vertices_and_with_no_other") {
  for (const auto& surface : {tube(9, 7, 0.4, 2.2), quad_box(false)}) {
    const Cage cage = make_cage(surface);
    for (const Elements e : all_affine()) {
      CAPTURE(entry(e).name);
      const auto maps = element_maps(cage, e);
      const auto rest = maps_of(cage, *maps, surface.positions);
      for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
        auto posed = surface.positions;
        // Little enough to leave the pose's origin where it is.
        posed[v] = posed[v] + Vec3{0.01, 0.02, 0.03};
        const auto now = maps_of(cage, *maps, posed);
        for (std::size_t m = 0; m < now.size(); ++m) {
          const auto list = maps->vertices(m);
          if (std::ranges::find(list, v) == list.end()) CHECK(difference(now[m], rest[m].linear) == 0);
        }
      }
    }
  }
}

TEST_CASE("quads_are_taken_alike_however_they_are_cut") {
  const Cage cage = make_cage(quad_box(false)), turned = make_cage(quad_box(true));
  auto posed = cage.surface.positions;
  posed[7] = posed[7] + Vec3{0.3, 0.1, -0.2};
  for (const Elements e :
       {Elements::edge, Elements::vertex, Elements::vertex_face, Elements::vertex_patch, Elements::polygon}) {
    CAPTURE(entry(e).name);
    CageState a(std::make_shared<const Cage>(cage), e, Blend::srl);
    CageState b(std::make_shared<const Cage>(turned), e, Blend::srl);
    a.set_pose({posed, {}}), b.set_pose({posed, {}});
    REQUIRE(a.rows().values.size() == b.rows().values.size());
    for (std::size_t i = 0; i < a.rows().values.size(); ++i)
      CHECK(std::abs(a.rows().values[i] - b.rows().values[i]) < 1e-14);
  }
}

TEST_CASE("a_model_in_quads_moves_alike_however_they_are_cut") {
  const auto model = tube(20, 12, 0.3, 1.5);
  for (const Blend blend : {Blend::srl, Blend::log4, Blend::linear}) {
    const Weighting weighting{Elements::polygon, Weights::integrated};
    Bound a(model, quad_box(false), weighting, 2, blend), b(model, quad_box(true), weighting, 2, blend);
    auto posed = a.cage->surface.positions;
    for (std::size_t v = 0; v < posed.size(); ++v)
      posed[v] =
          posed[v] + Vec3{0.3 * std::sin(double(v)), 0.2 * std::cos(3.0 * double(v)), 0.1 * double(v % 3)};
    const auto one = a.deform({posed, {}}), other = b.deform({posed, {}});
    CHECK(largest_distance(one, other) < 1e-12);
    CHECK(largest_distance(one, model.positions) > 0.1);
  }
  // Of triangles polygons are faces.
  const auto cage = tube(9, 7, 0.5, 2);
  Bound a(model, cage, {Elements::polygon, Weights::inverse}),
      b(model, cage, {Elements::face, Weights::inverse});
  const Twist twist{2, {0, 0, 0}, -1, 1, 0, 150 * degree};
  CHECK(largest_distance(a.deform(a.pose(twist)), b.deform(b.pose(twist))) < 1e-13);
}

namespace {

// A U whose two caps are concave polygons, each begun at another corner.
mesh::Surface u_cage(std::uint32_t first) {
  const double outline[8][2] = {{0, 0}, {6, 0}, {6, 4}, {4, 4}, {4, 1.5}, {2, 1.5}, {2, 4}, {0, 4}};
  std::vector<mesh::Point> positions;
  for (const double z : {-0.6, 0.6}) {
    for (const auto& p : outline) positions.push_back({p[0], p[1], z});
  }
  Polygons polygons(2);
  for (std::uint32_t i = 0; i < 8; ++i) {
    polygons[0].push_back(7 - (i + first) % 8), polygons[1].push_back(8 + (i + first) % 8);
    const std::uint32_t next = (i + 1) % 8;
    polygons.push_back({i, next, 8 + next, 8 + i});
  }
  return of_polygons(positions, polygons);
}

mesh::Surface moved(mesh::Surface surface, const Vec3& by) {
  for (auto& p : surface.positions) p = p + by;
  return surface;
}

}  // namespace

TEST_CASE("concave_polygons_are_taken_nearly_alike_wherever_they_begin_and_follow_similarities") {
  const auto model = moved(tube(20, 12, 0.3, 3), {1, 2, 0});
  for (const Weights weights : {Weights::integrated, Weights::inverse}) {
    const Weighting weighting{Elements::polygon, weights};
    Bound first(model, u_cage(0), weighting);
    auto posed = first.cage->surface.positions;
    for (std::size_t v = 0; v < posed.size(); ++v)
      posed[v] = posed[v] + Vec3{0.3 * std::sin(double(v)), 0.2 * std::cos(3.0 * double(v)), 0.1};
    CHECK(first.error(similarity({1, 2, 3}, 2, 1.5)) < 1e-13);
    const auto one = first.deform({posed, {}});
    CHECK(largest_distance(one, model.positions) > 0.1);
    for (std::uint32_t begin = 1; begin < 8; ++begin) {
      Bound other(model, u_cage(begin), weighting);
      // Cut elsewhere, its triangles have other corners of the polygon.
      CHECK(largest_distance(one, other.deform({posed, {}})) < 0.1);
      CHECK(other.error(similarity({1, 2, 3}, 2, 1.5)) < 1e-13);
    }
  }
}

TEST_CASE("the_other_arm_of_a_concave_cage_stays_where_it_is") {
  const auto left = moved(tube(20, 12, 0.3, 2), {1, 2.5, 0});
  const Weighting polygon_integrals{Elements::polygon, Weights::integrated};
  for (const Weighting& weighting : {face_integrals, polygon_integrals, mean_values}) {
    for (std::uint32_t first = 0; first < 8; ++first) {
      Bound b(left, u_cage(first), weighting, 2,
              weighting.elements == Elements::point ? Blend::linear : Blend::srl);
      auto posed = b.cage->surface.positions;
      for (const std::size_t v : {2, 3, 10, 11}) posed[v][0] += 2.5;  // the end of the right arm
      CHECK(largest_distance(b.deform({posed, {}}), left.positions) < 0.05);
    }
  }
}

TEST_CASE("corners_in_the_middle_of_a_side_do_not_count") {
  auto positions = box_corners();
  positions.push_back({0, 0.55, 0});  // between 0 and 2
  const auto surface = of_polygons(
      positions, {{0, 8, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2, 8}, {1, 3, 7, 5}});
  const Cage cage = make_cage(surface);
  const auto maps = element_maps(cage, Elements::polygon);
  for (std::size_t m = 0; m < maps->count(); ++m) CHECK(maps->graph().skipped[m] == 0);
  Bound b(tube(20, 12, 0.3, 1.5), surface, {Elements::polygon, Weights::inverse});
  CHECK(b.error(similarity({1, 2, 3}, 2, 1.5)) < 1e-13);
}

TEST_CASE("uniform_scaling_stretches_every_direction_alike") {
  const Cage cage = make_cage(quad_box(false));
  for (const Elements e : all_affine()) {
    CageState state(std::make_shared<const Cage>(cage), e, Blend::srl);
    state.set_pose({mapped(cage.surface.positions, [](const Vec3& x) { return 10.0 * x; }), {}});
    for (std::size_t h = 0; h < state.rows().count(); ++h) {
      const double* x = state.rows().values.data() + h * state.rows().columns();
      for (const int diagonal : {0, 3, 5}) CHECK(x[diagonal] == doctest::Approx(std::log(10)));
      for (const int across : {1, 2, 4}) CHECK(std::abs(x[across]) < 1e-12);
    }
  }
}

TEST_CASE(
    "cages_whose_parts_touch_at_a_vertex_are_one_component_of_vertices_and_keep_the_turns_of_each_part") {
  // Two tetrahedra that share vertex 0.
  const Cage cage = make_cage(mesh::from_triangles(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}}));
  REQUIRE(cage.roots.size() == 2);
  const auto maps = element_maps(cage, Elements::vertex_patch);
  CHECK(maps->graph().roots.size() == 1);
  CHECK(maps->graph().component_of == std::vector<std::uint32_t>{0, 0});
  CageState state(std::make_shared<const Cage>(cage), Elements::vertex_patch, Blend::srl);
  std::vector<Vec3> turns;
  for (int a = 0; a <= 720; a += 20) {
    const auto map = similarity({0, 0, 1}, a * degree);
    state.set_pose({mapped(cage.surface.positions, map), turns});
    turns = state.report().turns;
    REQUIRE(turns.size() == 2);
    for (const auto& turn : turns) CHECK(norm(turn) == doctest::Approx(a * degree).epsilon(1e-9));
  }
}

TEST_CASE("vertices_of_no_polygon_have_no_map_and_no_weight") {
  auto surface = tube(9, 7, 0.4, 2.2);
  surface.positions.push_back({0.1, 0.2, 0.3});
  for (const Elements e : {Elements::vertex, Elements::vertex_face, Elements::vertex_patch}) {
    Bound b(tube(5, 5, 0.2, 1), surface, {e, Weights::inverse});
    Pose pose = rest_pose(*b.cage);
    pose.positions.back() = {5, 6, 7};
    CHECK(largest_distance(b.deform(pose), b.model.positions) < 1e-14);
  }
}
