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

VertexTriangles vertex_triangles(std::size_t vertices, std::span<const Triangle> triangles) {
  VertexTriangles around;
  around.starts.assign(vertices + 1, 0);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) ++around.starts[v + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) around.starts[v + 1] += around.starts[v];
  around.triangles.resize(around.starts[vertices]);
  std::vector<std::uint32_t> next(around.starts.begin(), around.starts.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) around.triangles[next[v]++] = static_cast<std::uint32_t>(t);
  }
  return around;
}

void vertex_normals(std::span<const Point> positions, std::span<const Triangle> triangles,
                    const VertexTriangles& around, std::size_t begin, std::size_t end,
                    std::span<Point> normals) {
  for (std::size_t v = begin; v < end; ++v) {
    Point sum{0, 0, 0};
    for (std::uint32_t i = around.starts[v]; i < around.starts[v + 1]; ++i) {
      const Triangle& t = triangles[around.triangles[i]];
      const Point &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
      sum = sum + cross(b - a, c - a);  // twice the area in length, so that the mean weighs by area
    }
    normals[v] = unit(sum);
  }
}

}  // namespace viete::mesh
