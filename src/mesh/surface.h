// The polygon surface: flat arrays that every reader fills.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "mesh/vector.h"

namespace viete::mesh {

using Point = Vec3;
using Triangle = std::array<std::uint32_t, 3>;
using Edge = std::array<std::uint32_t, 2>;  ///< two different vertices; the lower index is first

/// The largest absolute value of a coordinate. Larger values are rejected, so that volumes stay finite.
inline constexpr double largest_coordinate = 1e100;

/// The index that means "no element".
inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// A polygon surface. Positions and polygons have the order of the file; positions have full precision.
/// Readers guarantee: Indices are less than positions.size(). Positions are finite. Triangles are results of
/// triangulate(), in polygon order; a polygon with n corners has n - 2 triangles.
struct Surface {
  std::vector<Point> positions;
  std::vector<std::uint32_t> corners;  ///< vertices of each polygon, counter-clockwise as seen from outside
  std::vector<std::uint32_t> polygon_starts;  ///< the first corner of each polygon, then corners.size()
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> triangle_polygon;  ///< the polygon of each triangle
  /// The triangles of polygons that are not triangulated as a fan. Entries are indices into `corners`.
  std::vector<Triangle> clipped;

  std::size_t polygon_count() const { return polygon_starts.empty() ? 0 : polygon_starts.size() - 1; }
  std::span<const std::uint32_t> polygon(std::size_t p) const {
    return std::span(corners).subspan(polygon_starts[p], polygon_starts[p + 1] - polygon_starts[p]);
  }
};

/// Calls use(triangle, corners) for each triangle in order. `corners` has indices into Surface::corners.
template <class Use>
void for_each_triangle(const Surface& s, const Use& use) {
  std::size_t t = 0, own = 0;
  for (std::size_t p = 0; p < s.polygon_count(); ++p) {
    const std::uint32_t first = s.polygon_starts[p], end = s.polygon_starts[p + 1];
    const bool is_fan = own == s.clipped.size() || s.clipped[own][0] >= end;
    for (std::uint32_t c = first + 2; c < end; ++c, ++t)
      use(s.triangles[t], is_fan ? Triangle{first, c - 1, c} : s.clipped[own++]);
  }
}

/// Returns the polygon's triangles in `clipped`; empty if the polygon is a fan.
std::span<const Triangle> clipped_of(const Surface& surface, std::size_t polygon);

/// True if the polygons are equal or the triangles are equal.
bool same_faces(const Surface& a, const Surface& b);

/// Makes a surface of triangles. Each triangle is a polygon.
Surface from_triangles(std::vector<Point> positions, const std::vector<Triangle>& triangles);

/// Returns a pointer that does not own the surface. The surface must outlive all copies of the pointer.
inline std::shared_ptr<const Surface> lent(const Surface& surface) {
  return {std::shared_ptr<void>(), &surface};
}

/// An axis-aligned bounding box. If there are no points, both corners are 0.
struct Bounds {
  Point low{0, 0, 0}, high{0, 0, 0};

  Point center() const;
  double diagonal() const;
};

/// True if the boxes touch or overlap.
inline bool meet(const Bounds& a, const Bounds& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

/// Widens the box to contain a point.
inline void extend(Bounds& box, const Point& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], p[k]);
    box.high[k] = std::max(box.high[k], p[k]);
  }
}

/// Returns the values of some vertices. Without values, returns none.
template <class T, class Indices>
std::vector<T> picked(std::span<const T> values, const Indices& vertices) {
  std::vector<T> some;
  if (values.empty()) return some;
  some.reserve(vertices.size());
  for (const auto v : vertices) some.push_back(values[v]);
  return some;
}

/// Returns 0, 1, 2, ..., count - 1.
std::vector<std::uint32_t> first_numbers(std::size_t count);

Bounds bounds(std::span<const Point> positions);
/// Returns the box of the listed positions.
Bounds bounds(std::span<const Point> positions, std::span<const std::uint32_t> some);

/// Returns the box of the vertices that polygons use or, if there are no polygons, of all vertices.
Bounds used_bounds(const Surface& surface);

/// Returns twice the largest distance from the surface's centroid to a used vertex. For a box, this is the
/// diagonal. Rotations do not change the size. Without area, the mean of used vertices replaces the centroid.
double used_size(const Surface& surface);

/// Returns a base::Checksum of positions and triangles in their order. Depends on the processor's byte order.
std::uint64_t content_key(const Surface& surface);

}  // namespace viete::mesh
