#include "bench/models.h"
#include "bench/reference_frame.h"
#include "deform/frame_deformer.h"
#include "mesh/triangle_tree.h"
#include "support/caged_shapes.h"
#include "support/shapes.h"
#include "weights/bind.h"

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

// Checks PlainWeights against an independent implementation.
TEST_CASE("plain_weights_are_inverse_squared_distances_that_sum_to_one") {
  const auto model = test::sphere(2);
  const auto cage = pose::make_cage(test::moved(test::cube(), 1.7));
  const std::size_t n = model.positions.size(), k = cage.element_count();
  bench::PlainWeights plain(n, k);
  plain.compute(model.positions, cage);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> row(k);
    double sum = 0;
    for (std::size_t j = 0; j < k; ++j) {
      const auto& t = cage.elements.triangles[j];
      const auto& p = cage.elements.positions;
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
  const auto cage = std::make_shared<const pose::Cage>(pose::make_cage(bench::star_cage(model, 50)));
  base::WorkerPool pool(1);
  const auto binding = std::make_shared<const weights::Binding>(weights::bind(model, *cage, {}, pool));
  deform::FrameDeformer staged(cage, binding, pose::Deformer{binding->weighting}, pool);
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

// Returns the unit square, divided along the diagonal from (1, 0) to (0, 1).
mesh::Surface square() {
  return mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
}

// Returns the square with its corner (1, 1) rotated about the diagonal.
std::vector<mesh::Point> folded(double angle) {
  auto positions = square().positions;
  const double out = std::cos(angle) / 2;  // the distance from the middle of the diagonal
  positions[3] = {0.5 + out, 0.5 + out, std::sin(angle) / std::sqrt(2)};
  return positions;
}

template <class Map>
std::vector<mesh::Point> mapped(const RestModel& model, const Map& map) {
  return test::mapped(model.positions(), map);
}

}  // namespace

TEST_CASE("rigid_motions_have_no_energy_and_uniform_scaling_has_energy_alone") {
  const RestModel model(test::torus(30, 12));
  CHECK(model.encloses());
  for (const double scale : {1.0, 2.0}) {
    const auto positions = mapped(model, test::similarity({1, 2, 3}, 2, scale, {5, 6, 7}));
    CHECK(model.distortion(positions).energy ==
          doctest::Approx(2 * scale * scale + 2 / (scale * scale) - 4).epsilon(1e-12));
    CHECK(model.distortion(positions).collapsed == 0);
    CHECK(model.volume(positions) == doctest::Approx(scale * scale * scale).epsilon(1e-12));
    CHECK(model.bending(positions) < 1e-20);
  }
}

TEST_CASE("the_energy_is_that_of_the_jacobians_weighted_by_area") {
  const RestModel model(square());
  const test::Affine stretch{{2, 0, 0, 0, 1, 0, 0, 0, 1}}, shear{{1, 1, 0, 0, 1, 0, 0, 0, 1}};
  CHECK(model.distortion(mapped(model, stretch)).energy == doctest::Approx(4 + 1 + 0.25 + 1 - 4));
  CHECK(model.distortion(mapped(model, shear)).energy == doctest::Approx(2));
  CHECK(std::isnan(model.volume(model.positions())));
  CHECK_FALSE(model.encloses());
  // The triangles have areas 1/2 and 3/2, and no common corner. The second triangle is stretched.
  const RestModel two(mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 3, 5}},
                                           {{0, 1, 2}, {3, 4, 5}}));
  auto positions = two.positions();
  positions[4][0] = 2;
  CHECK(two.distortion(positions).energy == doctest::Approx(0.75 * 2.25));
  CHECK(two.vertex_shares()[0] == doctest::Approx(0.25 / 3));
  CHECK(two.vertex_shares()[5] == doctest::Approx(0.75 / 3));
}

TEST_CASE("a_fold_bends_by_the_square_of_its_angle") {
  const RestModel model(square());
  // In RestModel::bending(), 3 |e|^2 / A is 3 * 2 / 1 here.
  for (const double angle : {0.5, -0.5, 3.0}) {
    CHECK(model.bending(folded(angle)) == doctest::Approx(6 * angle * angle));
    CHECK(std::abs(model.distortion(folded(angle)).energy) < 1e-12);
  }
  // From a fold of 3 radians to one of -3, the shorter way is 2 pi - 6. It passes pi, the complete fold.
  auto creased = square();
  creased.positions = folded(3.0);
  const double turned = 2 * std::numbers::pi - 6;
  CHECK(RestModel(creased).bending(folded(-3.0)) == doctest::Approx(6 * turned * turned));
}

TEST_CASE("triangles_without_area_are_left_out_and_those_that_collapse_are_counted") {
  auto surface = square();
  surface = mesh::from_triangles(surface.positions, {{0, 1, 2}, {1, 3, 2}, {0, 1, 1}, {0, 3, 0}});
  const RestModel model(surface);
  CHECK(model.without_area() == 2);
  CHECK(model.distortion(model.positions()).energy == 0);
  auto positions = model.positions();
  positions[3] = {0.5, 0.5, 0};  // on the diagonal
  CHECK(model.distortion(positions).collapsed == 1);
  CHECK(std::isinf(model.distortion(positions).energy));
  for (auto& p : positions) p = {1, 1, 1};
  CHECK(model.distortion(positions).collapsed == 2);
  CHECK_THROWS_AS(RestModel(mesh::from_triangles(surface.positions, {{0, 1, 1}})), base::Error);
}
