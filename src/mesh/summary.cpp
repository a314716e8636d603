#include "mesh/summary.h"

#include <algorithm>
#include <utility>

#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/defects.h"
#include "mesh/triangle.h"
#include "mesh/union_find.h"

namespace viete::mesh {

namespace {

// For each vertex a, lists the polygon sides between a and vertices b > a: 2 * b + 1 for a side from a to b,
// 2 * b for a side from b to a.
Adjacency sides(const Surface& surface) {
  const auto add_sides = [&](std::uint32_t p, const auto& add) {
    for_polygon_sides(surface, p, [&](std::uint32_t from, std::uint32_t to) {
      add(std::min(from, to), 2 * std::max(from, to) + (from < to));
    });
  };
  return sorted_adjacency(surface.positions.size(), surface.polygon_count(), add_sides);
}

// Joins the results for two blocks of vertices or triangles.
Summary joined(Summary a, const Summary& b) {
  const auto append = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
  a.edges += b.edges;
  a.area += b.area;
  a.volume += b.volume;
  append(a.boundary_edges, b.boundary_edges);
  append(a.nonmanifold_edges, b.nonmanifold_edges);
  append(a.misoriented_edges, b.misoriented_edges);
  append(a.degenerate_polygons, b.degenerate_polygons);
  return a;
}

Summary edges_of(const Surface& surface) {
  const Adjacency all = sides(surface);
  const auto edges = [&](std::size_t begin, std::size_t end) {
    Summary summary;
    for (auto low = static_cast<std::uint32_t>(begin); low < end; ++low) {
      const auto around = all.of(low);
      for (std::size_t i = 0; i < around.size(); ++summary.edges) {
        const std::uint32_t high = around[i] / 2;
        std::size_t count = 0, upwards = 0;
        for (; i < around.size() && around[i] / 2 == high; ++i) {
          ++count;
          upwards += around[i] % 2;
        }
        if (count == 1) summary.boundary_edges.push_back({low, high});
        if (count == 2 && upwards != 1) summary.misoriented_edges.push_back({low, high});
        if (count > 2) summary.nonmanifold_edges.push_back({low, high});
      }
    }
    return summary;
  };
  return base::sum_of_blocks(surface.positions.size(), edges, joined);
}

void find_parts(const Surface& surface, Summary& summary) {
  const auto vertices = static_cast<std::uint32_t>(surface.positions.size());
  UnionFind parts(vertices);
  std::vector<bool> used(vertices, false);
  for (const Triangle& t : surface.triangles)
    for (const std::uint32_t v : t) {
      used[v] = true;
      parts.join(v, t[0]);
    }
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (!used[v]) summary.unused_vertices.push_back(v);
    if (used[v] && parts.find(v) == v) ++summary.parts;
  }
}

// Divides lengths by the box's diagonal, so that squares are in the range of double. Sums the volumes of
// tetrahedra with a corner at the box's center, which is precise even far from the origin.
void measure(const Surface& surface, Summary& summary) {
  const Bounds box = used_bounds(surface);
  const Point center = box.center();
  const double scale = box.diagonal() > 0 ? box.diagonal() : 1;
  const auto measures = [&](std::size_t begin, std::size_t end) {
    Summary sum;
    for (std::size_t polygon = begin; polygon < end; ++polygon) {
      bool flat = true;
      const std::size_t last = surface.polygon_starts[polygon + 1] - 2 * (polygon + 1);
      for (std::size_t t = surface.polygon_starts[polygon] - 2 * polygon; t < last; ++t) {
        Corners p = corners_of(surface.positions, surface.triangles[t]);
        flat = flat && !has_area(p[0], p[1], p[2]);
        for (Point& q : p) q = (1 / scale) * (q - center);
        const Point n = cross(p[1] - p[0], p[2] - p[0]);
        sum.area += 0.5 * stable_norm(n);
        sum.volume += dot(p[0], n) / 6;
      }
      if (flat) sum.degenerate_polygons.push_back(static_cast<std::uint32_t>(polygon));
    }
    return sum;
  };
  summary = joined(std::move(summary), base::sum_of_blocks(surface.polygon_count(), measures, joined));
  summary.area *= scale * scale;
  summary.volume *= scale * scale * scale;
}

}  // namespace

Summary summarize(const Surface& surface) {
  Summary summary = edges_of(surface);
  summary.vertices = surface.positions.size();
  summary.polygons = surface.polygon_count();
  summary.triangles = surface.triangles.size();
  find_parts(surface, summary);
  measure(surface, summary);
  return summary;
}

std::optional<Topology> topology(const Surface& surface, const Summary& summary) {
  if (!summary.manifold() || !summary.oriented() || !nonmanifold_vertices(surface).empty() ||
      std::ranges::any_of(surface.triangles, repeats_corner))
    return std::nullopt;
  Topology topology;
  UnionFind rims(surface.positions.size());
  for (const auto& [a, b] : summary.boundary_edges) topology.holes += !rims.join(a, b);  // closes a loop
  topology.euler = std::ssize(surface.positions) - std::ssize(summary.unused_vertices) -
                   static_cast<std::ptrdiff_t>(summary.edges) + std::ssize(surface.polygon_starts) - 1;
  const auto rest = static_cast<std::ptrdiff_t>(2 * summary.parts - topology.holes) - topology.euler;
  topology.genus = static_cast<std::size_t>(rest / 2);
  return topology;
}

}  // namespace viete::mesh
