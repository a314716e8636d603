// Results depend on the polygons of cage and model, and not on their triangles or order.

#include "deform/bound.h"
#include "shapes/spaces.h"
#include "support/shapes.h"
#include "weights/point_weights.h"

using namespace viete;
using namespace viete::test;

namespace {

using Faces = std::vector<std::vector<std::uint32_t>>;

mesh::Surface polygons(std::vector<mesh::Point> positions, const Faces& faces) {
  mesh::Surface s{std::move(positions), {}, {0}, {}, {}, {}};
  for (const auto& face : faces) {
    s.corners.insert(s.corners.end(), face.begin(), face.end());
    s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
  }
  mesh::triangulate(s);
  return s;
}

Faces faces_of(const mesh::Surface& s) {
  Faces faces;
  for (std::size_t p = 0; p < s.polygon_count(); ++p)
    faces.emplace_back(s.corners.begin() + s.polygon_starts[p], s.corners.begin() + s.polygon_starts[p + 1]);
  return faces;
}

// Returns a prism along z around the unit ball. Its first face is the ring at the bottom, then the sides.
mesh::Surface prism(const std::vector<std::array<double, 2>>& ring) {
  const auto n = static_cast<std::uint32_t>(ring.size());
  std::vector<mesh::Point> positions;
  for (const double z : {-1.3, 1.3})
    for (const auto& [x, y] : ring) positions.push_back({x, y, z});
  Faces faces(2);
  for (std::uint32_t i = 0; i < n; ++i) {
    faces[0].insert(faces[0].begin(), i);
    faces[1].push_back(n + i);
    faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  return polygons(std::move(positions), faces);
}

// A cube; a cube with a vertex in the middle of an edge; prisms: over a hexagon, an L and a deep notch.
std::vector<mesh::Surface> polygon_cages() {
  const mesh::Surface cube = moved(test::cube(), 1.2);
  auto faces = faces_of(cube);
  faces[0] = {0, 2, 3, 1, 8};
  faces[2] = {0, 8, 1, 5, 4};
  auto positions = cube.positions;
  positions.push_back({0, -1.2, -1.2});
  return {cube, polygons(positions, faces),
          prism({{1.4, 0}, {0.7, 1.3}, {-0.7, 1.3}, {-1.4, 0}, {-0.7, -1.3}, {0.7, -1.3}}),
          prism({{-1.2, -1.2}, {3, -1.2}, {3, 1.2}, {1.2, 1.2}, {1.2, 3}, {-1.2, 3}}),
          prism({{-1.2, -1.2}, {1.2, -1.2}, {1.2, 5}, {0.8, 5}, {0, 1.2}, {-0.4, 5}, {-1.2, 5}})};
}

std::vector<mesh::Point> deformed(const mesh::Surface& model, const mesh::Surface& cage,
                                  const std::vector<mesh::Point>& pose, const Deformer& deformer) {
  base::WorkerPool pool(1);
  return deform::deform_exactly(model, std::make_shared<const Cage>(make_cage(cage)), deformer, {pose, {}},
                                sym3::Method::diag, pool)
      .positions;
}

std::vector<Deformer> every_deformer() {
  auto deformers = valid_deformers();
  for (const Preset preset : base::all_values<Preset>()) deformers.push_back(deformer_of(preset));
  return deformers;
}

mesh::Surface jittered(mesh::Surface s, double by) {
  Random random(7);
  for (auto& p : s.positions) p = p + random.vector(by);
  return s;
}

// Returns the surface with its faces in reverse order and with other first corners.
mesh::Surface reordered(const mesh::Surface& s) {
  auto faces = faces_of(s);
  std::ranges::reverse(faces);
  for (std::size_t f = 0; f < faces.size(); ++f)
    std::ranges::rotate(faces[f], faces[f].begin() + 1 + static_cast<std::ptrdiff_t>(f % 3));
  return polygons(s.positions, faces);
}

}  // namespace

TEST_CASE("no_deformer_depends_on_the_first_corners_or_the_order_of_the_cages_faces") {
  const mesh::Surface model = jittered(test::sphere(2), 0.01);
  for (const mesh::Surface& cage : polygon_cages()) {
    const auto pose = jittered(cage, 0.4).positions;
    const mesh::Surface other = reordered(cage);
    for (const Deformer& deformer : every_deformer()) {
      CAPTURE(text(deformer));
      CAPTURE(cage.positions.size());
      const auto one = deformed(model, cage, pose, deformer);
      CHECK(largest_distance(one, deformed(model, other, pose, deformer)) < 1e-12);
      CHECK((deformer.weighting.partial() || largest_distance(one, model.positions) > 0.05));
    }
  }
}

// Returns the dual of a surface of triangles: one polygon per vertex.
mesh::Surface dual(const mesh::Surface& s) {
  std::vector<mesh::Point> centers;
  std::vector<std::map<std::uint32_t, std::array<std::uint32_t, 2>>> steps(s.positions.size());
  for (const auto& t : s.triangles) {
    for (std::size_t k = 0; k < 3; ++k)  // around t[k], the triangle leads from one neighbour to the next
      steps[t[k]][t[(k + 1) % 3]] = {t[(k + 2) % 3], static_cast<std::uint32_t>(centers.size())};
    centers.push_back(s.positions[t[0]] + s.positions[t[1]] + s.positions[t[2]]);
  }
  Faces faces;
  for (const auto& step : steps) {
    auto& face = faces.emplace_back();
    for (auto at = step.begin()->first; face.size() < step.size(); at = step.at(at)[0])
      face.push_back(step.at(at)[1]);
  }
  return polygons(std::move(centers), faces);
}

mesh::Surface in_quads(const mesh::Surface& s) {
  auto positions = s.positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, added] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(positions.size()));
    if (added) positions.push_back(s.positions[a] + s.positions[b]);
    return at->second;
  };
  Faces quads;
  for (const auto& face : faces_of(s)) {
    const auto center = static_cast<std::uint32_t>(positions.size());
    positions.push_back({0, 0, 0});
    for (std::size_t i = 0, n = face.size(); i < n; ++i) {
      positions[center] = positions[center] + s.positions[face[i]];
      quads.push_back(
          {face[i], middle(face[i], face[(i + 1) % n]), center, middle(face[i], face[(i + n - 1) % n])});
    }
  }
  return polygons(std::move(positions), quads);
}

// Models of bent polygons that are symmetric in x: of 4 and 6 corners; of 5 and 6 corners; of quads.
std::vector<mesh::Surface> polygon_models() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const mesh::Surface icosahedron =
      sphere_from({{-1, g, 0},
                   {1, g, 0},
                   {-1, -g, 0},
                   {1, -g, 0},
                   {0, -1, g},
                   {0, 1, g},
                   {0, -1, -g},
                   {0, 1, -g},
                   {g, 0, -1},
                   {g, 0, 1},
                   {-g, 0, -1},
                   {-g, 0, 1}},
                  {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                   {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                   {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}},
                  1);
  std::vector<mesh::Surface> models{dual(test::sphere(1)), dual(icosahedron),
                                    in_quads(dual(test::sphere(1)))};
  for (auto& model : models) {
    for (auto& p : model.positions) {
      p = (1 / norm(p)) * p;
      p = {p[0] * (1 + 0.2 * p[1]), p[1] + 0.1 * p[2] * p[0] * p[0], p[2] * (1 + 0.2 * p[1])};
    }
    mesh::triangulate(model);
  }
  return models;
}

// Returns the shape halfway between the model and a bent shape.
std::vector<mesh::Point> halfway(const mesh::Surface& model) {
  const auto bent = mapped(model.positions, [](const Vec3& p) {
    const double a = 1.2 * p[2];
    return Vec3{p[0] * std::exp(0.3 * p[1]), std::cos(a) * p[1] - std::sin(a) * p[2],
                std::sin(a) * p[1] + std::cos(a) * p[2]};
  });
  base::WorkerPool pool(1);
  const ShapeSpace space(model, pool);
  const LogVector from = space.vector(model.positions, pool), to = space.vector(bent, pool);
  const LogTerm terms[] = {{&from, 0.5}, {&to, 0.5}};
  LogSpace::Work work;
  std::vector<mesh::Point> half(bent.size());
  space.shape(terms, space.logs().anchors_between(from, to), pool, work, half);
  return half;
}

TEST_CASE("models_of_bent_polygons_deform_symmetrically_whatever_their_first_corners_and_their_order") {
  const mesh::Surface cage = moved(test::cube(), 1.5);
  const auto pose = mapped(cage.positions, [](const Vec3& p) {
    return Vec3{p[0] * (1 + 0.3 * p[1]), p[1] + 0.4 * p[2] * p[2] * p[1], p[2] + 0.5 * p[0] * p[0]};
  });
  const auto image = [](const Vec3& p) { return Vec3{-p[0], p[1], p[2]}; };
  for (const mesh::Surface& model : polygon_models()) {
    CAPTURE(model.polygon_count());
    std::vector<std::size_t> mirrored;
    for (const auto& p : model.positions) {
      const auto distance = [&](const Vec3& q) { return norm(q - image(p)); };
      const auto nearest = std::ranges::min_element(model.positions, {}, distance);
      REQUIRE(distance(*nearest) < 1e-14);
      mirrored.push_back(static_cast<std::size_t>(nearest - model.positions.begin()));
    }
    const mesh::Surface other = reordered(model);
    const auto check = [&](const auto& shape) {
      const std::vector<mesh::Point> there = shape(model);
      std::vector<mesh::Point> images;
      for (const auto v : mirrored) images.push_back(image(there[v]));
      CHECK(largest_distance(there, images) < 1e-12);
      CHECK(largest_distance(there, shape(other)) < 1e-12);
    };
    check(halfway);
    auto deformers = every_deformer();
    deformers.push_back(deformer_of(Preset::arap));
    deformers.back().iterations = 3;
    for (const Deformer& deformer : deformers) {
      CAPTURE(text(deformer));
      check([&](const mesh::Surface& s) { return deformed(s, cage, pose, deformer); });
    }
  }
}

TEST_CASE("affine_poses_of_polygon_cages_are_exact_and_unmoved_ones_keep_every_vertex") {
  for (const mesh::Surface& cage : polygon_cages())
    for (const Deformer& deformer : whole_deformers()) {
      CAPTURE(text(deformer));
      Bound b(test::sphere(2), jittered(cage, 0.02), deformer.weighting, 1, deformer.blend);
      CHECK(largest_distance(b.deform(rest_pose(*b.cage)), b.model.positions) < 1e-14 * b.cage->diagonal);
      CHECK(b.error(similarity({1, -2, 3}, 40 * degree, 1.0, {2, 1, -1})) < 1e-12);
      const bool promised =
          deformer.weighting.weights == Weights::mean_value || deformer.blend == Blend::mls_affine;
      if (promised) CHECK(b.error(shear()) < 1e-12);
    }
}

TEST_CASE("splitting_at_the_center_changes_no_triangle_and_counts_a_quad_as_two_triangles") {
  const Cage triangles = make_cage(test::sphere(1)), quads = make_cage(test::cube());
  CHECK(triangles.elements.triangles == triangles.surface.triangles);
  CHECK(triangles.elements.positions == triangles.surface.positions);
  CHECK(quads.element_count() == 24);
  CHECK(quads.closed);
  for (std::size_t e = 0; e < 24; ++e) CHECK(handle_shape(quads, Elements::face, e).share == 0.5);
}

TEST_CASE("mean_value_coordinates_are_continuous_across_the_faces_of_polygon_cages") {
  for (const mesh::Surface& cage : polygon_cages()) {
    const Cage c = make_cage(jittered(cage, 0.02));
    std::vector<double> on(c.surface.positions.size()), beside(on.size());
    for (std::size_t e = 0; e < c.element_count(); ++e) {
      if (c.degenerate[e]) continue;
      const Vec3 inward = -1e-7 * c.bases[e].n;
      CHECK(mean_value_weights(c, c.centers[e], on));
      CHECK(mean_value_weights(c, c.centers[e] + inward, beside));
      for (std::size_t j = 0; j < on.size(); ++j) CHECK(std::abs(on[j] - beside[j]) < 1e-4);
    }
  }
}

TEST_CASE("a_repeated_face_of_a_cage_is_ignored_with_a_note") {
  auto faces = faces_of(test::cube());
  faces.push_back({faces[2][1], faces[2][2], faces[2][3], faces[2][0]});
  const mesh::Surface once = moved(test::cube(), 1.2), twice = polygons(once.positions, faces);
  const Cage cage = make_cage(twice);
  REQUIRE(cage.warnings.size() == 1);
  CHECK(cage.warnings[0] == "1 cage face repeats another face and is ignored: 6");
  CHECK(cage.closed);
  const mesh::Surface model = jittered(test::sphere(2), 0.01);
  const auto pose = jittered(once, 0.3).positions;
  for (const Preset preset : base::all_values<Preset>())
    CHECK(largest_distance(deformed(model, twice, pose, deformer_of(preset)),
                           deformed(model, once, pose, deformer_of(preset))) < 1e-13);
}

TEST_CASE("a_symmetric_model_and_cage_in_a_symmetric_pose_deform_symmetrically") {
  const mesh::Surface cage = moved(test::cube(), 1.2);
  auto pose = cage.positions;
  for (auto& p : pose)
    p = {p[0] * (1 + 0.3 * p[1]), p[1] + 0.4 * p[2] * p[2] * p[1], p[2] + 0.5 * p[0] * p[0]};
  pose[2] = pose[2] + Vec3{0.2, 0.5, -0.3};
  pose[3] = pose[3] + Vec3{-0.2, 0.5, -0.3};  // mirror images
  for (const int levels : {2, 3, 4}) {
    const mesh::Surface ball = test::sphere(levels);
    const auto image = [](const Vec3& p) { return Vec3{-p[0], p[1], p[2]}; };
    std::vector<std::size_t> mirrored;
    for (const auto& p : ball.positions)
      mirrored.push_back(
          static_cast<std::size_t>(std::ranges::find(ball.positions, image(p)) - ball.positions.begin()));
    const auto map = similarity({1, 2, -1}, 37 * degree, 1, {1000, -500, 2000});
    for (const Deformer& deformer : every_deformer()) {
      CAPTURE(text(deformer));
      CAPTURE(levels);
      const auto there = deformed(ball, cage, pose, deformer);
      std::vector<mesh::Point> images;
      for (const auto v : mirrored) images.push_back(image(there[v]));
      CHECK(largest_distance(there, images) < 1e-11);
      const auto turned = deformed(mapped(ball, map), mapped(cage, map), mapped(pose, map), deformer);
      CHECK(largest_distance(turned, mapped(there, map)) < 1e-8);
      const auto noisy = deformed(jittered(ball, 1e-12), cage, pose, deformer);
      CHECK(largest_distance(noisy, there) < 1e-9);
    }
  }
}
