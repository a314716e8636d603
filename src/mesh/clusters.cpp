#include "mesh/clusters.h"

#include <cmath>

#include "mesh/point_index.h"
#include "mesh/triangle.h"

namespace viete::mesh {

std::vector<Triangle> clustered_triangles(const Surface& surface, double area, std::size_t wanted) {
  std::vector<Triangle> triangles;
  // On average, a plane of random direction intersects 1.5 cells per area of side * side.
  const double side = std::sqrt(3 * area / static_cast<double>(wanted));
  if (!(side > 0)) return triangles;
  const Point low = used_bounds(surface).low;
  PointIndex index;
  std::vector<Point> cells;
  std::vector<std::uint32_t> chosen, cell_of(surface.positions.size(), none);
  const auto take = [&](std::uint32_t v) {
    const auto place = [&](std::uint32_t w) { return (1 / side) * (surface.positions[w] - low); };
    const Point at = place(v), cell{std::floor(at[0]), std::floor(at[1]), std::floor(at[2])};
    const Point middle = cell + Vec3{0.5, 0.5, 0.5};
    const std::uint32_t c = cell_of[v] = index.find_or_add(cell, cells);
    if (c == cells.size()) {
      cells.push_back(cell);
      chosen.push_back(v);
    } else if (squared_norm(at - middle) < squared_norm(place(chosen[c]) - middle)) {
      chosen[c] = v;
    }
  };
  for (const Triangle& t : surface.triangles)
    for (const std::uint32_t v : t)
      if (cell_of[v] == none) take(v);
  for (const auto& [a, b, c] : surface.triangles) {
    const Triangle cells_of{cell_of[a], cell_of[b], cell_of[c]};
    if (!repeats_corner(cells_of))
      triangles.push_back({chosen[cells_of[0]], chosen[cells_of[1]], chosen[cells_of[2]]});
  }
  return triangles;
}

}  // namespace viete::mesh
