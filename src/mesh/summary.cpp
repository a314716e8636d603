#include "mesh/summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/normals.h"
#include "mesh/point_tree.h"
#include "mesh/triangle.h"
#include "mesh/triangle_tree.h"
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

namespace {

std::vector<std::uint8_t> used_vertices(const Surface& surface) {
  std::vector<std::uint8_t> used(surface.positions.size(), 0);
  for (const auto v : surface.corners) used[v] = 1;
  return used;
}

std::vector<std::uint32_t> marked(const std::vector<std::uint8_t>& marks) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < marks.size(); ++i)
    if (marks[i]) numbers.push_back(i);
  return numbers;
}

}  // namespace

std::vector<std::uint32_t> duplicate_vertices(const Surface& surface) {
  const auto used = used_vertices(surface);
  const auto lowest = lowest_in_place(surface.positions);
  std::vector<std::uint8_t> seen(surface.positions.size(), 0);
  std::vector<std::uint32_t> doubled;
  for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
    if (used[v] && std::exchange(seen[lowest[v]], 1)) doubled.push_back(v);
  }
  return doubled;
}

std::vector<std::uint32_t> nonmanifold_vertices(const Surface& surface) {
  const Adjacency around = vertex_triangles(surface.positions.size(), surface.triangles);
  std::vector<std::uint8_t> pinched(surface.positions.size(), 0);
  base::for_blocks(pinched.size(), [&](std::size_t begin, std::size_t end) {
    UnionFind joined;                                  // triangles at one vertex, joined by common edges
    std::vector<std::array<std::uint32_t, 2>> spokes;  // {another corner, its triangle in `joined`}
    for (std::size_t v = begin; v < end; ++v) {
      spokes.clear();
      std::uint32_t count = 0;
      for (const std::uint32_t t : around.of(v)) {
        if (repeats_corner(surface.triangles[t])) continue;
        for (const std::uint32_t corner : surface.triangles[t])
          if (corner != v) spokes.push_back({corner, count});
        ++count;
      }
      std::ranges::sort(spokes);
      joined.reset(count);
      for (std::size_t i = 1; i < spokes.size(); ++i)
        if (spokes[i][0] == spokes[i - 1][0]) count -= joined.join(spokes[i][1], spokes[i - 1][1]);
      pinched[v] = count > 1;
    }
  });
  return marked(pinched);
}

std::vector<std::uint32_t> thin_triangles(const Surface& surface, double ratio) {
  std::vector<std::uint32_t> thin;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [i, j, k] = surface.triangles[t];
    const Point &a = surface.positions[i], &b = surface.positions[j], &c = surface.positions[k];
    if (!has_area(a, b, c)) continue;
    const Point u = b - a, v = c - a;
    const double longest = std::max({stable_norm(u), stable_norm(v), stable_norm(v - u)});
    const double height = norm(cross((1 / longest) * u, (1 / longest) * v));  // divided by `longest`
    if (height < ratio) thin.push_back(t);
  }
  return thin;
}

std::vector<std::uint32_t> self_intersecting_triangles(const Surface& surface, base::Progress* progress) {
  if (surface.triangles.empty()) return {};
  // Scales the positions by a power of two. The scaling is exact and keeps products in the range of double.
  const Bounds all = used_bounds(surface);
  const double largest = std::max(largest_abs(all.low), largest_abs(all.high));
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  std::vector<Point> positions = surface.positions;
  for (Point& p : positions) {
    for (double& x : p) x = std::ldexp(x, exponent);
  }
  const TriangleTree tree(positions, surface.triangles);
  std::vector<Corners> corners;
  std::vector<std::uint8_t> is_plane, found(surface.triangles.size(), 0);
  for (const Triangle& t : surface.triangles) {
    corners.push_back(corners_of(positions, t));
    is_plane.push_back(has_plane(corners.back()));
  }
  for (std::uint32_t t = 0; t < found.size(); ++t) {
    if (progress && t % 256 == 0)
      progress->report(static_cast<double>(t) / static_cast<double>(found.size()));
    if (!is_plane[t]) continue;
    tree.for_meeting(bounds(corners[t]), [&](std::uint32_t s) {
      if (s >= t || !is_plane[s] || (found[s] && found[t])) return;
      if (intersect(corners[s], corners[t])) found[s] = found[t] = 1;
    });
  }
  return marked(found);
}

}  // namespace viete::mesh
