#include "scene/files/cage_json.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "mesh/triangulation.h"
#include "scene/document/range.h"

namespace viete::scene {

using nlohmann::ordered_json;

ordered_json cage_json(const OpenedSurface& cage) {
  const mesh::Surface& surface = *cage.surface;
  ordered_json polygons = ordered_json::array();
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    polygons.push_back(std::vector<std::uint32_t>(surface.corners.begin() + surface.polygon_starts[p],
                                                  surface.corners.begin() + surface.polygon_starts[p + 1]));
  }
  return {{"name", cage.made}, {"positions", surface.positions}, {"polygons", std::move(polygons)}};
}

OpenedSurface made_cage_of(const JsonReader& json) {
  mesh::Surface surface;
  const JsonReader positions = json.at("positions"), polygons = json.at("polygons");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const auto point = positions.point(v, largest_coordinate);
    if (!point) positions.item(v).fail("this is no [x, y, z] of a vertex");
    surface.positions.push_back(*point);
  }
  surface.polygon_starts.push_back(0);
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const JsonReader polygon = polygons.item(p);
    if (polygon.size() < 3) polygon.fail("a polygon has three corners or more");
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      surface.corners.push_back(polygon.item(c).index());
      if (surface.corners.back() >= surface.positions.size())
        polygon.item(c).fail("the cage has " + std::to_string(surface.positions.size()) + " vertices");
    }
    surface.polygon_starts.push_back(static_cast<std::uint32_t>(surface.corners.size()));
  }
  mesh::triangulate(surface);
  const auto name = json.find("name");
  return made_surface(std::move(surface), name ? name->text() : "made here");
}

}  // namespace viete::scene
