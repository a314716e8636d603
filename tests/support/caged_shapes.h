// Cages, models and poses for the tests of pose, weights, deform and shapes.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "pose/cage.h"
#include "support/distance.h"
#include "support/random.h"
#include "sym3/rotation.h"

// Not every test includes a header of each room.
namespace viete::sparse {}
namespace viete::weights {}
namespace viete::deform {}
namespace viete::shapes {}

namespace viete::test {

using mesh::Vec3;
using namespace pose;
using namespace weights;
using namespace deform;
using namespace shapes;
using namespace sparse;

inline constexpr double degree = std::numbers::pi / 180;

/// Returns a box of 12 triangles that face outward.
inline mesh::Surface box(const Vec3& half = {1, 1, 1}, const Vec3& center = {0, 0, 0}) {
  std::vector<mesh::Point> p;
  for (int i = 0; i < 8; ++i)
    p.push_back({center[0] + (i & 1 ? half[0] : -half[0]), center[1] + (i & 2 ? half[1] : -half[1]),
                 center[2] + (i & 4 ? half[2] : -half[2])});
  return mesh::from_triangles(p, {{0, 2, 3},
                                  {0, 3, 1},
                                  {4, 5, 7},
                                  {4, 7, 6},
                                  {0, 1, 5},
                                  {0, 5, 4},
                                  {2, 6, 7},
                                  {2, 7, 3},
                                  {0, 4, 6},
                                  {0, 6, 2},
                                  {1, 3, 7},
                                  {1, 7, 5}});
}

/// Returns a closed tube along z, centered at z = 0. The last two vertices are the centers of the caps.
inline mesh::Surface tube(std::uint32_t rings, std::uint32_t sides, double radius, double length) {
  std::vector<mesh::Point> p;
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < sides; ++s) {
      const double a = 2 * std::numbers::pi * s / sides;
      p.push_back({radius * std::cos(a), radius * std::sin(a), length * (double(r) / (rings - 1) - 0.5)});
    }
  p.push_back({0, 0, -length / 2});
  p.push_back({0, 0, length / 2});
  std::vector<mesh::Triangle> t;
  for (std::uint32_t s = 0; s < sides; ++s) {
    const std::uint32_t n = (s + 1) % sides, top = (rings - 1) * sides;
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      const std::uint32_t a = r * sides + s, b = r * sides + n;
      t.push_back({a, b, b + sides});
      t.push_back({a, b + sides, a + sides});
    }
    t.push_back({rings * sides, n, s});
    t.push_back({rings * sides + 1, top + s, top + n});
  }
  return mesh::from_triangles(p, t);
}

/// Returns a grid of n x n squares with side 1 in the plane z = 0.
inline mesh::Surface grid(std::uint32_t n) {
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      p.push_back({double(i), double(j), 0});
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      if (i < n && j < n) {
        t.push_back({a, b, b + 1});
        t.push_back({a, b + 1, a + 1});
      }
    }
  return mesh::from_triangles(p, t);
}

/// Returns both surfaces as one surface. They are not connected.
inline mesh::Surface together(const mesh::Surface& a, const mesh::Surface& b) {
  auto p = a.positions;
  p.insert(p.end(), b.positions.begin(), b.positions.end());
  auto t = a.triangles;
  const auto n = static_cast<std::uint32_t>(a.positions.size());
  for (const auto& x : b.triangles) t.push_back({x[0] + n, x[1] + n, x[2] + n});
  return mesh::from_triangles(p, t);
}

/// The map x -> linear * x + shift.
struct Affine {
  sym3::Mat3<double> linear{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 shift{0, 0, 0};

  Vec3 operator()(const Vec3& x) const {
    const auto& m = linear;
    return Vec3{m[0] * x[0] + m[1] * x[1] + m[2] * x[2], m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
                m[6] * x[0] + m[7] * x[1] + m[8] * x[2]} +
           shift;
  }
};

/// Returns a map that rotates by `angle` radians about `axis`, then scales, then moves.
inline Affine similarity(Vec3 axis, double angle, double scale = 1, const Vec3& shift = {0, 0, 0}) {
  Affine map{sym3::exp_rotation<double>((angle / norm(axis)) * axis), shift};
  for (double& x : map.linear) x *= scale;
  return map;
}

/// Returns the shear of the pose_affine files.
inline Affine shear() {
  return {{1.2, 0.3, -0.1, -0.2, 0.9, 0.25, 0.15, -0.35, 1.1}, {0.3, -0.2, 0.1}};
}

template <class Map>
std::vector<mesh::Point> mapped(std::span<const mesh::Point> points, const Map& map) {
  std::vector<mesh::Point> result;
  for (const auto& p : points) result.push_back(map(p));
  return result;
}

template <class Map>
mesh::Surface mapped(mesh::Surface surface, const Map& map) {
  for (auto& p : surface.positions) p = map(p);
  return surface;
}

inline Affine scaling(double scale, const Vec3& shift = {0, 0, 0}) {
  return {{scale, 0, 0, 0, scale, 0, 0, 0, scale}, shift};
}

/// Separates the triangles: each triangle gets its own vertices.
inline mesh::Surface loose_triangles(const mesh::Surface& surface) {
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  for (const auto& corners : surface.triangles) {
    const auto n = static_cast<std::uint32_t>(p.size());
    for (const auto v : corners) p.push_back(surface.positions[v]);
    t.push_back({n, n + 1, n + 2});
  }
  return mesh::from_triangles(p, t);
}

/// A twist about an axis through `center`. Between the coordinates `from` and `to` on this axis, the angle
/// grows from `low` to `high` radians.
struct Twist {
  int axis;
  Vec3 center;
  double from, to, low, high;

  Vec3 operator()(const Vec3& x) const {
    Vec3 w{0, 0, 0};
    w[axis] = low + (high - low) * (x[axis] - from) / (to - from);
    return Affine{sym3::exp_rotation<double>(w), center}(x - center);
  }
};

/// Returns the largest ratio of an edge's posed length to its rest length. Tears make the ratio large.
inline double largest_edge_stretch(const mesh::Surface& rest, std::span<const mesh::Point> posed) {
  double largest = 0;
  for (const auto& t : rest.triangles)
    for (int i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      const double before = norm(rest.positions[a] - rest.positions[b]);
      if (before > 0) largest = std::max(largest, norm(posed[a] - posed[b]) / before);
    }
  return largest;
}

inline bool all_finite(std::span<const mesh::Point> points) {
  for (const auto& p : points)
    for (const double x : p)
      if (!std::isfinite(x)) return false;
  return true;
}

}  // namespace viete::test
