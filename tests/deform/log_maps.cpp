#include "deform/maps.h"

#include <doctest/doctest.h>

#include "deform/shapes.h"

using namespace viete::test;

namespace {

struct Logs {
  std::vector<MapLog> logs;
  LogReport report;
};

Logs logs_of(const Cage& cage, const std::vector<AffineMap>& maps, const std::vector<Vec3>& turns = {}) {
  std::vector<MapSplit> splits(maps.size());
  split_maps(maps, first(maps.size()), splits);
  Logs result{std::vector<MapLog>(maps.size()), {}};
  log_maps(cage, maps, splits, turns, result.logs, result.report);
  return result;
}

Logs logs_of(const Cage& cage, const std::vector<viete::mesh::Point>& posed,
             const std::vector<Vec3>& turns = {}) {
  return logs_of(cage, maps_of(cage, posed), turns);
}

double angle_from(const Vec3& y, const Vec3& axis) {
  return dot(y, axis) / norm(axis) / degree;
}

}  // namespace

TEST_CASE("an_unmoved_cage_has_zero_logs_and_nothing_to_report") {
  const Cage cage = make_cage(tube(9, 7, 0.3, 2));
  const auto [logs, report] = logs_of(cage, cage.surface.positions);
  for (const auto& l : logs) {
    CHECK(l.stretch == viete::sym3::Sym3<double>{});
    CHECK(l.rotation == Vec3{0, 0, 0});
  }
  CHECK(report.collapsed.empty());
  CHECK(report.torn.empty());
  CHECK(report.turns == std::vector<Vec3>{{0, 0, 0}});
}

TEST_CASE("all_elements_of_a_turned_cage_have_the_same_log_also_at_180_degrees") {
  const Cage cage = make_cage(tube(9, 7, 0.3, 2));
  for (const double a : {1.0, 90.0, 179.9999, 180.0, 180.0001, 270.0}) {
    const auto [logs, report] =
        logs_of(cage, mapped(cage.surface.positions, similarity({1, 2, 3}, a * degree)));
    for (const auto& l : logs) CHECK(norm(l.rotation - logs[0].rotation) < 1e-12);
    CHECK(report.torn.empty());
  }
}

TEST_CASE("separate_parts_that_turn_by_180_degrees_together_take_the_same_side") {
  const auto surface = together(box(), together(box({1, 2, 3}, {5, 0, 0}), tube(5, 6, 0.4, 2)));
  const Cage cage = make_cage(surface);
  REQUIRE(cage.roots.size() == 3);
  Random random(8);
  for (int n = 0; n < 30; ++n) {
    const Vec3 axis = random.vector(1);
    const auto logs =
        logs_of(cage, mapped(surface.positions, similarity(axis, 180 * degree, 2, {1, 2, 3}))).logs;
    for (const auto& l : logs) CHECK(norm(l.rotation - logs[0].rotation) < 1e-12);
  }
}

TEST_CASE("winding_with_turns_handed_on_counts_to_720_degrees_and_back_to_nothing") {
  const Cage cage = make_cage(together(tube(9, 7, 0.3, 2), box({1, 1, 1}, {5, 0, 0})));
  const Vec3 axis{1, -2, 3};
  std::vector<Vec3> turns;
  const auto visit = [&](double a) {
    const auto [logs, report] =
        logs_of(cage, mapped(cage.surface.positions, similarity(axis, a * degree)), turns);
    for (const auto& l : logs) CHECK(angle_from(l.rotation, axis) == doctest::Approx(a).epsilon(1e-10));
    turns = report.turns;
  };
  for (int a = 0; a <= 720; a += 30) visit(a);
  for (int a = 720; a >= 0; a -= 45) visit(a);
  for (const auto& t : turns) CHECK(norm(t) < 1e-14);
}

TEST_CASE("the_same_pose_with_its_own_turns_gives_the_same_logs") {
  const Cage cage = make_cage(tube(9, 7, 0.3, 2));
  const auto posed = mapped(cage.surface.positions, Twist{2, {0, 0, 0}, -1, 1, 170 * degree, 290 * degree});
  const auto first = logs_of(cage, posed, {{0, 0, 200 * degree}});
  CHECK(norm(first.report.turns[0]) == doctest::Approx(230 * degree).epsilon(0.05));
  const auto second = logs_of(cage, posed, first.report.turns);
  for (std::size_t e = 0; e < first.logs.size(); ++e)
    CHECK(norm(first.logs[e].rotation - second.logs[e].rotation) < 1e-13);
}

TEST_CASE("logs_without_turns_do_not_depend_on_anything_before") {
  const Cage cage = make_cage(tube(9, 7, 0.3, 2));
  const auto posed = mapped(cage.surface.positions, similarity({0, 0, 1}, 200 * degree));
  CHECK(norm(logs_of(cage, posed).report.turns[0]) == doctest::Approx(160 * degree));
}

TEST_CASE("a_floor_keeps_collapsed_elements_finite_and_names_them") {
  const Cage cage = make_cage(box());
  auto posed = cage.surface.positions;
  posed[1] = posed[0];
  const auto [logs, report] = logs_of(cage, posed);
  CHECK(report.collapsed.size() >= 2);
  for (const auto& l : logs) {
    CHECK(std::isfinite(l.stretch.xx + l.stretch.xy + l.stretch.xz + l.stretch.yy + l.stretch.yz +
                        l.stretch.zz));
    CHECK(std::isfinite(norm(l.rotation)));
    CHECK(l.stretch.xx + l.stretch.yy + l.stretch.zz > 3 * std::log(1e-4) - 1);
  }
}

TEST_CASE("a_pose_in_one_point_is_collapsed_everywhere_and_finite") {
  const Cage cage = make_cage(box());
  const auto [logs, report] = logs_of(cage, std::vector<viete::mesh::Point>(8, {3, 4, 5}));
  CHECK(report.collapsed.size() == 12);
  for (const auto& l : logs) CHECK(std::isfinite(l.stretch.xx));
}

TEST_CASE("a_uniformly_tiny_or_huge_pose_is_not_collapsed") {
  const Cage cage = make_cage(box());
  for (const double s : {1e-30, 1e-9, 1e9, 1e30}) {
    const auto [logs, report] = logs_of(cage, mapped(cage.surface.positions, similarity({0, 0, 1}, 1, s)));
    CHECK(report.collapsed.empty());
    for (const auto& l : logs) CHECK(l.stretch.xx == doctest::Approx(std::log(s)));
  }
}

TEST_CASE("a_map_that_is_not_finite_is_reported_and_does_not_spread") {
  const Cage cage = make_cage(box());
  auto maps = maps_of(cage, cage.surface.positions);
  maps[3].linear[4] = std::numeric_limits<double>::quiet_NaN();
  const auto [logs, report] = logs_of(cage, maps);
  CHECK(report.collapsed == std::vector<std::uint32_t>{3});
  for (const auto& l : logs) CHECK(std::isfinite(norm(l.rotation) + l.stretch.xx));
}

TEST_CASE("neighbours_turned_by_more_than_120_degrees_are_reported_as_torn") {
  // Two triangles folded about their common edge.
  const auto rest =
      viete::mesh::from_triangles({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}}, {{0, 2, 1}, {0, 1, 3}});
  const Cage cage = make_cage(rest);
  for (const auto& [fold, count] : {std::pair{110.0, 0u}, {130.0, 1u}, {170.0, 1u}}) {
    auto posed = rest.positions;
    posed[3] = similarity({0, 1, 0}, fold * degree)(posed[3]);
    CHECK(logs_of(cage, posed).report.torn.size() == count);
  }
}

TEST_CASE("elements_without_area_at_rest_have_zero_logs") {
  const auto rest =
      viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
  const Cage cage = make_cage(rest);
  const auto [logs, report] = logs_of(cage, mapped(rest.positions, similarity({1, 1, 1}, 1, 2)));
  CHECK(logs[1].rotation == Vec3{0, 0, 0});
  CHECK(logs[1].stretch == viete::sym3::Sym3<double>{});
  CHECK(report.collapsed.empty());
}
