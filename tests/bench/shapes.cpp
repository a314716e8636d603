#include <doctest/doctest.h>

#include <cmath>

#include "bench/models.h"
#include "bench/plain_shapes.h"
#include "bench/published_shapes.h"
#include "bench/shape_errors.h"
#include "deform/example_posing.h"
#include "support/data.h"

using namespace viete;
using namespace viete::bench;

namespace {

using Points = std::vector<mesh::Point>;

mesh::Point turned(mesh::Point p, std::size_t axis, double angle) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double x = p[i], y = p[j], c = std::cos(angle), s = std::sin(angle);
  p[i] = c * x - s * y, p[j] = s * x + c * y;
  return p;
}

// The part above z = 0 turned about an axis, where the middle's rings turn much against each other.
Points folded(Points points, std::size_t axis, double angle) {
  for (mesh::Point& p : points)
    if (p[2] > 0) p = turned(p, axis, angle);
  return points;
}

// By more than half a turn, so that there are branches.
Points twisted(Points points, double angle) {
  for (mesh::Point& p : points) p = turned(p, 2, angle * (p[2] / 4 + 0.5));
  return points;
}

struct TwoShapes {
  mesh::Surface rest = box_along_z(1, 4, 4, 20);
  base::WorkerPool pool{1};
  deform::ShapeSpace space{rest, pool};
  deform::LogVector a = space.vector(folded(rest.positions, 0, 1.2), pool),
                    b = space.vector(folded(rest.positions, 2, 2), pool);
  ShapeErrors errors{rest};
};

}  // namespace

TEST_CASE("edges_and_distances_are_compared_without_units") {
  const mesh::Surface rest = box_along_z(1, 4, 2, 8);
  const ShapeErrors errors(rest);
  Points twice = rest.positions, far = rest.positions;
  for (auto& p : twice) p = 2.0 * p;
  for (auto& p : far) p[0] += std::sqrt(18.0);  // a diagonal
  CHECK(errors.edges(rest.positions, twice, rest.positions).root_mean_square ==
        doctest::Approx(std::log(2.0) / 2));
  CHECK(errors.edges(rest.positions, rest.positions, twice).share_99 == doctest::Approx(std::log(2.0)));
  CHECK(errors.edges(rest.positions, rest.positions, far).share_95 < 1e-12);
  CHECK(errors.distance(rest.positions, far) == doctest::Approx(1));
  far[3][0] = std::nan("");
  CHECK(std::isnan(errors.farthest(rest.positions, far)));
}

TEST_CASE("far_vertices_are_at_the_ends") {
  const mesh::Surface rest = box_along_z(1, 4, 2, 8);
  const auto far = far_vertices(rest.positions, 2);
  REQUIRE(far.size() == 2);
  CHECK(rest.positions[far[0]][2] * rest.positions[far[1]][2] == doctest::Approx(-4));
  CHECK(far_vertices(rest.positions, 10'000).size() == rest.positions.size());
}

TEST_CASE("plain_loops_make_the_same_shapes_and_logs") {
  TwoShapes s;
  REQUIRE_FALSE(s.a.doubts.empty());
  const std::vector<deform::LogTerm> terms{{&s.a, 0.5}, {&s.b, 0.5}};
  const deform::Held held = s.space.logs().held_between(s.a, s.b);
  Points positions(s.rest.positions.size());
  deform::LogSpace::Work work;
  s.space.logs().shape(terms, held, s.pool, work, positions);
  PlainShapes plain(s.space, s.rest);
  plain.shape(terms, held);
  CHECK(s.errors.farthest(positions, plain.positions()) < 1e-12);

  const Points shape = twisted(s.rest.positions, 5);
  const deform::LogVector vector = s.space.vector(shape, s.pool), other = plain.vector(shape);
  double largest = 0;
  for (std::size_t t = 0; t < vector.logs.size(); ++t)
    for (std::size_t k = 0; k < 9; ++k)
      largest = std::max(largest, std::abs(vector.logs[t][k] - other.logs[t][k]));
  CHECK(largest < 1e-10);
}

TEST_CASE("plain_loops_pose_by_examples_alike") {
  TwoShapes s;
  const std::vector<deform::LogTerm> terms{{&s.a, 0.5}, {&s.b, 0.4}};
  PlainShapes plain(s.space, s.rest);
  plain.shape(terms, s.space.logs().held_from(s.space.logs().at_rest(), terms));
  const auto vertices = far_vertices(s.rest.positions, 5);
  Points targets;
  std::vector<deform::PosingPin> pins;
  for (const auto v : vertices) {
    targets.push_back(plain.positions()[v]);
    pins.push_back({v, std::numeric_limits<double>::infinity()});
  }
  PlainPosing plain_posing(plain, {&s.a, &s.b}, vertices);
  deform::ExamplePosing posing(s.space, {&s.a, &s.b}, s.pool);
  posing.set_pins(pins);
  posing.solve(targets, {.freedom = 0}, 60);
  for (int i = 0; i < 60; ++i) plain_posing.step(targets);
  CHECK(s.errors.farthest(posing.positions(), plain_posing.positions()) < 1e-5);
}

// What is known to be possible, see the bars of `viete bench shapes`.
TEST_CASE("the_gallop_is_filled_in_and_posed_nearer_than_by_linear_blend_shapes" *
          doctest::test_suite(test::if_present)) {
  const auto folder = test::shared_data("shapes");
  if (folder.empty()) return;
  Bars bars;
  const auto gallop = check_gallop(folder, bars);
  CHECK(double(gallop["every_second"]["distance"]) < 0.0065);
  CHECK(double(gallop["every_third"]["distance"]) < 0.0108);
  CHECK(double(gallop["by_examples"]["distance"]) < 0.6 * double(gallop["linear_blend_shapes"]["distance"]));
  CHECK(bars.rows.size() == 7);
}
