#include "mesh/defects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/worker_pool.h"
#include "mesh/normals.h"
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
