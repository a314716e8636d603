#include <doctest/doctest.h>

#include "pose/branches.h"
#include "pose/maps.h"
#include "support/caged_shapes.h"

using namespace viete::test;
using Edges = std::vector<viete::mesh::Edge>;

namespace {

Edges path(std::uint32_t nodes) {
  Edges edges;
  for (std::uint32_t i = 0; i + 1 < nodes; ++i) edges.push_back({i, i + 1});
  return edges;
}

}  // namespace

TEST_CASE("the_centre_of_each_part_is_its_middle_and_the_lower_of_two") {
  // The last length is above the limit for exact centers.
  for (const auto& [length, centre] : {std::pair{7u, 3u}, {8u, 3u}, {20001u, 10000u}}) {
    const GraphParts parts = graph_parts(length, path(length), std::vector<std::uint8_t>(length, 0));
    CHECK(parts.centers == std::vector{centre});
    CHECK(parts.of == std::vector<std::uint32_t>(length, 0));
  }
  const GraphParts two = graph_parts(5, Edges{{0, 1}, {1, 2}}, std::vector<std::uint8_t>{0, 0, 0, 1, 0});
  CHECK(two.centers == std::vector<std::uint32_t>{1, 4});
  CHECK(two.of == std::vector<std::uint32_t>{0, 0, 0, 2, 1});  // item 3 is skipped
}

TEST_CASE("three_triangles_on_an_edge_are_joined_in_a_chain") {
  const auto fan = viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                                               {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const auto graph = dual_graph(fan, std::vector<std::uint8_t>(3, 0));
  CHECK(graph.edges == Edges{{0, 1}, {1, 2}});
  CHECK(graph.nonmanifold == 1);
  CHECK(graph.open == 6);
}

TEST_CASE("a_collapsed_triangle_joins_its_neighbours") {
  auto closed = box();
  closed.positions.push_back(closed.positions[2]);  // coincides with vertex 2
  closed.triangles.push_back({0, 2, 8});
  const auto surface = viete::mesh::from_triangles(closed.positions, closed.triangles);
  std::vector<std::uint8_t> skip(surface.triangles.size(), 0);
  skip.back() = 1;
  const auto graph = dual_graph(surface, skip), sound = dual_graph(box(), std::vector<std::uint8_t>(12, 0));
  CHECK(graph.edges == sound.edges);
  CHECK(graph.open + graph.nonmanifold + graph.misoriented == 0);
}

using namespace viete;

namespace {

using Rotations = std::vector<sym3::Mat3<double>>;

Rotations all(const Cage& cage, const Vec3& axis, double degrees) {
  return Rotations(cage.element_count(), similarity(axis, degrees * degree).linear);
}

Branches branches_of(const Cage& cage, const Rotations& rotations, const std::vector<Vec3>& turns) {
  std::vector<Vec3> principal;
  for (const auto& r : rotations) principal.push_back(sym3::log_rotation(r));
  return choose_branches(cage, rotations, principal, turns);
}

}  // namespace

TEST_CASE("nearest_branch_is_among_all_turns_about_the_axis_of_the_rotation_or_else_of_the_reference") {
  const Vec3 n = (1 / std::sqrt(14.0)) * Vec3{1, 2, 3};
  const double turn = 360 * degree;
  for (double reference = -900; reference <= 900; reference += 7)
    for (double angle = -170; angle <= 170; angle += 17) {
      const Vec3 y = nearest_branch((angle * degree) * n, (reference * degree) * n);
      const double k = (dot(y, n) - angle * degree) / turn;
      CHECK(std::abs(k - std::round(k)) < 1e-12);
      CHECK(std::abs(dot(y, n) / degree - reference) <= 180 + 1e-9);
    }
  CHECK(nearest_branch({1, 2, 2}, {0, 0, 0}) == Vec3{1, 2, 2});
  for (const double r : {0.0, 3.0, 359.0, 360.0, 361.0, 400.0}) {
    const Vec3 expected{0, 0, r < 180 ? 0 : turn};
    for (const Vec3& zero : {Vec3{0, 0, 0}, Vec3{1e-15, 0, 0}})
      CHECK(norm(nearest_branch(zero, {0, 0, r * degree}) - expected) < 1e-14);
  }
}

TEST_CASE("a_flipped_element_or_root_does_not_rotate_the_others") {
  const Cage cage = make_cage(tube(9, 7, 0.3, 2));
  std::vector<std::uint32_t> flipped{cage.roots[0]};
  for (std::uint32_t e = 0; e < cage.element_count(); e += 5) flipped.push_back(e);
  for (const auto e : flipped) {
    std::vector<Vec3> turns;
    Branches b;
    for (int a = 0; a <= 720; a += 10) {  // only one element rotates, by two full turns
      auto rotations = all(cage, {1, 0, 0}, 3);
      rotations[e] = similarity({0, 0, 1}, a * degree).linear;
      b = branches_of(cage, rotations, turns);
      turns = b.turns;
      for (std::uint32_t i = 0; i < b.logs.size(); ++i)
        if (i != e) CHECK(norm(b.logs[i]) == doctest::Approx(3 * degree));
    }
    CHECK(norm(b.logs[e]) < 1e-9);
  }
}

TEST_CASE("reference_turns_select_the_number_of_whole_turns") {
  const Cage cage = make_cage(box());
  for (int k = -3; k <= 3; ++k) {
    const std::vector<Vec3> turns = {{0, 0, (40 + 360 * k) * degree}};
    const Branches b = branches_of(cage, all(cage, {0, 0, 1}, 30), turns);
    for (const auto& log : b.logs) CHECK(log[2] == doctest::Approx((30 + 360 * k) * degree));
    CHECK(b.turns[0][2] == doctest::Approx((30 + 360 * k) * degree));
  }
}

namespace {

// Returns rotations about x by angles that grow along the tube, each followed by a rotation about z.
Rotations bent(const Cage& cage, double degrees, double about_z) {
  Rotations rotations;
  for (const Vec3& center : cage.centers)
    rotations.push_back(pose::times(similarity({0, 0, 1}, about_z * degree).linear,
                                    similarity({1, 0, 0}, (10 + center[2] * degrees) * degree).linear));
  return rotations;
}

}  // namespace

TEST_CASE("whole_turns_about_another_axis_are_kept_and_logs_are_coherent") {
  const Cage cage = make_cage(tube(9, 7, 0.3, 2));
  const Branches least = branches_of(cage, bent(cage, 20, 0), {});
  for (const double count : {1.0, 2.0, 5.0}) {
    const double length = count * 360 * degree;
    for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{0.6, 0, -0.8}}) {
      std::vector<Vec3> turns{length * axis};
      for (int i = 0; i < 3; ++i) {
        const Branches b = branches_of(cage, bent(cage, 20, 0), turns);
        turns = b.turns;
        CHECK(norm(turns[0] - with_whole_turns(axis, count, least.turns[0])) < 1e-9);
        CHECK(whole_turns(turns[0], least.turns[0]) == count);
        for (const auto& [e, f] : cage.dual_edges) CHECK(norm(b.logs[e] - b.logs[f]) < 90 * degree);
      }
    }
  }
  std::vector<Vec3> turns{{0, 0, 360 * degree}};
  for (int a = 0; a <= 720; a += 10) turns = branches_of(cage, bent(cage, 20, a), turns).turns;
  CHECK(norm(turns[0] - Vec3{0, 0, 3 * 360 * degree}) < 1e-6);
}
