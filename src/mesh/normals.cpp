#include "mesh/normals.h"

#include <algorithm>
#include <cmath>

namespace viete::mesh {

namespace {

// Squares leave the range of double long before lengths do: then the largest component is taken out first.
Point unit(Point sum) {
  double squared = squared_norm(sum);
  if (!(squared > 1e-280 && squared < 1e280)) {
    const double largest = largest_abs(sum);
    if (!(largest > 0 && std::isfinite(largest))) return {0, 0, 1};
    for (double& x : sum) x /= largest;
    squared = squared_norm(sum);
  }
  const double length = std::sqrt(squared);
  return {sum[0] / length, sum[1] / length, sum[2] / length};
}

}  // namespace

Adjacency vertex_triangles(std::size_t vertices, std::span<const Triangle> triangles) {
  return make_adjacency(vertices, [&](const auto& add) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (const std::uint32_t v : triangles[t]) add(v, t);
    }
  });
}

void vertex_normals(std::span<const Point> positions, std::span<const Triangle> triangles,
                    const Adjacency& around, std::size_t begin, std::size_t end, std::span<Point> normals) {
  for (std::size_t v = begin; v < end; ++v) {
    Point sum{0, 0, 0};
    for (const std::uint32_t i : around.of(v)) {
      const Triangle& t = triangles[i];
      const Point &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
      sum = sum + cross(b - a, c - a);  // twice the area in length, so that the mean weighs by area
    }
    normals[v] = unit(sum);
  }
}

}  // namespace viete::mesh
