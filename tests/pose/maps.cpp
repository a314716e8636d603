#include <doctest/doctest.h>

#include "deform/bound.h"
#include "pose/all_maps.h"
#include "pose/maps.h"
#include "support/caged_shapes.h"

using namespace viete::test;
using namespace viete;

namespace {

using Matrix = viete::sym3::Mat3<double>;

const Matrix unity = {1, 0, 0, 0, 1, 0, 0, 0, 1};

Matrix transposed(const Matrix& m) {
  return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
}

Matrix diagonal(const Vec3& d) {
  return {d[0], 0, 0, 0, d[1], 0, 0, 0, d[2]};
}

// Returns two triangles. The second triangle has no area.
viete::mesh::Surface flat_element() {
  return viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
}

// Returns rotations by at most 180 degrees, multiplied by stretches from 0.5 to 2.
std::vector<AffineMap> maps(std::size_t count) {
  Random random(3);
  std::vector<AffineMap> all(count);
  for (auto& map : all) {
    const Matrix rotation = viete::sym3::exp_rotation(random.vector(1.8)),
                 axes = viete::sym3::exp_rotation(random.vector(1.8));
    const Vec3 s{random(0.5, 2), random(0.5, 2), random(0.5, 2)};
    map.linear = times(times(rotation, times(axes, diagonal(s))), transposed(axes));
  }
  return all;
}

std::array<double, 6> six(const viete::sym3::Sym3<double>& s) {
  return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
}

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

double determinant(const Matrix& m) {
  return dot({m[0], m[1], m[2]}, cross({m[3], m[4], m[5]}, {m[6], m[7], m[8]}));
}

Matrix stretch(const Polar& p) {
  return times(times(p.axes, diagonal(p.stretches)), transposed(p.axes));
}

}  // namespace

TEST_CASE("unmoved_elements_have_exactly_the_identity") {
  const Cage cage = make_cage(tube(9, 7, 0.31, 2.3));
  for (const auto& map : maps_of(cage, cage.surface.positions)) CHECK(map.linear == unity);
}

TEST_CASE("a_map_takes_the_corners_of_its_element_to_their_posed_places") {
  const Cage cage = make_cage(box({1, 2, 3}));
  Random random(7);
  auto posed = cage.surface.positions;
  for (auto& p : posed) p = p + random.vector(0.5);
  const auto maps = maps_of(cage, posed);
  const Vec3 origin = pose_origin(cage, posed);
  for (std::size_t e = 0; e < maps.size(); ++e)
    for (const auto v : cage.surface.triangles[e]) {
      const Vec3 image =
          Affine{maps[e].linear, maps[e].center}(cage.surface.positions[v] - cage.centers[e]) + origin;
      CHECK(norm(image - posed[v]) < 1e-14);
    }
}

TEST_CASE("a_similarity_is_reproduced_off_the_plane_too") {
  const Cage cage = make_cage(box({1, 2, 3}));
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const auto map = similarity({1, -1, 2}, 2.2, scale, {scale, 0, 0});
    for (const auto& m : maps_of(cage, mapped(cage.surface.positions, map)))
      CHECK(largest_difference(m.linear, map.linear) < 1e-13 * scale);
  }
}

TEST_CASE("orientation_of_an_element_does_not_change_its_map") {
  auto t = box().triangles;
  for (auto& x : t) std::swap(x[1], x[2]);
  const Cage cage = make_cage(box()), turned = make_cage(viete::mesh::from_triangles(box().positions, t));
  const auto posed = mapped(cage.surface.positions, shear());
  const auto a = maps_of(cage, posed), b = maps_of(turned, posed);
  for (std::size_t e = 0; e < a.size(); ++e) CHECK(largest_difference(a[e].linear, b[e].linear) < 1e-14);
}

TEST_CASE("elements_without_area_have_defined_maps") {
  const Cage cage = make_cage(flat_element());
  CHECK(maps_of(cage, cage.surface.positions)[1].linear == unity);
  const std::vector<viete::mesh::Point> posed(4, {5, 5, 5});
  const auto maps = maps_of(cage, posed);
  CHECK(maps[0].linear == viete::sym3::Mat3<double>{});
  CHECK(maps[1].linear == unity);
}

TEST_CASE("splits_in_vector_code_agree_with_singular_values") {
  const auto all = maps(301);
  std::vector<MapSplit> splits(all.size());
  split_maps(all, first(all.size()), splits);
  for (std::size_t e = 0; e < all.size(); ++e) {
    const Polar expected = polar(all[e].linear);
    CHECK(largest_difference(splits[e].rotation, expected.rotation) < 1e-14);
    CHECK(largest_difference(six(splits[e].stretch), six(log_stretch(expected))) < 1e-14);
    CHECK(largest_difference(splits[e].turn, Vec3(viete::sym3::log_rotation(expected.rotation))) < 1e-12);
    CHECK(splits[e].least == doctest::Approx(expected.stretches[2]));
    CHECK(splits[e].largest == doctest::Approx(expected.stretches[0]));
  }
}

TEST_CASE("a_split_depends_on_its_own_map_alone_to_the_last_bit") {
  const auto all = maps(150);
  std::vector<MapSplit> together(all.size()), apart(all.size());
  split_maps(all, first(all.size()), together);
  for (const std::uint32_t e : {0u, 7u, 63u, 64u, 149u}) {
    split_maps(all, std::array{e}, apart);
    CHECK(apart[e].rotation == together[e].rotation);
    CHECK(apart[e].stretch == together[e].stretch);
    CHECK(apart[e].turn == together[e].turn);
  }
  CHECK(apart[1].largest == 0);
}

TEST_CASE("a_split_detects_maps_that_mirror_or_are_not_finite") {
  std::vector<AffineMap> two(2);
  two[0].linear = {-1, 0, 0, 0, 2, 0, 0, 0, 3};
  two[1].linear = {1, 0, 0, 0, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 1};
  std::vector<MapSplit> splits(2);
  split_maps(two, first(2), splits);
  CHECK(splits[0].least < 0);
  CHECK_FALSE(splits[1].least >= 0);
}

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

TEST_CASE("parts_that_turn_together_have_the_same_log_also_at_180_degrees") {
  const auto surface = together(box(), together(box({1, 2, 3}, {5, 0, 0}), tube(9, 7, 0.3, 2)));
  const Cage cage = make_cage(surface);
  REQUIRE(cage.roots.size() == 3);
  Random random(8);
  for (const double angle : {1.0, 90.0, 179.9999, 180.0, 180.0001, 270.0})
    for (int n = 0; n < 10; ++n) {
      const auto map = similarity(random.vector(1), angle * degree, 2, {1, 2, 3});
      const auto [logs, report] = logs_of(cage, mapped(surface.positions, map));
      for (const auto& l : logs) CHECK(norm(l.rotation - logs[0].rotation) < 1e-12);
      CHECK(report.torn.empty());
    }
}

TEST_CASE("winding_with_turns_passed_on_counts_to_720_degrees_and_back_to_zero") {
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
  auto edge = cage.surface.positions;
  edge[1] = edge[0];
  const std::vector<viete::mesh::Point> point(8, {3, 4, 5});
  for (const auto& [posed, count] : {std::pair{edge, 2u}, {point, 12u}}) {
    const auto [logs, report] = logs_of(cage, posed);
    CHECK(report.collapsed.size() >= count);
    for (const auto& l : logs) {
      for (const double x : six(l.stretch)) CHECK(std::isfinite(x));
      CHECK(std::isfinite(norm(l.rotation)));
      if (count == 2) CHECK(l.stretch.xx + l.stretch.yy + l.stretch.zz > 3 * std::log(1e-4) - 1);
    }
  }
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

TEST_CASE("elements_without_area_at_rest_have_zero_logs") {
  const Cage cage = make_cage(flat_element());
  const auto [logs, report] = logs_of(cage, mapped(cage.surface.positions, similarity({1, 1, 1}, 1, 2)));
  CHECK(logs[1].rotation == Vec3{0, 0, 0});
  CHECK(logs[1].stretch == viete::sym3::Sym3<double>{});
  CHECK(report.collapsed.empty());
}

TEST_CASE("neighbours_turned_by_more_than_120_degrees_are_reported_as_torn") {
  // The triangles are folded about their common edge.
  const auto rest =
      viete::mesh::from_triangles({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}}, {{0, 2, 1}, {0, 1, 3}});
  const Cage cage = make_cage(rest);
  for (const auto& [fold, count] : {std::pair{110.0, 0u}, {130.0, 1u}, {170.0, 1u}}) {
    auto posed = rest.positions;
    posed[3] = similarity({0, 1, 0}, fold * degree)(posed[3]);
    CHECK(logs_of(cage, posed).report.torn.size() == count);
  }
}

TEST_CASE("rotation_times_stretch_is_the_matrix") {
  Random random(6);
  for (int n = 0; n < 200; ++n) {
    Matrix m;
    for (double& x : m) x = random(-1, 1);
    if (determinant(m) < 0) m = times(m, diagonal({1, 1, -1}));
    const Polar p = polar(m);
    CHECK(largest_difference(times(p.rotation, stretch(p)), m) < 5e-15);
    CHECK(largest_difference(times(p.rotation, transposed(p.rotation)), unity) < 5e-15);
    CHECK(determinant(p.rotation) == doctest::Approx(1));
  }
}

TEST_CASE("a_similarity_has_its_rotation_and_an_isotropic_log_at_any_scale") {
  for (const double s : {1e-30, 1e-3, 1.0, 1e3, 1e30}) {
    const auto map = similarity({1, 2, 3}, 2.5, s);
    const Polar p = polar(map.linear);
    CHECK(largest_difference(p.rotation, similarity({1, 2, 3}, 2.5).linear) < 3e-15);
    const auto x = log_stretch(p);
    CHECK(x.xx == doctest::Approx(std::log(s)).epsilon(1e-14));
    CHECK(x.zz == doctest::Approx(std::log(s)).epsilon(1e-14));
    CHECK(std::abs(x.xy) < 1e-15 * (1 + std::abs(std::log(s))) * 10);
  }
}

TEST_CASE("a_matrix_that_is_not_finite_has_no_rotation_and_no_stretch") {
  for (const double odd :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Polar p = polar({1, 0, 0, 0, odd, 0, 0, 0, 1});
    for (const double x : p.rotation) CHECK(std::isnan(x));
    for (const double x : p.stretches) CHECK(std::isnan(x));
  }
}

TEST_CASE("singular_and_mirroring_matrices_have_a_proper_rotation") {
  for (const Matrix& m : {diagonal({1, 0, 0}), diagonal({1, 1, 0}), Matrix{1, 2, 3, 2, 4, 6, 3, 6, 9}}) {
    const Polar p = polar(m);
    CHECK(determinant(p.rotation) == doctest::Approx(1));
    CHECK(largest_difference(times(p.rotation, stretch(p)), m) < 1e-13);
  }
  for (const Vec3& d : {Vec3{0, 0, 0}, Vec3{1, 1, 1}}) CHECK(polar(diagonal(d)).rotation == unity);
  CHECK(log_stretch(polar(unity)) == viete::sym3::Sym3<double>{});
  CHECK(largest_difference(polar(diagonal({3, 2, -1})).rotation, unity) < 1e-15);
  CHECK(determinant(polar(diagonal({-1, -2, -3})).rotation) == doctest::Approx(1));
}

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
