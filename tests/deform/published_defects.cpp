// Defects of published cage deformers. Each line has a number, a defect, and the test or file that finds it.
//
//  2 Translations blended about the world's origin: rotating_model_cage_and_pose_rotates_the_result
//  3 Distances depend on units: weights_are_the_same_at_every_length_scale_and_finite_everywhere
//  4 Barycentric coordinates use a wrong axis: weights_match_their_definition_in_long_double
//  5 Infinite distances: weights_exist_on_both_sides_of_every_face_and_do_not_jump_across_its_plane
//  6 NaN weights: vertices_on_faces_edges_and_corners_of_the_cage_have_weights_in_every_deformer
//  7 Rotations about the world's origin: maps_fitted_to_points_are_exact_far_from_the_origin
//  8 Whole turns: nearest_branch_is_among_all_turns_about_the_axis_of_the_rotation_or_else_of_the_reference
//  9 Branches depend only on earlier frames: neighbours_turned_by_179_and_181_degrees_blend_to_180
// 10 Mirroring maps have no rotation: singular_and_mirroring_matrices_have_a_proper_rotation
// 11 Uniform scaling stretches two directions: every_deformer_keeps_rest_and_follows_similarities
// 12 Sums below 1 are ignored: frames_of_every_deformer_agree_with_an_evaluation_in_quad_precision
// 14, 15 Log and exponential lose digits where eigenvalues coincide: tests/sym3
// 16 Rest is the first frame's pose: a_frame_does_not_depend_on_the_frames_before
// 17 Stitched surfaces have undetermined vertices, races, and thresholds with units: stitching.cpp
// 18 Harmonic weights leave [0, 1]: harmonic_weights_are_between_0_and_1_for_any_triangles
// 19 Masks: shares_scale_rotation_stretch_and_translation_about_the_centre_of_the_handles
// 20 Too much memory: a_binding_for_frames_takes_at_most_a_quarter_of_distances_and_weights_in_double

#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

namespace {

// Returns each weighting that a deformer uses, without repetitions.
std::vector<Weighting> all_weightings() {
  std::vector<Weighting> all;
  for (const Deformer& s : whole_deformers())
    if (std::ranges::find(all, s.weighting) == all.end()) all.push_back(s.weighting);
  return all;
}

std::span<const double> weights_of(const Binding& b, std::size_t vertex) {
  return std::span(b.weights).subspan(vertex * b.handles, b.handles);
}

double total_of(std::span<const double> numbers) {
  double sum = 0;
  for (const double x : numbers) sum += x;
  return sum;
}

}  // namespace

TEST_CASE("weights_exist_on_both_sides_of_every_face_and_do_not_jump_across_its_plane") {
  const auto surface = box({1, 1.1, 1.2});
  const Cage cage = make_cage(surface);
  Random random(6);
  mesh::Surface points;  // pairs of points on both sides of a plane
  for (int n = 0; n < 20; ++n)
    for (const auto& [i, j, k] : surface.triangles) {
      const Vec3 &a = surface.positions[i], u = surface.positions[j] - a, v = surface.positions[k] - a;
      const Vec3 on = a + random(-2, 3) * u + random(-2, 3) * v, across = cross(u, v);
      for (const double side : {1e-8, -1e-8}) points.positions.push_back(on + side * across);
    }
  base::WorkerPool pool(1);
  for (const Weighting& weighting : all_weightings()) {
    if (weighting.on_surface()) continue;
    CAPTURE(text({weighting}));
    const Binding b = bind(points, cage, weighting, pool);
    for (std::size_t i = 0; i < b.vertices; i += 2) {
      const auto before = weights_of(b, i), behind = weights_of(b, i + 1);
      CHECK(largest_difference(before, behind) < 1e-4);
      CHECK(total_of(before) == doctest::Approx(1));
    }
  }
}

TEST_CASE("vertices_on_faces_edges_and_corners_of_the_cage_have_weights_in_every_deformer") {
  const auto surface = box({1, 1.1, 1.2});
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (const auto& face : surface.triangles) {  // splits the face into six triangles about its center
    const auto first = static_cast<std::uint32_t>(p.size());
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = surface.positions[face[i]], &b = surface.positions[face[(i + 1) % 3]];
      p.push_back(a);
      p.push_back(0.5 * (a + b));
    }
    p.push_back((1.0 / 3) * (p[first] + p[first + 2] + p[first + 4]));
    for (std::uint32_t i = 0; i < 6; ++i) t.push_back({first + 6, first + i, first + (i + 1) % 6});
  }
  const auto model = mesh::from_triangles(p, t);
  const auto map = similarity({1, -2, 3}, 2, 1, {1, 2, 3});
  for (const Deformer& deformer : whole_deformers()) {
    CAPTURE(text(deformer));
    Bound b(model, surface, deformer.weighting, 1, deformer.blend);
    for (std::size_t i = 0; i < p.size(); ++i)
      CHECK(total_of(weights_of(*b.binding, i)) == doctest::Approx(1).epsilon(1e-10));  // also fails for NaN
    CHECK(b.error(map) < 1e-10);
    CHECK(all_finite(b.deform(b.pose(shear()))));
  }
}

TEST_CASE("neighbours_turned_by_179_and_181_degrees_blend_to_180") {
  const Twist twist{2, {0, 0, 0}, -0.9, 0.9, 179 * degree, 181 * degree};
  const auto half_a_turn = similarity({0, 0, 1}, 180 * degree);
  for (const Deformer& deformer : whole_deformers()) {
    CAPTURE(text(deformer));
    Bound b(tube(5, 6, 0.3, 1.4), tube(5, 5, 0.5, 1.8), deformer.weighting, 1, deformer.blend);
    const double off = largest_distance(b.deform(b.pose(twist)), mapped(b.model.positions, half_a_turn));
    CHECK(off < 1.5 * degree * 0.5);  // would be 0.6 if rotations blended to 0
  }
}

TEST_CASE("a_binding_for_frames_takes_at_most_a_quarter_of_distances_and_weights_in_double") {
  const double pair = 2 * sizeof(double);
  for (const Weighting& weighting : all_weightings()) {
    CAPTURE(text({weighting}));
    if (weighting.on_surface()) continue;  // solving for these weights needs memory
    CHECK(static_cast<double>(binding_bytes(800'000, 300, EngineKind::fused, weighting)) <
          800e3 * (300 * pair / 4 + 200));
  }
  // The solver is freed before solved weights are compressed. Beyond 80,000 vertices, weights of 40,000
  // count.
  const Weighting surface{Elements::face, Weights::biharmonic};
  CHECK(static_cast<double>(binding_bytes(50'000, 220, EngineKind::fused, surface)) < 125e6);
  CHECK(static_cast<double>(binding_bytes(537'374, 90, EngineKind::fused, surface)) < 160e6);
  // After binding, a few empty slots increase the size.
  const auto model = tube(51, 50, 0.3, 1.4);
  const Cage cage = make_cage(tube(12, 12, 0.5, 1.8));
  base::WorkerPool pool(2);
  const double pairs = static_cast<double>(model.positions.size() * cage.element_count());
  for (const Weighting& weighting : {faces, test::cut_off(0.2)}) {
    const Binding b = weights::bind(mesh::lent(model), cage, weighting, EngineKind::fused, nullptr, pool);
    CHECK(b.weights.empty());
    CHECK(static_cast<double>(b.tiles->bytes()) < 0.26 * pair * pairs);
  }
}
