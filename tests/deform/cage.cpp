#include "deform/cage.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "deform/shapes.h"

using namespace viete::test;
using viete::mesh::from_triangles;

TEST_CASE("a_closed_box_has_one_part_and_no_warnings") {
  const Cage cage = make_cage(box());
  CHECK(cage.element_count() == 12);
  CHECK(cage.dual_edges.size() == 18);
  CHECK(cage.roots.size() == 1);
  CHECK(cage.closed);
  CHECK(cage.warnings.empty());
  CHECK(cage.diagonal == doctest::Approx(std::sqrt(12.0)));
  CHECK(rest_pose(cage).positions == cage.surface.positions);
}

TEST_CASE("two_boxes_are_two_parts_with_a_root_each") {
  const Cage cage = make_cage(together(box(), box({1, 1, 1}, {5, 0, 0})));
  REQUIRE(cage.roots.size() == 2);
  CHECK(cage.roots[0] < 12);
  CHECK(cage.roots[1] >= 12);
}

TEST_CASE("a_cage_of_loose_triangles_that_meet_in_space_is_closed_and_one_part") {
  const auto b = box();
  std::vector<viete::mesh::Point> p;
  std::vector<viete::mesh::Triangle> t;
  for (const auto& x : b.triangles) {
    const auto n = static_cast<std::uint32_t>(p.size());
    for (const auto v : x) p.push_back(b.positions[v]);
    t.push_back({n, n + 1, n + 2});
  }
  const Cage cage = make_cage(from_triangles(p, t));
  CHECK(cage.closed);
  CHECK(cage.roots.size() == 1);
  CHECK(cage.dual_edges == make_cage(b).dual_edges);
}

TEST_CASE("open_and_misoriented_cages_warn") {
  auto t = box().triangles;
  t.pop_back();
  const Cage open = make_cage(from_triangles(box().positions, t));
  CHECK_FALSE(open.closed);
  REQUIRE(open.warnings.size() == 1);
  CHECK(open.warnings[0].find("3 cage edges are of one triangle only") == 0);

  t = box().triangles;
  std::swap(t[3][0], t[3][1]);
  const Cage flipped = make_cage(from_triangles(box().positions, t));
  CHECK_FALSE(flipped.closed);
  CHECK(flipped.warnings.size() == 1);
}

TEST_CASE("a_cage_with_a_fin_is_refused_and_the_edge_named") {
  auto p = box().positions;
  auto t = box().triangles;
  p.push_back({3, 3, 3});
  t.push_back({0, 1, 8});
  try {
    make_cage(from_triangles(p, t));
    FAIL("taken");
  } catch (const viete::base::Error& error) {
    CHECK(std::string(error.what()).find("edge 0-1 (") != std::string::npos);
  }
}

TEST_CASE("boxes_that_touch_along_an_edge_are_a_cage_with_a_word") {
  const Cage cage = make_cage(together(box(), box({1, 1, 1}, {2, 2, 0})));
  CHECK_FALSE(cage.closed);
  REQUIRE(cage.warnings.size() == 1);
  CHECK(cage.warnings[0].find("touch") != std::string::npos);
}

TEST_CASE("a_cage_that_is_squashed_flat_is_refused_whatever_way_it_lies") {
  auto flat = box({1, 1, 0});
  CHECK_THROWS_AS(make_cage(flat), viete::base::Error);
  for (auto& q : flat.positions) q = {q[0] + q[1], q[1] - 0.5 * q[0], 0.25 * q[0] + 2 * q[1]};
  CHECK_THROWS_AS(make_cage(flat), viete::base::Error);
  CHECK(make_cage(box({1, 1, 1e-6})).warnings.empty());
}

TEST_CASE("elements_without_area_are_named_and_do_not_cut_the_cage_into_parts") {
  // A box whose edge 1-3 carries a triangle without area: its two neighbours are joined past it.
  auto p = box().positions;
  p.push_back(0.5 * (p[1] + p[3]));
  auto t = box().triangles;
  t[10] = {1, 8, 7};  // was 1 3 7
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

TEST_CASE("a_cage_without_area_is_refused") {
  CHECK_THROWS_AS(make_cage(from_triangles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}})),
                  viete::base::Error);
  CHECK_THROWS_AS(make_cage(viete::mesh::Surface{}), viete::base::Error);
}

TEST_CASE("a_tiny_and_a_huge_cage_have_no_degenerate_elements") {
  for (const double s : {1e-30, 1e30}) CHECK(make_cage(box({s, s, s})).warnings.empty());
}
