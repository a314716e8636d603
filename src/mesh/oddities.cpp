#include "mesh/oddities.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "mesh/normals.h"
#include "mesh/point_index.h"

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
    parent_.resize(around.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
    spokes_.clear();
    for (std::uint32_t i = 0; i < around.size(); ++i) {
      for (const auto v : around[i]) spokes_.push_back({v, i});
    }
    std::sort(spokes_.begin(), spokes_.end());
    std::size_t fans = around.size();
    for (std::size_t i = 1; i < spokes_.size(); ++i) {
      if (spokes_[i][0] == spokes_[i - 1][0]) fans -= joined(spokes_[i][1], spokes_[i - 1][1]);
    }
    return fans;
  }

private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  // True if they were apart.
  bool joined(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[a] = b;
    return a != b;
  }

  std::vector<std::uint32_t> parent_;
  std::vector<std::array<std::uint32_t, 2>> spokes_;  // the vertex at its end, the triangle beside it
};

}  // namespace

std::vector<std::uint32_t> doubled_vertices(const Surface& surface) {
  const auto used = used_vertices(surface);
  std::vector<std::uint32_t> doubled;
  std::vector<Point> places;
  PointIndex index;
  for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
    if (!used[v]) continue;
    Point p = surface.positions[v];
    for (double& x : p) x += 0.0;  // -0 is at the place of 0
    const auto place = index.find_or_add(p, places);
    if (place < places.size()) {
      doubled.push_back(v);
    } else {
      places.push_back(p);
    }
  }
  return doubled;
}

std::vector<std::uint32_t> pinched_vertices(const Surface& surface) {
  const auto triangles = vertex_triangles(surface.positions.size(), surface.triangles);
  std::vector<std::uint32_t> pinched;
  std::vector<std::array<std::uint32_t, 2>> around;
  Fans fans;
  for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
    around.clear();
    for (auto i = triangles.starts[v]; i < triangles.starts[v + 1]; ++i) {
      const Triangle& t = surface.triangles[triangles.triangles[i]];
      if (!repeats_corner(t)) around.push_back(others(t, v));
    }
    if (fans.count(around) > 1) pinched.push_back(v);
  }
  return pinched;
}

std::vector<std::uint32_t> thin_triangles(const Surface& surface, double ratio) {
  constexpr double no_area = 1e-12;  // as in Facts
  std::vector<std::uint32_t> thin;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    Point u = surface.positions[b] - surface.positions[a];
    Point v = surface.positions[c] - surface.positions[a];
    const double longest = std::max({stable_norm(u), stable_norm(v), stable_norm(v - u)});
    if (!(longest > 0)) continue;
    for (int k = 0; k < 3; ++k) u[k] /= longest, v[k] /= longest;
    const double height = stable_norm(cross(u, v));
    if (height > no_area && height < ratio) thin.push_back(t);
  }
  return thin;
}

}  // namespace viete::mesh
