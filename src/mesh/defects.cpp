#include "mesh/defects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesh/normals.h"
#include "mesh/repair.h"
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

// The two vertices of a triangle other than v.
std::array<std::uint32_t, 2> others(const Triangle& t, std::uint32_t v) {
  const int i = t[0] == v ? 0 : t[1] == v ? 1 : 2;
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

// The fans of a vertex: components of its triangles, connected by edges through the vertex.
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
    const double height = norm(cross((1 / longest) * u, (1 / longest) * v));  // over the longest edge
    if (height < ratio) thin.push_back(t);
  }
  return thin;
}

namespace {

class Sweep {
public:
  explicit Sweep(const Surface& surface) : found_(surface.triangles.size(), 0) {
    const Bounds all = used_bounds(surface);
    for (int k = 1; k < 3; ++k) {
      if (all.high[k] - all.low[k] > all.high[axis_] - all.low[axis_]) axis_ = k;
    }
    take_corners(surface, all);
  }

  std::vector<std::uint32_t> run(base::Progress* progress) {
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (progress && i % 256 == 0)
        progress->report(static_cast<double>(i) / static_cast<double>(order_.size()));
      const auto t = order_[i];
      std::erase_if(open, [&](std::uint32_t s) { return boxes_[s].high[axis_] < boxes_[t].low[axis_]; });
      for (const auto s : open) test(s, t);
      open.push_back(t);
    }
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t t = 0; t < found_.size(); ++t) {
      if (found_[t]) triangles.push_back(t);
    }
    return triangles;
  }

private:
  // Scales by a power of two, which is exact, so that products stay within the range of double.
  void take_corners(const Surface& surface, const Bounds& all) {
    double largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(all.low[k]), std::abs(all.high[k])});
    const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
    for (const Triangle& t : surface.triangles) {
      Corners corners;
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) corners[i][k] = std::ldexp(surface.positions[t[i]][k], exponent);
      }
      if (has_plane(corners)) order_.push_back(static_cast<std::uint32_t>(corners_.size()));
      corners_.push_back(corners);
      boxes_.push_back(bounds(corners));
    }
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t s, std::uint32_t t) { return boxes_[s].low[axis_] < boxes_[t].low[axis_]; });
  }

  void test(std::uint32_t s, std::uint32_t t) {
    if ((found_[s] && found_[t]) || !meet(boxes_[s], boxes_[t])) return;
    if (intersect(corners_[s], corners_[t])) found_[s] = found_[t] = 1;
  }

  int axis_ = 0;
  std::vector<Corners> corners_;
  std::vector<Bounds> boxes_;
  std::vector<std::uint32_t> order_;  // triangles with area, sorted by their lower end on the axis
  std::vector<std::uint8_t> found_;
};

}  // namespace

std::vector<std::uint32_t> self_intersecting_triangles(const Surface& surface, base::Progress* progress) {
  return Sweep(surface).run(progress);
}

}  // namespace viete::mesh
