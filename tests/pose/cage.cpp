#include <doctest/doctest.h>

#include <cstring>

#include "pose/all_maps.h"
#include "pose/cage.h"
#include "pose/cage_state.h"
#include "support/caged_shapes.h"

using namespace viete::test;

using viete::mesh::from_triangles;

TEST_CASE("a_closed_box_has_one_part_and_no_warnings_at_any_scale_and_two_boxes_have_two") {
  const Cage cage = make_cage(box());
  CHECK(cage.element_count() == 12);
  CHECK(cage.dual_edges.size() == 18);
  CHECK(cage.roots.size() == 1);
  CHECK(cage.closed);
  CHECK(cage.warnings.empty());
  CHECK(cage.diagonal == doctest::Approx(std::sqrt(12.0)));
  CHECK(rest_pose(cage).positions == cage.surface.positions);
  const Cage two = make_cage(together(box(), box({1, 1, 1}, {5, 0, 0})));
  REQUIRE(two.roots.size() == 2);
  CHECK(two.roots[0] < 12);
  CHECK(two.roots[1] >= 12);
  for (const double s : {1e-30, 1e30}) CHECK(make_cage(box({s, s, s})).warnings.empty());
}

TEST_CASE("a_cage_of_loose_triangles_that_meet_in_space_is_closed_and_one_part") {
  const Cage cage = make_cage(loose_triangles(box()));
  CHECK(cage.closed);
  CHECK(cage.roots.size() == 1);
  CHECK(cage.dual_edges == make_cage(box()).dual_edges);
}

TEST_CASE("open_misoriented_and_touching_cages_warn") {
  auto fewer = box().triangles, flipped = box().triangles;
  fewer.pop_back();
  std::swap(flipped[3][0], flipped[3][1]);
  for (const auto& [surface, warning] :
       {std::pair{from_triangles(box().positions, fewer), "3 cage edges have only one face"},
        {from_triangles(box().positions, flipped), "opposite orientation"},
        {together(box(), box({1, 1, 1}, {2, 2, 0})), "touch"}}) {
    const Cage cage = make_cage(surface);
    CHECK_FALSE(cage.closed);
    REQUIRE(cage.warnings.size() == 1);
    CHECK(cage.warnings[0].find(warning) != std::string::npos);
  }
}

TEST_CASE("a_cage_with_a_fin_is_refused_and_the_edge_named") {
  auto p = box().positions;
  auto t = box().triangles;
  p.push_back({3, 3, 3});
  t.push_back({0, 1, 8});
  CHECK_THROWS_WITH_AS(make_cage(from_triangles(p, t)), doctest::Contains("edge 0-1 ("), viete::base::Error);
}

TEST_CASE("elements_without_area_are_named_and_do_not_cut_the_cage_into_parts") {
  // A triangle without area is on the edge 1-3 of a box. The two triangles at this edge stay neighbours.
  auto p = box().positions;
  p.push_back(0.5 * (p[1] + p[3]));
  auto t = box().triangles;
  t[10] = {1, 8, 7};  // replaces {1, 3, 7}
  t.push_back({8, 3, 7});
  t.push_back({1, 3, 8});
  const Cage cage = make_cage(from_triangles(p, t));
  CHECK(cage.closed);
  CHECK(cage.degenerate.back() == 1);
  CHECK(cage.roots.size() == 1);
  REQUIRE(cage.warnings.size() == 1);
  CHECK(cage.warnings[0].find("13") != std::string::npos);
  for (const auto& e : cage.dual_edges) CHECK(e[1] != 13);
}

TEST_CASE("flat_closed_cages_and_cages_without_area_are_refused") {
  auto flat = box({1, 1, 0});
  CHECK_THROWS_AS(make_cage(flat), viete::base::Error);
  for (auto& q : flat.positions) q = {q[0] + q[1], q[1] - 0.5 * q[0], 0.25 * q[0] + 2 * q[1]};
  CHECK_THROWS_AS(make_cage(flat), viete::base::Error);
  CHECK(make_cage(box({1, 1, 1e-6})).warnings.empty());
  CHECK_THROWS_AS(make_cage(from_triangles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}})),
                  viete::base::Error);
  CHECK_THROWS_AS(make_cage(viete::mesh::Surface{}), viete::base::Error);
}

namespace {

std::shared_ptr<const Cage> bent_tube() {
  return std::make_shared<const Cage>(make_cage(tube(7, 12, 0.6, 2)));
}

std::vector<double> values(const CageState& state) {
  const auto v = state.rows().values;
  return {v.begin(), v.end()};
}

// Returns each pair of elements and blend that a deformer can have.
std::vector<std::pair<Elements, Blend>> deformers() {
  std::vector<std::pair<Elements, Blend>> all;
  for (const Deformer& s : valid_deformers()) {
    const std::pair one{s.weighting.elements, s.blend};
    if (std::ranges::find(all, one) == all.end()) all.push_back(one);
  }
  return all;
}

}  // namespace

TEST_CASE("rows_at_rest_are_identities") {
  const auto cage = bent_tube();
  for (const auto& [elements, blend] : deformers()) {
    CageState state(cage, elements, blend);
    state.set_pose(rest_pose(*cage));
    const Rows rows = state.rows();
    CHECK(rows.count() == handle_count(*cage, elements));
    CHECK(rows.columns() == shape(rows.form).columns);
    const auto centers = handle_centers(*cage, elements);
    if (has_moments(rows.form)) continue;  // rows of moments contain points, which are not 0
    for (std::size_t h = 0; h < rows.count(); ++h) {
      const auto row = rows.values.subspan(h * rows.columns(), rows.columns());
      for (std::size_t c = 0; c < rows.columns(); ++c) {
        const bool is_center = rows.form != RowForm::maps && c + 3 >= rows.columns();
        if (!is_center) CHECK(row[c] == 0);
        if (is_center) CHECK(row[c] == doctest::Approx((centers[h] - rows.origin)[c + 3 - rows.columns()]));
      }
    }
  }
}

TEST_CASE("rows_of_maps_move_points_as_the_maps_do") {
  const auto cage = bent_tube();
  CageState state(cage, Elements::face, Blend::linear);
  const Pose pose{mapped(cage->surface.positions, Twist{2, {0, 0, 0}, -1, 1, -50 * degree, 50 * degree}), {}};
  state.set_pose(pose);
  const auto maps = maps_of(*cage, pose.positions);
  const Rows rows = state.rows();
  const Vec3 middle_of_rest = middle(cage->surface.positions), point{0.3, -0.2, 0.7};
  for (std::size_t e = 0; e < maps.size(); ++e) {
    const double* d = rows.values.data() + 12 * e;
    const Vec3 x = point - middle_of_rest, from = point - cage->centers[e];
    Vec3 by_row, by_map;
    for (int r = 0; r < 3; ++r) {
      by_row[r] = x[r] + dot({d[3 * r], d[3 * r + 1], d[3 * r + 2]}, x) + d[9 + r];
      const auto& m = maps[e].linear;
      by_map[r] = dot({m[3 * r], m[3 * r + 1], m[3 * r + 2]}, from) + maps[e].center[r];
    }
    CHECK(norm(by_row - by_map) < 1e-14 * cage->diagonal);
  }
}

TEST_CASE("dragged_rows_equal_those_of_the_full_pose") {
  const auto cage = bent_tube();
  for (const auto& [elements, blend] : deformers()) {
    CageState dragged(cage, elements, blend), whole(cage, elements, blend);
    Pose pose{mapped(cage->surface.positions, Twist{2, {0, 0, 0}, -1, 1, -50 * degree, 50 * degree}), {}};
    dragged.set_pose(pose);
    const auto before = values(dragged);
    dragged.begin_drag(std::array{5u, 40u});
    const auto revision = dragged.resting_revision();
    const auto count = dragged.moving().size();
    CHECK(count > 0);
    CHECK(4 * count < handle_count(*cage, elements));
    for (int step = 0; step < 4; ++step) {
      pose.positions[5] = pose.positions[5] + Vec3{0.02, 0.01, -0.01};
      pose.positions[40][1] += 0.03;
      dragged.set_pose(pose);
      whole.set_pose(pose);
      CHECK(dragged.rows().origin == whole.rows().origin);
      CHECK(values(dragged) == values(whole));
      CHECK(dragged.report().turns == whole.report().turns);
    }
    CHECK(dragged.resting_revision() == revision);
    const auto after = values(dragged);
    const std::size_t columns = dragged.rows().columns();
    std::size_t changed = 0;
    for (std::size_t h = 0; h < dragged.rows().count(); ++h)
      changed += std::memcmp(&before[h * columns], &after[h * columns], columns * sizeof(double)) != 0;
    CHECK(changed == count);
  }
}

TEST_CASE("the_origin_is_fixed_during_a_drag_and_updated_after_it") {
  const auto cage = bent_tube();
  CageState state(cage, Elements::face, Blend::srl);
  Pose pose = rest_pose(*cage);
  state.set_pose(pose);
  const Vec3 origin = state.rows().origin;
  std::vector<std::uint32_t> all;
  for (std::uint32_t v = 0; v < pose.positions.size(); ++v) all.push_back(v);
  state.begin_drag(all);
  for (auto& p : pose.positions) p[0] += 1000;
  state.set_pose(pose);
  CHECK(state.rows().origin == origin);
  state.end_drag();
  state.set_pose(pose);
  CHECK(state.rows().origin != origin);
  CHECK(norm(state.rows().origin - origin - Vec3{1000, 0, 0}) < cage->diagonal);
}

TEST_CASE("without_logs_turns_of_a_pose_are_passed_on") {
  const auto cage = bent_tube();
  for (const auto& [elements, blend] : deformers()) {
    if (blend == Blend::srl) continue;
    CageState state(cage, elements, blend);
    state.set_pose({cage->surface.positions, {{1, 2, 3}}});
    CHECK(state.report().turns == std::vector<Vec3>{{1, 2, 3}});
  }
}
