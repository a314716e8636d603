#include "document/animation.h"

#include "support/files.h"
#include "support/posed_cube.h"
#include "support/text.h"

using namespace viete;
using namespace viete::document;
using test::distance, test::turned, test::mentions;

namespace {

using Points = std::vector<mesh::Point>;

struct Shapes {
  mesh::Surface rest;
  base::WorkerPool pool;
  shapes::ShapeSpace space;

  explicit Shapes(mesh::Surface surface = test::CubeFiles::subdivided_cube())
      : rest(std::move(surface)), pool(1), space(rest, pool) {}

  SharedShape shape(double degrees) const { return shared(turned(rest.positions, degrees)); }
  // Returns a shape that is not a rigid motion, because one vertex moved.
  SharedShape pulled(double degrees) const {
    Points points = rest.positions;
    points[7][2] += 0.5;
    return shared(turned(points, degrees));
  }
  static SharedShape shared(Points points) { return std::make_shared<const Points>(std::move(points)); }
  Points mixed(std::vector<ShapeTerm> terms, bool linear = false, std::vector<std::string>* notes = nullptr) {
    return *document::mixed(space, terms, linear, pool, notes);
  }
};

}  // namespace

TEST_CASE("half_of_a_turn_of_a_model_is_half_of_its_angle") {
  Shapes s;
  CHECK(distance(s.mixed({{s.shape(170), 0.5}}), *s.shape(85)) < 1e-12);
  CHECK(distance(s.mixed({{s.shape(100), -1}}), *s.shape(-100)) < 1e-12);
  CHECK(distance(s.mixed({{s.shape(100), 2.5}}), *s.shape(250)) < 1e-12);
  CHECK(distance(s.mixed({{s.shape(30), 1}, {s.shape(50), 1}}), *s.shape(80)) < 1e-12);
}

TEST_CASE("rest_and_a_shape_alone_are_themselves_to_the_bit") {
  Shapes s;
  const SharedShape shape = s.pulled(77);
  CHECK(s.mixed({}) == s.rest.positions);
  CHECK(s.mixed({{shape, 0}, {nullptr, 1}}) == s.rest.positions);
  const std::vector<ShapeTerm> alone = {{nullptr, 3}, {shape, 1}, {s.shape(20), 0}};
  CHECK(document::mixed(s.space, alone, false, s.pool) == shape);
}

TEST_CASE("linear_mixes_are_sums_of_displacements") {
  Shapes s;
  const SharedShape a = s.pulled(180), b = s.pulled(50);
  Points expected = s.rest.positions;
  for (std::size_t v = 0; v < expected.size(); ++v)
    expected[v] = expected[v] + 1.5 * ((*a)[v] - s.rest.positions[v]) - 0.5 * ((*b)[v] - s.rest.positions[v]);
  CHECK(distance(s.mixed({{a, 1.5}, {b, -0.5}}, true), expected) < 1e-15);
}

TEST_CASE("a_part_at_rest_in_all_shapes_stays_exactly_at_rest") {
  mesh::Surface both = test::cube(1);
  Points points = both.positions;
  std::vector<mesh::Triangle> triangles = both.triangles;
  for (const auto& p : both.positions) points.push_back({p[0] / 3 + 10.123456789, p[1] / 7, p[2] / 11});
  for (const auto& [a, b, c] : both.triangles) triangles.push_back({a + 8, b + 8, c + 8});
  Shapes s(mesh::from_triangles(points, triangles));
  const Points moved = turned(both.positions, 100);
  std::ranges::copy(moved, points.begin());
  const Points half = s.mixed({{Shapes::shared(points), 0.5}});
  CHECK(half[0] != s.rest.positions[0]);
  for (std::size_t v = 8; v < 16; ++v) CHECK(half[v] == s.rest.positions[v]);
}

TEST_CASE("notes_about_shapes_are_shown_once") {
  Shapes s;
  const SharedShape flat = Shapes::shared(Points(20, {1, 2, 3}));
  std::vector<std::string> notes;
  s.mixed({{s.pulled(30), 0.5}}, false, &notes);
  CHECK(notes.empty());
  s.mixed({{flat, 0.5}}, false, &notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "some triangles folded over or collapsed and follow their neighbours: 36");
  s.mixed({{flat, 0.5}, {flat, 0.25}}, false, &notes);
  CHECK(mentions(notes.at(0), "up to 36 in each of 2 shapes"));
  notes.clear();
  s.mixed({{flat, 0.5}}, true, &notes);
  CHECK(notes.empty());
  const shapes::ShapeReport reports[] = {{0, 0, 3}, {0, 0, 0}, {0, 0, 1200}};
  CHECK(mentions(shape_notes(reports).at(0), "up to 1,200 in each of 2 shapes"));
}
