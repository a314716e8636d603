#include <doctest/doctest.h>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "bench/models.h"
#include "bench/reference_frame.h"
#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/deformer.h"
#include "deform/shapes.h"
#include "mesh/shapes.h"
#include "mesh/summary.h"
#include "mesh/triangle.h"
#include "mesh/winding_number.h"

using namespace viete;

TEST_CASE("subdividing_cuts_each_triangle_into_four_and_keeps_the_surface") {
  const auto cube = test::cube(), finer = bench::subdivided(cube);
  CHECK(finer.triangles.size() == 4 * cube.triangles.size());
  CHECK(mesh::summarize(finer).closed());
  CHECK(mesh::summarize(finer).area == doctest::Approx(24));
}

TEST_CASE("a_star_cage_has_the_requested_faces_and_encloses_the_model") {
  const auto model = test::moved(test::torus(40, 20), 3, 100);
  for (const std::size_t faces : {8, 50, 300}) {
    const auto cage = bench::star_cage(model, faces);
    CHECK(cage.triangles.size() == faces);
    CHECK(mesh::summarize(cage).closed());
    CHECK(mesh::summarize(cage).volume > 0);
    CHECK(mesh::points_outside(cage, model.positions).empty());
  }
}

TEST_CASE("the_moderate_pose_moves_every_vertex_and_is_the_same_each_time") {
  const auto cage = deform::make_cage(bench::star_cage(test::sphere(2), 50));
  const auto pose = bench::moderate_pose(cage);
  CHECK(pose.positions == bench::moderate_pose(cage).positions);
  for (std::size_t v = 0; v < pose.positions.size(); ++v)
    CHECK(pose.positions[v] != cage.surface.positions[v]);
}

// The distances of the binding benchmark's reference, checked by an independent implementation.
TEST_CASE("plain_weights_are_inverse_squared_distances_that_sum_to_one") {
  const auto model = test::sphere(2);
  const auto cage = deform::make_cage(test::moved(test::cube(), 1.7));
  const std::size_t n = model.positions.size(), k = cage.element_count();
  bench::PlainWeights plain(n, k);
  plain.compute(model.positions, cage);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> row(k);
    double sum = 0;
    for (std::size_t j = 0; j < k; ++j) {
      const auto& t = cage.surface.triangles[j];
      const auto& p = cage.surface.positions;
      const double d2 =
          mesh::closest_on_triangle(model.positions[i], p[t[0]], p[t[1]], p[t[2]]).squared_distance;
      sum += row[j] = 1 / d2;
    }
    for (std::size_t j = 0; j < k; ++j)
      CHECK(plain.weights()[i * k + j] == doctest::Approx(row[j] / sum).epsilon(1e-12));
  }
}

TEST_CASE("reference_frame_equals_the_staged_frame") {
  const auto model = test::sphere(2);
  const auto cage = std::make_shared<const deform::Cage>(deform::make_cage(bench::star_cage(model, 50)));
  base::WorkerPool pool(1);
  const auto binding = std::make_shared<const deform::Binding>(deform::bind(model, *cage, {}, pool));
  deform::Deformer staged(cage, binding, deform::Scheme{binding->weighting}, pool);
  bench::ReferenceFrame reference(*cage, *binding);
  const auto pose = bench::moderate_pose(*cage);
  staged.deform(pose, sym3::Method::diag);
  reference.deform(pose);
  const auto positions = staged.positions(), normals = staged.normals();
  for (std::size_t v = 0; v < positions.size(); ++v) {
    CHECK(mesh::norm(reference.positions()[v] - positions[v]) < 1e-9 * cage->diagonal);
    CHECK(mesh::norm(reference.normals()[v] - normals[v]) < 1e-7);
  }
}

using bench::RestModel;

namespace {

// The unit square, cut along the diagonal from (1, 0) to (0, 1).
mesh::Surface square() {
  return mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
}

// Its corner (1, 1) rotated about the diagonal.
std::vector<mesh::Point> folded(double angle) {
  auto positions = square().positions;
  const double out = std::cos(angle) / 2;  // from the middle of the diagonal
  positions[3] = {0.5 + out, 0.5 + out, std::sin(angle) / std::sqrt(2)};
  return positions;
}

template <class Map>
std::vector<mesh::Point> mapped(const RestModel& model, const Map& map) {
  return test::mapped(model.positions(), map);
}

}  // namespace

TEST_CASE("a_model_at_rest_and_a_turned_one_have_no_energy_no_shear_and_all_their_volume") {
  const RestModel model(test::torus(30, 12));
  CHECK(model.encloses());
  for (const auto& positions :
       {model.positions(), mapped(model, test::similarity({1, 2, 3}, 2, 1, {5, 6, 7}))}) {
    const auto distortion = model.distortion(positions);
    CHECK(std::abs(distortion.energy) < 1e-12);
    CHECK(distortion.worst_shear == doctest::Approx(1).epsilon(1e-7));
    CHECK(distortion.collapsed == 0);
    CHECK(model.volume(positions) == doctest::Approx(1).epsilon(1e-12));
    CHECK(model.bending(positions) < 1e-20);
  }
}

TEST_CASE("a_model_of_twice_the_size_has_energy_alone") {
  const RestModel model(test::sphere(2));
  const auto positions = mapped(model, test::similarity({0, 0, 1}, 1, 2));
  const auto distortion = model.distortion(positions);
  CHECK(distortion.energy == doctest::Approx(2 * 4 + 2 * 0.25 - 4).epsilon(1e-12));
  CHECK(distortion.median_shear == doctest::Approx(1).epsilon(1e-7));
  CHECK(model.volume(positions) == doctest::Approx(8).epsilon(1e-12));
  CHECK(model.bending(positions) < 1e-20);
}

TEST_CASE("a_sheet_stretched_one_way_has_the_energy_and_shear_of_its_jacobian") {
  const RestModel model(square());
  const test::Affine stretch{{2, 0, 0, 0, 1, 0, 0, 0, 1}}, shear{{1, 1, 0, 0, 1, 0, 0, 0, 1}};
  const auto stretched = model.distortion(mapped(model, stretch));
  CHECK(stretched.energy == doctest::Approx(4 + 1 + 0.25 + 1 - 4));
  CHECK(stretched.median_shear == doctest::Approx(2));
  // J = (1 1; 0 1): |J|^2 = |J^-1|^2 = 3, singular values golden and its inverse.
  const auto sheared = model.distortion(mapped(model, shear));
  CHECK(sheared.energy == doctest::Approx(2));
  CHECK(sheared.worst_shear == doctest::Approx(std::numbers::phi * std::numbers::phi));
  CHECK(std::isnan(model.volume(model.positions())));  // it is open
  CHECK_FALSE(model.encloses());
}

TEST_CASE("the_energy_is_a_mean_by_area_and_the_worst_shear_that_of_one_triangle") {
  // Triangles of area 1/2 and 3/2 with no corner in common, the second one stretched twice.
  const RestModel model(mesh::from_triangles(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 3, 5}}, {{0, 1, 2}, {3, 4, 5}}));
  auto positions = model.positions();
  positions[4][0] = 2;
  const auto distortion = model.distortion(positions);
  CHECK(distortion.energy == doctest::Approx(0.75 * 2.25));
  CHECK(distortion.worst_shear == doctest::Approx(2));
  const auto& shares = model.vertex_shares();
  CHECK(shares[0] == doctest::Approx(0.25 / 3));
  CHECK(shares[5] == doctest::Approx(0.75 / 3));
}

TEST_CASE("a_fold_bends_by_the_square_of_its_angle") {
  const RestModel model(square());
  // 3 |e|^2 / A = 3 * 2 / 1.
  for (const double angle : {0.5, -0.5, 3.0}) {
    CHECK(model.bending(folded(angle)) == doctest::Approx(6 * angle * angle));
    CHECK(std::abs(model.distortion(folded(angle)).energy) < 1e-12);
  }
  // From folded one way to folded the other way, the shorter way through the flat sheet.
  auto creased = square();
  creased.positions = folded(3.0);
  const double turned = 2 * std::numbers::pi - 6;
  CHECK(RestModel(creased).bending(folded(-3.0)) == doctest::Approx(6 * turned * turned));
}

TEST_CASE("refinement_keeps_smooth_bending_and_increases_bending_at_kinks") {
  const auto bending = [](int levels, const auto& map) {
    const RestModel model(test::sphere(levels));
    return model.bending(mapped(model, map));
  };
  const auto smooth = [](const mesh::Point& p) { return mesh::Point{p[0], p[1], p[2] + 0.3 * p[0] * p[0]}; };
  const auto kinked = [](const mesh::Point& p) {
    return mesh::Point{p[0], p[1], p[2] + 0.3 * std::abs(p[0])};
  };
  CHECK(bending(4, smooth) == doctest::Approx(bending(3, smooth)).epsilon(0.1));
  CHECK(bending(4, kinked) > 1.5 * bending(3, kinked));
}

TEST_CASE("triangles_without_area_are_left_out_and_those_that_collapse_are_counted") {
  auto surface = square();
  surface = mesh::from_triangles(surface.positions, {{0, 1, 2}, {1, 3, 2}, {0, 1, 1}, {0, 3, 0}});
  const RestModel model(surface);
  CHECK(model.without_area() == 2);
  CHECK(model.distortion(model.positions()).energy == 0);
  auto positions = model.positions();
  positions[3] = {0.5, 0.5, 0};  // on the diagonal
  const auto line = model.distortion(positions);
  CHECK(line.collapsed == 1);
  CHECK(std::isinf(line.energy));
  CHECK(std::isinf(line.worst_shear));
  for (auto& p : positions) p = {1, 1, 1};
  CHECK(model.distortion(positions).collapsed == 2);
  CHECK(std::isinf(model.distortion(positions).median_shear));
  CHECK_THROWS_AS(RestModel(mesh::from_triangles(surface.positions, {{0, 1, 1}})), base::Error);
}
