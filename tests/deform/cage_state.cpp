#include "deform/cage_state.h"

#include <doctest/doctest.h>

#include <array>
#include <cstring>

#include "base/error.h"
#include "deform/maps.h"
#include "deform/shapes.h"

using namespace viete;
using namespace viete::test;

namespace {

std::shared_ptr<const Cage> bent_tube() {
  return std::make_shared<const Cage>(make_cage(tube(7, 12, 0.6, 2)));
}

std::vector<double> values(const CageState& state) {
  const auto v = state.rows().values;
  return {v.begin(), v.end()};
}

// Whatever the weights are.
std::vector<std::pair<Elements, Blend>> schemes() {
  std::vector<std::pair<Elements, Blend>> all;
  for (const Scheme& s : valid_schemes()) {
    const std::pair one{s.weighting.elements, s.blend};
    if (std::ranges::find(all, one) == all.end()) all.push_back(one);
  }
  return all;
}

}  // namespace

TEST_CASE("rows_at_rest_say_that_nothing_moves") {
  const auto cage = bent_tube();
  for (const auto& [elements, blend] : schemes()) {
    CageState state(cage, elements, blend);
    state.set_pose(rest_pose(*cage));
    const Rows rows = state.rows();
    CHECK(rows.count() == handle_count(*cage, elements));
    CHECK(rows.columns() == shape(rows.form).columns);
    const auto centers = handle_centers(*cage, elements);
    if (has_moments(rows.form)) continue;  // they hold points, of which nothing is 0
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

TEST_CASE("in_a_drag_rows_are_those_of_a_state_that_takes_the_pose_whole") {
  const auto cage = bent_tube();
  for (const auto& [elements, blend] : schemes()) {
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

TEST_CASE("the_origin_stays_during_a_drag_and_follows_when_it_is_over") {
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

TEST_CASE("without_logs_the_turns_of_a_pose_are_handed_on") {
  const auto cage = bent_tube();
  for (const auto& [elements, blend] : schemes()) {
    if (blend == Blend::srl) continue;
    CageState state(cage, elements, blend);
    state.set_pose({cage->surface.positions, {{1, 2, 3}}});
    CHECK(state.report().turns == std::vector<Vec3>{{1, 2, 3}});
  }
}

TEST_CASE("a_state_refuses_a_pose_with_another_number_of_vertices") {
  const auto cage = bent_tube();
  CageState state(cage, Elements::face, Blend::srl);
  CHECK_THROWS_AS(state.set_pose({{{0, 0, 0}}, {}}), base::Error);
}
