#include "bench/models.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "bench/plain_weights.h"
#include "bench/reference_frame.h"
#include "deform/binding.h"
#include "deform/deformer.h"
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

TEST_CASE("a_star_cage_has_so_many_faces_and_encloses_the_model") {
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

// What binding is compared with is right, by distances that were written apart from it.
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

TEST_CASE("reference_frame_is_the_staged_frame_by_other_means") {
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
