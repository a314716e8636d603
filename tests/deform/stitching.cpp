#include "deform/stitched_engine.h"

#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

namespace {

Deformer stitched(Blend blend = Blend::srl, int iterations = 1) {
  return {.weighting = {}, .blend = blend, .iterations = iterations};
}

std::vector<Deformer> all_stitched(int iterations = 1) {
  std::vector<Deformer> all;
  for (Deformer deformer : valid_deformers()) {
    deformer.iterations = iterations;
    if (!conflict(deformer)) all.push_back(deformer);
  }
  return all;
}

struct StitchScene {
  explicit StitchScene(const mesh::Surface& model_, const mesh::Surface& cage_surface = tube(9, 7, 0.8, 4.4))
      : model(model_), cage(std::make_shared<const Cage>(make_cage(cage_surface))) {}

  std::vector<mesh::Point> deform(const Pose& pose, const Deformer& deformer = stitched()) const {
    base::WorkerPool pool(2);
    return deform::deform_exactly(model, cage, deformer, pose, sym3::Method::fast, pool).positions;
  }
  template <class Map>
  Pose pose(const Map& map) const {
    return {mapped(cage->surface.positions, map), {}};
  }
  template <class Map>
  double error(const Map& map, const Deformer& deformer) const {
    const Pose p = pose(map);
    return largest_distance(deform(p, deformer), mapped(model.positions, map)) /
           mesh::bounds(p.positions).diagonal();
  }

  mesh::Surface model;
  std::shared_ptr<const Cage> cage;
};

mesh::Surface pipe() {
  return tube(40, 16, 0.5, 4);
}

mesh::Surface rough_pipe() {
  Random random(7);
  return mapped(pipe(), [&](const Vec3& x) { return x + random.vector(0.02); });
}

const Twist pipe_twist{2, {0.1, 0, 0}, -2.2, 2.2, -60 * degree, 70 * degree};

Vec3 bent_pipe(const Vec3& x) {
  const double a = 0.4 * x[2], r = 2.5 - x[0];
  return {2.5 - r * std::cos(a), 0.9 * x[1], 1.2 * r * std::sin(a)};
}

// Returns the energy if one map is the target of all triangles. Computes gradients in each triangle's plane.
double energy_of_maps(const mesh::Surface& rest, std::span<const mesh::Point> posed,
                      const sym3::Mat3<double>& map) {
  double sum = 0;
  for (const auto& t : rest.triangles) {
    const Vec3 u = rest.positions[t[1]] - rest.positions[t[0]],
               v = rest.positions[t[2]] - rest.positions[t[0]];
    const Vec3 n = cross(u, v);
    const double area2 = norm(n);
    const Vec3 e1 = (1 / norm(u)) * u, e2 = (1 / (area2 * norm(u))) * cross(n, u);
    const Vec3 pu = posed[t[1]] - posed[t[0]], pv = posed[t[2]] - posed[t[0]];
    const Vec3 d1 = (1 / norm(u)) * pu;
    const Vec3 d2 = (1 / dot(v, e2)) * (pv - dot(v, e1) * d1);
    const Affine linear{map};
    sum += area2 / 2 * (squared_norm(d1 - linear(e1)) + squared_norm(d2 - linear(e2)));
  }
  return sum;
}

// Returns q = x^T * K * x, where K includes the pins. At the minimum, the energy is a constant minus q.
double held_quadratic(const mesh::Surface& rest, const Stitching& stitching, std::span<const Vec3> x) {
  const SparseMatrix k = stiffness_matrix(rest.positions, rest.triangles);
  double sum = 0;
  for (std::size_t j = 0; j < k.size(); ++j)
    for (auto i = k.starts[j]; i < k.starts[j + 1]; ++i) sum += k.values[i] * dot(x[j], x[k.rows[i]]);
  for (const auto& pin : stitching.pins) sum += pin.weight * squared_norm(x[pin.vertex]);
  return sum;
}

}  // namespace

TEST_CASE("stitching_keeps_rest_and_follows_similarities_for_every_blend") {
  const StitchScene s(pipe());
  for (const int iterations : {1, 3})
    for (const Deformer& deformer : all_stitched(iterations)) {
      CAPTURE(text(deformer));
      CHECK(s.error([](const Vec3& x) { return x; }, deformer) < 1e-12);
      for (const double angle : {1e-9, 90.0, 180.0, 270.0})
        for (const double scale : {1e-3, 1.0, 1e3})
          CHECK(s.error(similarity({1, -2, 3}, angle * degree, scale, {20 * scale, scale, -scale}),
                        deformer) < 1e-11);
    }
}

TEST_CASE("stitching_does_not_depend_on_position_or_scale_of_the_scene") {
  const StitchScene here(rough_pipe());  // irregular, so that the nearest triangle is unique
  const auto posed = here.deform(here.pose(pipe_twist));
  for (const auto& [scale, shift] :
       {std::pair{1.0, Vec3{1000, -2000, 500}}, {1e-6, Vec3{0, 0, 0}}, {1e6, Vec3{3e6, 0, 0}}}) {
    const auto moved = [&, scale = scale, shift = shift](const Vec3& x) { return scale * x + shift; };
    const StitchScene there(mapped(here.model, moved), mapped(here.cage->surface, moved));
    const Pose pose{mapped(here.pose(pipe_twist).positions, moved), {}};
    CHECK(largest_distance(there.deform(pose), mapped(posed, moved)) < 1e-9 * scale);
  }
}

TEST_CASE("a_stitched_model_is_the_minimum_of_the_energy_of_its_maps") {
  // All triangles follow one map that differs from the cage's map. The test makes the rows itself.
  const StitchScene s(pipe());
  base::WorkerPool pool(2);
  const Stitching stitching = stitch(s.model, *s.cage, pool);
  const sym3::Mat3<double> map = shear().linear;
  std::vector<double> row(12, 0.0);
  for (int i = 0; i < 9; ++i) row[i] = map[i] - (i % 4 == 0);
  std::vector<double> sums, values;
  for (std::size_t v = 0; v < s.model.positions.size(); ++v) sums.insert(sums.end(), row.begin(), row.end());
  values.assign(s.cage->element_count() * 12, 0.0);  // pins stay at rest
  Stitcher stitcher(stitching, RowForm::maps, pool);
  stitcher.run({RowForm::maps, values}, sums, {}, sym3::Method::fast, 1);
  const Vec3 origin = middle(s.cage->surface.positions);
  const auto solved = mapped(stitcher.positions(), [&](const Vec3& x) { return x + origin; });
  const auto energy = [&](std::span<const mesh::Point> positions) {
    double sum = energy_of_maps(s.model, positions, map);
    for (const auto& pin : stitching.pins)
      sum += pin.weight * squared_norm(positions[pin.vertex] - s.model.positions[pin.vertex]);
    return sum;
  };
  const double least = energy(solved);
  CHECK(least > 1e-3);  // the pins contradict the maps
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    std::vector<Vec3> directions;
    for (std::size_t v = 0; v < solved.size(); ++v) directions.push_back(random.vector(1));
    const auto there = [&](double t) {
      auto positions = solved;
      for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = positions[v] + t * directions[v];
      return energy(positions);
    };
    const double slope = (there(1e-4) - there(-1e-4)) / 2e-4,
                 curvature = (there(1e-4) + there(-1e-4) - 2 * least) / 1e-8;
    CHECK(std::abs(slope) < 1e-7 * curvature);
    CHECK(there(1e-2) > least);
  }
}

TEST_CASE("refitting_rotations_lowers_the_energy_each_time") {
  const StitchScene s(pipe());
  base::WorkerPool pool(2);
  for (const Deformer& deformer : {stitched(), stitched(Blend::linear)}) {
    CageState state(s.cage, deformer.weighting.elements, deformer.blend);
    state.set_pose(s.pose(bent_pipe));
    const Rows rows = state.rows();
    const Binding binding = bind(s.model, *s.cage, deformer.weighting, pool);
    std::vector<double> sums(binding.vertices * rows.columns());
    blend({binding}, rows, 0, binding.vertices, sums);
    const Stitching stitching = stitch(s.model, *s.cage, pool);
    Stitcher stitcher(stitching, rows.form, pool);
    double before = 0;
    for (int iterations = 1; iterations <= 8; ++iterations) {
      stitcher.run(rows, sums, {}, sym3::Method::fast, iterations);
      const double energy = -held_quadratic(s.model, stitching, stitcher.positions());
      if (iterations > 1) CHECK(energy < before);
      before = energy;
    }
  }
}

TEST_CASE("every_vertex_is_determined_in_parts_holes_needles_and_without_triangles") {
  mesh::Surface model = together(pipe(), tube(6, 5, 0.1, 0.5));  // no handle is near the inner part
  for (int i = 0; i < 3; ++i) model.triangles.erase(model.triangles.begin() + 5 * i);
  const auto stray = std::uint32_t(model.positions.size());
  model.positions.push_back({0.2, 0.1, 0.3});  // has no triangle
  model.positions.push_back({0.3, 0.1, 0.3});
  model.positions.push_back({0.4, 0.1, 0.3});
  model.positions.push_back({0.5, 0.1, 0.3});
  model.triangles.push_back({stray + 1, stray + 2, stray + 3});  // a separate line
  model.positions.push_back(model.positions[0]);
  model.positions.push_back(0.5 * (model.positions[0] + model.positions[1]));
  model.triangles.push_back({0, 1, stray + 4});  // two coincident corners
  model.triangles.push_back({0, 1, stray + 5});  // three collinear corners
  model.triangles.push_back({2, 2, 3});
  model.positions.push_back(model.positions[7] + Vec3{1e-9, 0, 0});
  model.triangles.push_back({7, 8, stray + 6});  // a needle
  model = mesh::from_triangles(model.positions, model.triangles);
  const StitchScene s(model);
  for (const Deformer& deformer : all_stitched(2)) {
    CAPTURE(text(deformer));
    CHECK(s.error(similarity({1, -2, 3}, 80 * degree, 2, {3, 4, 5}), deformer) < 1e-9);
    const auto posed = s.deform(s.pose(pipe_twist), deformer);
    CHECK(all_finite(posed));
    CHECK(largest_distance(posed, mapped(s.model.positions, pipe_twist)) < 1.5);
  }
  // Holds are needed in the inner part, and at vertices without a triangle that has enough area.
  base::WorkerPool pool(2);
  const Stitching stitching = stitch(s.model, *s.cage, pool);
  Deformer blended = stitched();
  blended.iterations = 0;
  const auto by_blend = s.deform(s.pose(pipe_twist), blended), by_stitching = s.deform(s.pose(pipe_twist));
  CHECK(norm(by_blend[stray] - by_stitching[stray]) < 1e-14);
  bool held = false;
  for (const auto& hold : stitching.holds) held |= hold.vertex == 40 * 16 + 2;  // the inner part's first hold
  CHECK(held);
}

TEST_CASE("models_without_firm_triangles_are_stitched_to_their_blended_positions") {
  for (const std::vector<mesh::Triangle>& triangles :
       {std::vector<mesh::Triangle>{}, {{0, 1, 2}}, {{0, 0, 1}}, {{0, 1, 2}, {0, 2, 1}}}) {
    const StitchScene s(mesh::from_triangles({{0, 0, 0.1}, {0, 0, 0.2}, {0, 0, 0.4}}, triangles));
    CHECK(s.error(similarity({1, -2, 3}, 80 * degree, 2, {3, 4, 5}), stitched()) < 1e-10);
    CHECK(all_finite(s.deform(s.pose(bent_pipe))));
  }
  base::WorkerPool pool(1);
  const StitchScene s(pipe());
  CHECK_THROWS_AS(stitch({}, *s.cage, pool), base::Error);
  base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(stitch(s.model, *s.cage, pool, {}, &progress), base::Cancelled);
}

TEST_CASE("mirrored_and_collapsed_poses_give_finite_stitched_models") {
  const StitchScene s(pipe());
  const auto flat = [](const Vec3& x) { return Vec3{x[0], x[1], 0}; };
  const auto line = [](const Vec3& x) { return Vec3{x[0], 0, 0}; };
  const auto point = [](const Vec3&) { return Vec3{1, 2, 3}; };
  const auto mirror = [](const Vec3& x) { return Vec3{-x[0], x[1], x[2]}; };
  for (const Deformer& deformer : all_stitched(3)) {
    CAPTURE(text(deformer));
    for (const Pose& pose : {s.pose(flat), s.pose(line), s.pose(point), s.pose(mirror)})
      CHECK(all_finite(s.deform(pose, deformer)));
  }
}

TEST_CASE("pins_within_a_radius_pull_more_and_translation_pulls_everything") {
  const StitchScene s(pipe());
  base::WorkerPool pool(2);
  const Stitching usual = stitch(s.model, *s.cage, pool);
  double strength = 0;
  for (const auto& pin : usual.pins) strength += pin.weight;
  CHECK(strength == doctest::Approx(3 * static_cast<double>(s.cage->element_count()) * usual.pins[0].weight));
  CHECK(usual.holds.empty());
  const Stitching wide = stitch(s.model, *s.cage, pool, {.weighting = {}, .holding = {.radius = 0.2}});
  CHECK(wide.pins.size() > usual.pins.size());
  for (const auto& pin : wide.pins) {
    CHECK(pin.weight > 0);
    CHECK(pin.weight <= pin_strength);
    CHECK((pin.weight == pin_strength ||
           norm(s.model.positions[pin.vertex] - s.cage->centers[pin.handle]) < 0.2 * s.cage->diagonal));
  }
  CHECK(stitch(s.model, *s.cage, pool, {.weighting = {}, .holding = {.weight = 1}}).holds.size() ==
        s.model.positions.size());
}

TEST_CASE("elements_without_area_pin_nothing") {
  mesh::Surface cage = tube(9, 7, 0.8, 4.4);
  cage.positions.push_back(0.5 * (cage.positions[0] + cage.positions[1]));
  const auto middle = std::uint32_t(cage.positions.size() - 1);
  cage.triangles.push_back({0, middle, 1});
  const StitchScene s(pipe(), mesh::from_triangles(cage.positions, cage.triangles));
  REQUIRE(s.cage->degenerate.back() == 1);
  base::WorkerPool pool(2);
  for (const auto& pin : stitch(s.model, *s.cage, pool).pins) CHECK(pin.handle + 1 < s.cage->element_count());
}

TEST_CASE("a_soup_of_triangles_and_layers_are_stitched_as_one_and_come_apart_where_that_is_asked_for") {
  const mesh::Surface whole = pipe();
  const mesh::Surface soup = loose_triangles(whole);
  const auto inner = [](const Vec3& p) { return Vec3{0.96 * p[0], 0.96 * p[1], 0.99 * p[2]}; };
  const mesh::Surface layers = together(whole, mapped(whole, inner));
  const auto n = static_cast<std::uint32_t>(whole.positions.size());

  const StitchScene one(whole), of_soup(soup), of_layers(layers);
  const Pose pose = one.pose(Twist{2, {0, 0, 0}, -1.5, 1.5, 0, 60 * degree});
  for (const int iterations : {1, 3}) {
    const Deformer together = stitched(Blend::srl, iterations);
    const auto torn = [&](const std::vector<mesh::Point>& posed) {
      double most = 0;
      for (std::uint32_t v = 0; v < n; ++v)
        most = std::max(most, std::abs(norm(posed[v] - posed[v + n]) -
                                       norm(layers.positions[v] - layers.positions[v + n])));
      return most;
    };
    const auto expected = one.deform(pose, together), posed = of_soup.deform(pose, together);
    double off = 0;
    for (std::size_t t = 0; t < whole.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const mesh::Point& p = expected[whole.triangles[t][k]];
        off = std::max(off, norm(posed[3 * t + k] - p));
      }
    CHECK(off < 2e-3);
    CHECK(torn(of_layers.deform(pose, together)) < 0.001);
  }
}
