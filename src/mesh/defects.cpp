#include "mesh/defects.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/half_edges.h"
#include "mesh/point_index.h"
#include "mesh/triangle.h"
#include "mesh/triangle_tree.h"
#include "mesh/union_find.h"

namespace viete::mesh {

namespace {

std::vector<std::uint8_t> used_vertices(const Surface& surface) {
  std::vector<std::uint8_t> used(surface.positions.size(), 0);
  for (const auto v : surface.corners) used[v] = 1;
  return used;
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
  const auto& triangles = surface.triangles;
  const HalfEdges table = half_edges(surface.positions.size(), triangles);
  const auto corner = [&](std::uint32_t t, std::uint32_t v) {
    return 3 * t + static_cast<std::uint32_t>(std::ranges::find(triangles[t], v) - triangles[t].begin());
  };
  UnionFind fans(3 * triangles.size());  // corners at one vertex, joined across edges
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto first = table.of(e)[0].triangle;
    for (const HalfEdge& side : table.of(e)) {
      for (const auto v : table.edges[e]) fans.join(corner(first, v), corner(side.triangle, v));
    }
  }
  std::vector<std::uint32_t> fan_of(surface.positions.size(), none), pinched;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (repeats_corner(triangles[t])) continue;
    for (const auto v : triangles[t]) {
      const auto fan = fans.find(corner(t, v)), known = std::exchange(fan_of[v], fan);
      if (known != none && known != fan) pinched.push_back(v);
    }
  }
  std::ranges::sort(pinched);
  pinched.erase(std::unique(pinched.begin(), pinched.end()), pinched.end());
  return pinched;
}

std::vector<std::uint32_t> thin_triangles(const Surface& surface, double ratio) {
  std::vector<std::uint32_t> thin;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [i, j, k] = surface.triangles[t];
    const Point &a = surface.positions[i], &b = surface.positions[j], &c = surface.positions[k];
    if (!has_area(a, b, c)) continue;
    const Point u = b - a, v = c - a;
    const double longest = std::max({stable_norm(u), stable_norm(v), stable_norm(v - u)});
    const double height = norm(cross((1 / longest) * u, (1 / longest) * v));  // over the longest edge
    if (height < ratio) thin.push_back(t);
  }
  return thin;
}

std::vector<std::uint32_t> self_intersecting_triangles(const Surface& surface, base::Progress* progress) {
  std::vector<std::uint32_t> crossing;
  if (surface.triangles.empty()) return crossing;
  // Scales by a power of two, which is exact, so that products stay within the range of double.
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
  for (std::uint32_t t = 0; t < found.size(); ++t) {
    if (found[t]) crossing.push_back(t);
  }
  return crossing;
}

}  // namespace viete::mesh
