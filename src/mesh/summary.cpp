#include "mesh/summary.h"

#include <array>

#include "mesh/triangle.h"
#include "mesh/union_find.h"

namespace viete::mesh {

namespace {

void find_edges(const Surface& surface, Summary& summary) {
  const HalfEdges table = half_edges(surface.positions.size(), surface.triangles);
  summary.edges = table.edges.size();
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto sides = table.of(e);
    if (sides.size() == 1) summary.boundary_edges.push_back(table.edges[e]);
    if (sides.size() == 2 && sides[0].forward == sides[1].forward)
      summary.misoriented_edges.push_back(table.edges[e]);
    if (sides.size() > 2) summary.nonmanifold_edges.push_back(table.edges[e]);
  }
}

void find_parts(const Surface& surface, Summary& summary) {
  const auto vertices = static_cast<std::uint32_t>(surface.positions.size());
  UnionFind parts(vertices);
  std::vector<bool> used(vertices, false);
  for (const Triangle& t : surface.triangles) {
    for (const std::uint32_t v : t) {
      used[v] = true;
      parts.join(v, t[0]);
    }
  }
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (!used[v]) summary.unused_vertices.push_back(v);
    if (used[v] && parts.find(v) == v) ++summary.parts;
  }
}

// Computes lengths relative to the box, so that squares stay in range. The volume sums tetrahedra from the
// box's centre, which keeps precision far from the origin.
void measure(const Surface& surface, Summary& summary) {
  const Bounds box = used_bounds(surface);
  const Point center = box.center();
  const double scale = box.diagonal() > 0 ? box.diagonal() : 1;
  double area = 0, volume = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    std::array<Point, 3> p;
    for (int i = 0; i < 3; ++i) {
      p[i] = surface.positions[surface.triangles[t][i]] - center;
      for (double& x : p[i]) x /= scale;
    }
    const auto& [a, b, c] = surface.triangles[t];
    if (!has_area(surface.positions[a], surface.positions[b], surface.positions[c]))
      summary.degenerate_triangles.push_back(static_cast<std::uint32_t>(t));
    const Point n = cross(p[1] - p[0], p[2] - p[0]);
    area += 0.5 * stable_norm(n);
    volume += dot(p[0], n) / 6;
  }
  summary.area = area * scale * scale;
  summary.volume = volume * scale * scale * scale;
}

}  // namespace

Summary summarize(const Surface& surface) {
  Summary summary;
  summary.vertices = surface.positions.size();
  summary.polygons = surface.polygon_count();
  summary.triangles = surface.triangles.size();
  find_edges(surface, summary);
  find_parts(surface, summary);
  measure(surface, summary);
  return summary;
}

}  // namespace viete::mesh
