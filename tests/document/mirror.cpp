#include "document/mirror.h"

#include <doctest/doctest.h>

#include "interact/mirror_edit.h"
#include "support/cube.h"
#include "support/edits.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;

TEST_CASE("vertices_of_a_cube_are_partners_across_every_axis") {
  const Document document = test::cube_document();
  for (int axis = 0; axis < 3; ++axis) {
    const auto mirror = mirror_of(*document.cage(), static_cast<MirrorPlane>(1 + axis));
    REQUIRE(mirror);
    CHECK(mirror->unpaired() == 0);
    for (std::uint32_t v = 0; v < 8; ++v) CHECK(mirror->partners[v] == (v ^ (1u << axis)));
  }
  CHECK_FALSE(mirror_of(*document.cage(), MirrorPlane::none));
}

TEST_CASE("the_plane_of_a_turned_or_moved_cage_pairs_all_of_it") {
  mesh::Surface surface = test::cube(1);
  for (auto& p : surface.positions) {
    p[1] *= 2;
    p[2] *= 3;
    p = {0.8 * p[0] - 0.6 * p[1], 0.6 * p[0] + 0.8 * p[1], p[2]};
  }
  const auto mirror = mirror_of(pose::make_cage(surface), MirrorPlane::fit);
  REQUIRE(mirror);
  CHECK(mirror->unpaired() == 0);
  for (std::uint32_t v = 0; v < 8; ++v) CHECK(mirror->partners[mirror->partners[v]] == v);
  surface = test::cube(1);
  for (auto& p : surface.positions) p[0] += 7;
  const auto across_x = mirror_of(pose::make_cage(surface), MirrorPlane::x);
  REQUIRE(across_x);
  CHECK(across_x->plane.offset == doctest::Approx(7));
  CHECK(across_x->unpaired() == 0);
}

TEST_CASE("a_vertex_without_an_image_has_no_partner_and_one_on_the_plane_is_its_own") {
  // A roof with its ridge on the mirror plane, and an unpaired vertex on the right.
  const pose::Cage cage = pose::make_cage(
      mesh::from_triangles({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 2}, {1, 0, 2}, {0, 1, 2}, {3, 0, 1}},
                           {{0, 2, 3}, {2, 5, 3}, {1, 4, 2}, {4, 5, 2}, {1, 6, 4}}));
  const auto mirror = mirror_of(cage, MirrorPlane::x);
  REQUIRE(mirror);
  CHECK(mirror->partners == std::vector<std::uint32_t>{1, 0, 2, 4, 3, 5, Mirror::none});
  CHECK(mirror->unpaired() == 1);
  CHECK(mirror->is_on_plane(2));
  CHECK_FALSE(mirror->is_paired(2));
}

TEST_CASE("a_side_is_copied_to_the_other_and_swapped_and_undone") {
  Document document = test::cube_document();
  const auto rest = document.pose().positions;
  const auto mirror = mirror_of(*document.cage(), MirrorPlane::x);
  document.changed_pose().positions[1] = {2, -1, -1};
  document.changed_pose().positions[0] = {-9, 0, 0};  // the partner of vertex 1
  const auto posed = document.pose().positions;
  document.changed_selection().apply(std::array{1u}, SelectMode::replace);
  copy_to_other_side(document, *mirror);
  CHECK(document.pose().positions[0] == mesh::Point{-2, -1, -1});
  CHECK(document.pose().positions[1] == mesh::Point{2, -1, -1});
  undo(document);
  CHECK(document.pose().positions == posed);
  document.changed_selection().clear();
  swap_sides(document, *mirror);
  CHECK(document.pose().positions[0] == mesh::Point{-2, -1, -1});
  CHECK(document.pose().positions[1] == mesh::Point{9, 0, 0});
  swap_sides(document, *mirror);
  CHECK(document.pose().positions == posed);
  CHECK(test::edit_count(document.history()) == 2);
}

TEST_CASE("hidden_partners_stay") {
  Document document = test::cube_document();
  const auto mirror = mirror_of(*document.cage(), MirrorPlane::x);
  document.changed_groups().hidden = {0};
  document.changed_pose().positions[1] = {2, -1, -1};
  const auto posed = document.pose().positions;
  document.changed_selection().apply(std::array{1u}, SelectMode::replace);
  copy_to_other_side(document, *mirror);
  CHECK(document.pose().positions[0] == posed[0]);
  swap_sides(document, *mirror);
  CHECK(document.pose().positions[0] == posed[0]);
  const std::vector<mesh::Point> pasted{{5, 5, 5}};
  paste_pose(document, std::array{1u}, pasted, &*mirror);
  CHECK(document.pose().positions[0] == posed[0]);
  CHECK(document.pose().positions[1] == mesh::Point{5, 5, 5});
}

TEST_CASE("a_cached_mirror_follows_cage_and_choice") {
  MirrorCache known;
  Document document = test::cube_document();
  known.follow(document.cage(), MirrorPlane::y);
  REQUIRE(known.get());
  CHECK(known.get()->partners[0] == 2);
  known.follow(document.cage(), MirrorPlane::none);
  CHECK_FALSE(known.get());
  known.follow(nullptr, MirrorPlane::x);
  CHECK_FALSE(known.get());
}

TEST_CASE("the_rectangle_of_a_mirror_lies_in_its_plane_and_covers_the_cage_there") {
  const std::vector<mesh::Point> points{{0, 0, 0}, {4, 1, 2}, {-3, 5, 1}, {1, -2, 7}};
  for (const cages::Plane& plane :
       {cages::Plane{{1, 0, 0}, 0.5}, cages::Plane{{0, 1, 0}, -2}, cages::Plane{{0.6, 0, 0.8}, 1}}) {
    const auto corners = rectangle_in_plane(Mirror{plane, {}}, points);
    for (std::size_t i = 0; i < 4; ++i) {
      const mesh::Vec3 side = corners[(i + 1) % 4] - corners[i],
                       next = corners[(i + 2) % 4] - corners[(i + 1) % 4];
      CHECK(mesh::dot(plane.normal, corners[i]) == doctest::Approx(plane.offset));
      CHECK(mesh::dot(side, next) == doctest::Approx(0).epsilon(1e-9));
      for (const auto& p : points) CHECK(mesh::dot(next, p) > mesh::dot(next, corners[i]));
    }
  }
}
