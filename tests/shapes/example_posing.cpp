#include "shapes/example_posing.h"

#include <doctest/doctest.h>

#include "formats/read.h"
#include "support/caged_shapes.h"
#include "support/data.h"

using namespace viete;
using namespace viete::test;

namespace {

using Points = std::vector<mesh::Point>;
constexpr double holds = std::numeric_limits<double>::infinity();

struct Posing {
  mesh::Surface rest;
  base::WorkerPool pool;
  ShapeSpace space;
  std::vector<LogVector> vectors;
  std::vector<std::uint32_t> pinned;
  std::unique_ptr<ExamplePosing> posing;

  Posing(mesh::Surface surface, const std::vector<Points>& examples, std::vector<std::uint32_t> vertices,
         double firmness = holds, int threads = 1)
      : rest(std::move(surface)), pool(threads), space(rest, pool), pinned(std::move(vertices)) {
    for (const Points& example : examples) vectors.push_back(space.vector(example, pool));
    std::vector<const LogVector*> pointers;
    for (const LogVector& v : vectors) pointers.push_back(&v);
    posing = std::make_unique<ExamplePosing>(space, pointers, pool);
    std::vector<PosingPin> pins;
    for (const auto v : pinned) pins.push_back({v, firmness});
    posing->set_pins(pins);
  }

  Points at_pins(const Points& shape) const {
    Points targets;
    for (const auto v : pinned) targets.push_back(shape[v]);
    return targets;
  }
  Points solved(const Points& shape, const PosingSettings& settings, int most = 100) {
    steps = posing->solve(at_pins(shape), settings, most);
    return {posing->positions().begin(), posing->positions().end()};
  }
  double error(const Points& a, const Points& b) const {
    return largest_distance(a, b) / mesh::bounds(rest.positions).diagonal();
  }
  int steps = 0;
};

// Returns the tube bent about x without a change of its length. `degrees` is the angle between the ends.
Points bent(const mesh::Surface& tube, double degrees) {
  const auto box = mesh::bounds(tube.positions);
  const double k = degrees * degree / (box.high[2] - box.low[2]);
  Points points = tube.positions;
  for (auto& p : points) {
    const double a = k * p[2], r = 1 / k - p[1];
    p = {p[0], 1 / k - r * std::cos(a), r * std::sin(a)};
  }
  return points;
}

mesh::Surface straight_tube() {
  return tube(30, 8, 0.3, 4);
}
std::vector<std::uint32_t> some_pins() {
  return {0, 4, 14 * 8, 14 * 8 + 4, 29 * 8, 29 * 8 + 4};
}

}  // namespace

TEST_CASE("an_example_is_recovered_from_its_own_vertices") {
  const mesh::Surface model = straight_tube();
  const Points bend = bent(model, 120);
  Points stretched = model.positions;
  for (auto& p : stretched) p[2] *= 1.5;
  Posing p(model, {bend, stretched}, some_pins());
  const PosingSettings exactly{.restraint = 1e-12, .freedom = 0};
  CHECK(p.error(p.solved(bend, exactly), bend) < 1e-5);
  CHECK(p.posing->weights()[0] == doctest::Approx(1).epsilon(1e-4));
  CHECK(std::abs(p.posing->weights()[1]) < 1e-4);
  CHECK(p.steps < 25);
  // Targets between the examples, or beyond an example, are blends in log space.
  p.posing->restart();
  const std::array terms{LogTerm{&p.vectors[0], 1.4}, LogTerm{&p.vectors[1], 0.5}};
  Points blend(model.positions.size());
  LogSpace::Work work;
  p.space.logs().shape(terms, p.space.logs().anchors_from(p.space.logs().at_rest(), terms), p.pool, work,
                       blend);
  CHECK(p.error(p.solved(blend, exactly), blend) < 1e-4);
  CHECK(p.posing->weights()[0] == doctest::Approx(1.4).epsilon(1e-3));
  CHECK(p.posing->weights()[1] == doctest::Approx(0.5).epsilon(1e-3));
}

TEST_CASE("examples_rotate_with_the_pins") {
  const mesh::Surface model = straight_tube();
  const Points bend = bent(model, 120);
  Posing p(model, {bend}, some_pins());
  const auto map = similarity({1, 2, 3}, 160 * degree, 1, {5, -3, 2});
  const Points turned = mapped(bend, map);
  CHECK(p.error(p.solved(turned, {.restraint = 1e-12, .freedom = 0}), turned) < 1e-5);
}

TEST_CASE("hard_pins_reach_their_targets_and_soft_pins_stay_between") {
  const mesh::Surface model = straight_tube();
  Points targets = bent(model, 60);
  targets[0] = targets[0] + Vec3{0.3, 0.2, 0};
  for (const double freedom : {0.0, 0.3, 1.0}) {
    Posing p(model, {bent(model, 120)}, some_pins());
    const Points posed = p.solved(targets, {.freedom = freedom});
    for (const auto v : p.pinned) CHECK(norm(posed[v] - targets[v]) < 1e-12);
    Posing soft(model, {bent(model, 120)}, some_pins(), 0.01);
    const Points pulled = soft.solved(targets, {.freedom = freedom});
    const double off = norm(pulled[0] - targets[0]);
    CHECK(off > 1e-3);
    CHECK(off < norm(model.positions[0] - targets[0]));
  }
}

TEST_CASE("without_examples_a_rigid_motion_of_the_pins_moves_all_rigidly") {
  const mesh::Surface model = straight_tube();
  const Points moved = mapped(model.positions, similarity({1, 2, 3}, 150 * degree, 1, {5, -3, 2}));
  Posing p(model, {}, some_pins());
  CHECK(p.error(p.solved(moved, {.freedom = 1}), moved) < 1e-9);
  Posing one(model, {}, {17});
  Points shifted = model.positions;
  for (auto& x : shifted) x = x + Vec3{1, 2, 3};
  CHECK(one.error(one.solved(shifted, {.freedom = 1}), shifted) < 1e-12);
  // For other pins, edges keep their lengths as well as possible.
  const Points bend = bent(model, 90);
  const Points free = Posing(model, {}, some_pins()).solved(bend, {.freedom = 1}, 500);
  CHECK(largest_edge_stretch(model, free) < 1.6);
  const Points stiff = Posing(model, {}, some_pins()).solved(bend, {.freedom = 0});
  CHECK(largest_edge_stretch(model, free) < largest_edge_stretch(model, stiff));
}

TEST_CASE("parts_without_a_pin_stay_where_their_blend_is") {
  const mesh::Surface model = straight_tube();
  const mesh::Surface other = mapped(model, scaling(1, {5, 0, 0}));
  const mesh::Surface both = together(model, other);
  Points bend = bent(model, 60);
  bend.insert(bend.end(), other.positions.begin(), other.positions.end());
  Posing p(both, {bend}, some_pins());
  const Points posed = p.solved(bend, {.restraint = 1e-12, .freedom = 0});
  CHECK(p.error(posed, bend) < 1e-4);
}

TEST_CASE("near_parts_without_a_pin_follow_the_part_with_pins") {
  const mesh::Surface outer = tube(30, 12, 0.3, 4);
  const mesh::Surface inner = mapped(tube(28, 10, 0.28, 3.6), similarity({0, 0, 1}, 0.2));
  const mesh::Surface model = together(outer, inner);
  const std::vector<std::uint32_t> pins = {0, 4, 14 * 12, 14 * 12 + 4, 29 * 12, 29 * 12 + 4};
  const auto map = similarity({1, 2, 3}, 160 * degree, 1, {5, -3, 2});
  const Points turned = mapped(model.positions, map);
  for (const double freedom : {0.3, 1.0}) {
    Posing p(model, {}, pins);
    CHECK(p.error(p.solved(turned, {.freedom = freedom}, 500), turned) < 1e-5);
  }
  const Points bend = bent(model, 60);
  Posing p(model, {}, pins);
  const Points posed = p.solved(bend, {.freedom = 1}, 500);
  for (std::size_t v = outer.positions.size(); v < model.positions.size(); ++v) {
    const auto apart = [&](const Points& points) {
      double least = 1e9;
      for (std::size_t w = 0; w < outer.positions.size(); ++w)
        least = std::min(least, norm(points[v] - points[w]));
      return least;
    };
    REQUIRE(std::abs(apart(posed) - apart(model.positions)) < 0.1);
  }
  Posing by_example(model, {bend}, pins);
  CHECK(by_example.error(by_example.solved(bend, {.restraint = 1e-12, .freedom = 0}), bend) < 1e-4);
}

TEST_CASE("pins_move_a_triangle_soup_as_one") {
  Random random(3);
  const auto moved = [&](const std::size_t triangles, double gap) {
    const mesh::Surface whole = loose_triangles(tube(std::uint32_t(triangles / 24), 12, 0.3, 4));
    const mesh::Surface model = mapped(whole, [&](const Vec3& x) { return x + random.vector(gap); });
    const auto count = std::uint32_t(model.positions.size());
    Posing p(model, {}, {0, count / 3, count / 2, count - 1});
    const Points turned = mapped(model.positions, similarity({1, 2, 3}, 70 * degree, 1, {5, -3, 2}));
    return p.error(p.solved(turned, {}), turned);
  };
  CHECK(moved(600, 1e-7) < 1e-4);
  CHECK(moved(600, 0.01) < 1e-4);
  CHECK(moved(27'100, 0.01) < 1e-4);  // too many vertices to solve for all
}

TEST_CASE("pins_of_a_large_model_reach_their_targets_near_a_blend_of_examples") {
  const mesh::Surface model = tube(450, 200, 0.3, 4);
  const Points bend = bent(model, 120);
  Posing p(model, {bend}, {0, 1, 100, 45'000, 45'100, 89'999});
  REQUIRE(p.space.coarse());
  CHECK(p.error(p.solved(bend, {.restraint = 1e-12, .freedom = 0}), bend) < 1e-5);
  CHECK(p.posing->weights()[0] == doctest::Approx(1).epsilon(1e-4));
  Points targets = bent(model, 60);
  targets[0] = targets[0] + Vec3{0.03, 0.02, 0};
  const Points posed = p.solved(targets, {});
  for (const auto v : p.pinned) CHECK(norm(posed[v] - targets[v]) < 1e-12);
  Posing steps(model, {bend}, p.pinned), solved(model, {bend}, p.pinned);
  for (int step = 0; step < 3; ++step) steps.posing->step(p.at_pins(targets), {});
  CHECK(std::ranges::equal(steps.posing->positions(), solved.solved(targets, {}, 3)));
  const std::size_t all[] = {0, 1, 2, 3, 4, 5};
  for (const double share : p.posing->reach(all)) CHECK(share == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("posing_gives_the_same_bits_on_any_number_of_threads") {
  const mesh::Surface model = tube(400, 16, 0.3, 40);
  Points first;
  for (const int threads : {1, 2, 3}) {
    Posing p(model, {bent(model, 120), bent(model, -40)}, {0, 1000, 3000, 6000}, holds, threads);
    const Points posed = p.solved(bent(model, 70), {}, 5);
    if (first.empty()) first = posed;
    CHECK(posed == first);
  }
}

TEST_CASE("coincident_pins_with_two_targets_end_between_them") {
  mesh::Surface model = straight_tube();
  // Adds a seam: replaces vertex 40 by a copy in every second triangle at this vertex.
  const auto copy = std::uint32_t(model.positions.size());
  model.positions.push_back(model.positions[40]);
  auto triangles = model.triangles;
  bool takes = false;
  for (auto& t : triangles)
    for (auto& v : t)
      if (v == 40 && (takes = !takes)) v = copy;
  Posing p(mesh::from_triangles(model.positions, triangles), {}, {0, 200, 40, copy});
  Points targets = p.rest.positions;
  targets[40][0] += 0.1;
  targets[copy][0] -= 0.1;
  const Points posed = p.solved(targets, {.freedom = 1});
  CHECK(all_finite(posed));
  CHECK(norm(posed[40] - p.rest.positions[40]) < 0.1);
  CHECK(posed[40] == posed[copy]);
}

TEST_CASE("vertices_without_triangles_cannot_be_pinned") {
  mesh::Surface model = straight_tube();
  model.positions.push_back({7, 7, 7});
  const auto loose = std::uint32_t(model.positions.size() - 1);
  CHECK_THROWS_WITH_AS(Posing(model, {}, {0, loose}), doctest::Contains("no triangle"), base::Error);
  CHECK_THROWS_WITH_AS(Posing(model, {}, std::vector<std::uint32_t>(most_pins + 1)),
                       doctest::Contains("1,001 pins exceed the limit of 1,000"), base::Error);
}

// With seven pinned vertices and six example frames, the other frames of the gallop have these errors.
TEST_CASE("a_gallop_is_posed_by_six_of_its_frames" * doctest::test_suite(if_present)) {
  const auto folder = shared_data("shapes/horse");
  if (folder.empty()) return;
  const auto frame = [&](int i) {
    return formats::read(folder / ("gallop_" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".obj"))
        .surface.positions;
  };
  const mesh::Surface rest = formats::read(folder / "rest.obj").surface;
  std::vector<std::uint32_t> pins;
  const Vec3 middle = (1.0 / double(rest.positions.size())) *
                      std::accumulate(rest.positions.begin(), rest.positions.end(), Vec3{0, 0, 0});
  std::vector<double> distance;
  for (const auto& p : rest.positions) distance.push_back(norm(p - middle));
  for (int k = 0; k < 7; ++k) {
    const auto v = std::uint32_t(std::ranges::max_element(distance) - distance.begin());
    for (std::size_t i = 0; i < distance.size(); ++i) {
      const double d = norm(rest.positions[i] - rest.positions[v]);
      distance[i] = k == 0 ? d : std::min(distance[i], d);
    }
    pins.push_back(v);
  }
  Posing p(rest, {frame(1), frame(3), frame(5), frame(7), frame(9), frame(11)}, pins);
  double far = 0, longer = 0;
  for (const int i : {2, 6, 10}) {
    const Points truth = frame(i);
    p.posing->restart();
    const Points posed = p.solved(truth, {}, 60);
    double sum = 0;
    for (std::size_t v = 0; v < posed.size(); ++v) sum += norm(posed[v] - truth[v]);
    far += sum / double(posed.size()) / mesh::bounds(rest.positions).diagonal() / 3;
    std::vector<double> errors;
    for (const auto& t : rest.triangles)
      for (int k = 0; k < 3; ++k) {
        const auto a = t[k], b = t[(k + 1) % 3];
        errors.push_back(std::abs(std::log(norm(posed[a] - posed[b]) / norm(truth[a] - truth[b]))));
      }
    std::ranges::sort(errors);
    longer += errors[errors.size() * 95 / 100] / 3;
  }
  CHECK(far <= 0.0064);
  CHECK(longer <= 0.074);
}
