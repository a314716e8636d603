// Tests the bundled shapes. Halfway to a shape, edge lengths must be right in log space.
#include <doctest/doctest.h>

#include "bench/figures.h"
#include "formats/point_cache.h"
#include "formats/read.h"
#include "mesh/summary.h"
#include "shapes/spaces.h"
#include "support/data.h"

using namespace viete;

namespace {

using Places = std::vector<mesh::Point>;

struct Shape {
  const char* name;
  double edges_in_log_space, edges_in_straight_lines;  ///< edge errors halfway: upper limit, lower limit
};
constexpr Shape kShapes[] = {{"folded", 0.01, 0.4}, {"coiled", 0.03, 0.5}, {"sitting", 0.015, 0.15}};

Places places_of(const Shape& shape) {
  const std::string file = "shape_" + std::string(shape.name) + ".pc2";
  return formats::PointCache(test::assets_dir() / "dragon" / file).frame(0);
}

Places halfway(const shapes::ShapeSpace& space, const Places& places, base::WorkerPool& pool) {
  const shapes::LogVector vector = space.vector(places, pool);
  const shapes::LogTerm half{&vector, 0.5};
  shapes::LogSpace::Work work;
  Places between(places.size());
  const shapes::LogSpace& logs = space.logs();
  logs.shape({&half, 1}, logs.anchors_from(logs.at_rest(), {&half, 1}), pool, work, between);
  return between;
}

double volume(mesh::Surface surface, const Places& places) {
  surface.positions = places;
  return mesh::summarize(surface).volume;
}

}  // namespace

TEST_CASE("shapes_stand_on_the_ground_and_keep_nine_tenths_of_the_volume") {
  const mesh::Surface dragon = formats::read(test::assets_dir() / "dragon" / "dragon.ply").surface;
  const double rest = volume(dragon, dragon.positions);
  for (const Shape& shape : kShapes) {
    CAPTURE(shape.name);
    const Places places = places_of(shape);
    REQUIRE(places.size() == dragon.positions.size());
    CHECK(mesh::bounds(places).low[1] == 0);
    CHECK(volume(dragon, places) > 0.89 * rest);
    CHECK(volume(dragon, places) < 1.01 * rest);
  }
}

TEST_CASE("halfway_to_its_shapes_the_dragon_keeps_edges_and_volume_in_log_space_alone") {
  const mesh::Surface dragon = formats::read(test::assets_dir() / "dragon" / "dragon.ply").surface;
  base::WorkerPool pool(2);
  const shapes::ShapeSpace space(dragon, pool);
  const std::vector<mesh::Edge> edges = mesh::polygon_edges(dragon);
  for (const Shape& shape : kShapes) {
    CAPTURE(shape.name);
    const Places& rest = dragon.positions;
    const Places end = places_of(shape), between = halfway(space, end, pool);
    Places straight;
    for (std::size_t v = 0; v < rest.size(); ++v) straight.push_back(0.5 * (rest[v] + end[v]));
    CHECK(bench::edge_error(edges, rest, end, between) < shape.edges_in_log_space);
    CHECK(bench::edge_error(edges, rest, end, straight) > shape.edges_in_straight_lines);
    const double expected = std::sqrt(volume(dragon, rest) * volume(dragon, end));
    CHECK(std::abs(volume(dragon, between) / expected - 1) < 0.03);
    CHECK(volume(dragon, straight) < 0.9 * expected);
  }
}
