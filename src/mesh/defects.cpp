#include "mesh/defects.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/normals.h"
#include "mesh/repair.h"
#include "mesh/triangle.h"
#include "mesh/union_find.h"

namespace viete::mesh {

namespace {

std::vector<std::uint8_t> used_vertices(const Surface& surface) {
  std::vector<std::uint8_t> used(surface.positions.size(), 0);
  for (const auto v : surface.corners) used[v] = 1;
  return used;
}

// The two vertices that a triangle has besides v.
std::array<std::uint32_t, 2> others(const Triangle& t, std::uint32_t v) {
  const int i = t[0] == v ? 0 : t[1] == v ? 1 : 2;
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

// Fans are parts of the graph whose nodes are the triangles around a vertex, joined by edges through it.
class Fans {
public:
  std::size_t count(const std::vector<std::array<std::uint32_t, 2>>& around) {
    parts_.reset(around.size());
    spokes_.clear();
    for (std::uint32_t i = 0; i < around.size(); ++i) {
      for (const auto v : around[i]) spokes_.push_back({v, i});
    }
    std::sort(spokes_.begin(), spokes_.end());
    std::size_t fans = around.size();
    for (std::size_t i = 1; i < spokes_.size(); ++i) {
      if (spokes_[i][0] == spokes_[i - 1][0]) fans -= parts_.join(spokes_[i][1], spokes_[i - 1][1]);
    }
    return fans;
  }

private:
  UnionFind parts_;
  std::vector<std::array<std::uint32_t, 2>> spokes_;  // the vertex at its end, the triangle beside it
};

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
  const auto triangles = vertex_triangles(surface.positions.size(), surface.triangles);
  std::vector<std::uint32_t> pinched;
  std::vector<std::array<std::uint32_t, 2>> around;
  Fans fans;
  for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
    around.clear();
    for (const auto t : triangles.of(v)) {
      if (!repeats_corner(surface.triangles[t])) around.push_back(others(surface.triangles[t], v));
    }
    if (fans.count(around) > 1) pinched.push_back(v);
  }
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
    const double height = norm(cross((1 / longest) * u, (1 / longest) * v));  // to the longest edge
    if (height < ratio) thin.push_back(t);
  }
  return thin;
}

}  // namespace viete::mesh
