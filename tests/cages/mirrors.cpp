#include "cages/judge.h"
#include "cages/make.h"
#include "cages/models.h"
#include "cages/soundness.h"

using namespace viete;
using namespace viete::test;

namespace {

mesh::Surface lopsided() {
  return both(stretched(cube(), {2, 1, 0.5}), stretched(cube(), {0.3, 0.4, 0.9}, {1.4, 0.5, 0.9}));
}

mesh::Surface two_sided(const mesh::Surface& half) {
  return both(stretched(half, {1, 1, 1}, {3, 0, 0}),
              stretched(turned_inside_out(half), {-1, 1, 1}, {-3, 0, 0}));
}

}  // namespace

TEST_CASE("half_and_mirror_image_are_joined") {
  const cages::Shell half = {{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  const cages::Shell all = cages::whole(half);
  CHECK(all.positions.size() == 5);
  const mesh::Surface s = mesh::from_triangles(all.positions, all.triangles);
  const mesh::Summary summary = mesh::summarize(s);
  CHECK(summary.closed());
  CHECK(mesh::topology(s, summary));
  CHECK(std::abs(summary.volume) == doctest::Approx(1.0 / 3));
}

TEST_CASE("symmetry_plane_is_found_in_any_orientation") {
  for (const double angle : {0.0, 0.4, 1.1}) {
    CAPTURE(angle);
    const mesh::Surface model = stretched(turned(two_sided(lopsided()), angle), {1, 1, 1}, {7, -3, 2});
    const auto plane = cages::symmetry_plane(model, nullptr);
    REQUIRE(plane);
    CHECK(asymmetry(model, *plane) < 0.01 * extent_of(model));
    CHECK(mesh::norm(plane->normal) == doctest::Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("a_model_without_symmetry_has_no_plane") {
  CHECK_FALSE(cages::symmetry_plane(lopsided(), nullptr));
  CHECK_FALSE(cages::symmetry_plane(soup(300, 0.1, 1), nullptr));
  CHECK_FALSE(cages::symmetry_plane(points_only(cube().positions), nullptr));
}

TEST_CASE("cages_are_symmetric_and_enclose_asymmetric_models") {
  base::WorkerPool pool(2);
  const mesh::Surface model = lopsided();
  for (const auto symmetry : {cages::Symmetry::x, cages::Symmetry::z}) {
    const cages::Wish wish{.triangles = 80, .symmetry = symmetry};
    const auto made = cages::make(model, wish, pool);
    REQUIRE(made.mirror);
    CHECK(made.mirror->normal[static_cast<std::size_t>(symmetry) -
                              static_cast<std::size_t>(cages::Symmetry::x)] == 1);
    for (const std::string& complaint : complaints(made, model, wish)) FAIL_CHECK(complaint);
  }
  CHECK_FALSE(cages::make(model, {.triangles = 80}, pool).mirror);
  CHECK(cages::make(two_sided(lopsided()), {.triangles = 80}, pool).mirror);
}

TEST_CASE("triangles_of_a_cube_pair_to_its_faces") {
  const mesh::Surface box = cube();
  const cages::Shell shell{box.positions, box.triangles};
  const auto pairs = cages::quad_pairs(shell);
  CHECK(pairs.size() == 6);
  const mesh::Surface quads = cages::with_quads(shell, pairs);
  check_invariants(quads);
  CHECK(quads.polygon_count() == 6);
  CHECK(mesh::summarize(quads).volume == doctest::Approx(8));
}

TEST_CASE("every_triangle_is_in_at_most_one_pair") {
  const mesh::Surface ball = sphere(3);
  const cages::Shell shell{ball.positions, ball.triangles};
  const auto pairs = cages::quad_pairs(shell);
  std::vector<int> taken(ball.triangles.size(), 0);
  for (const auto& [s, t] : pairs) {
    ++taken[s];
    ++taken[t];
  }
  CHECK(std::ranges::max(taken) == 1);
  const mesh::Surface quads = cages::with_quads(shell, pairs);
  check_invariants(quads);
  auto before = ball.triangles, after = quads.triangles;
  const auto from_least = [](auto& triangles) {
    for (auto& t : triangles) std::ranges::rotate(t, std::ranges::min_element(t));
    std::ranges::sort(triangles);
  };
  from_least(before);
  from_least(after);
  CHECK(before == after);
}

TEST_CASE("triangles_across_a_sharp_edge_are_not_paired") {
  CHECK(cages::quad_pairs(
            {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}})
            .empty());
}

TEST_CASE("cages_with_quads_have_many_quads_and_enclose_the_model_with_their_centers") {
  base::WorkerPool pool(2);
  for (const auto& model : {stool(), sphere(3)}) {
    const auto made = cages::make(model, {.triangles = 200, .quads = true}, pool);
    const std::size_t quads = made.surface.triangles.size() - made.surface.polygon_count();
    CHECK(5 * quads > made.surface.triangles.size());  // more than two fifths of the triangles are in quads
    CHECK(cages::soundness(made.surface, model, pool).sound());
  }
}
