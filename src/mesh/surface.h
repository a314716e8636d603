// A polygon surface as flat arrays, filled by every reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesh/vector.h"

namespace viete::mesh {

using Point = Vec3;
using Triangle = std::array<std::uint32_t, 3>;

/// Limit of coordinates; files beyond it are rejected, so that volumes stay finite.
inline constexpr double largest_coordinate = 1e100;

/// Index value for "no element".
inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Positions in the file's order and full precision, polygons as in the file, and their triangulation.
/// Invariants (guaranteed by readers): indices < positions.size(); positions finite; triangles in polygon
/// order as made by triangulate(), n - 2 for a polygon with n corners.
struct Surface {
  std::vector<Point> positions;
  std::vector<std::uint32_t> corners;  ///< vertices, polygon by polygon, counter-clockwise from outside
  std::vector<std::uint32_t> polygon_starts;  ///< polygon p has corners [starts[p], starts[p + 1])
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> triangle_polygon;  ///< the polygon of each triangle
  /// Triangles of polygons that are not a fan about their first corner, as indices into corners.
  std::vector<Triangle> clipped;

  std::size_t polygon_count() const { return polygon_starts.empty() ? 0 : polygon_starts.size() - 1; }
};

/// Calls use(triangle, corners) for each triangle in order; corners are indices into Surface::corners.
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

/// The part of `clipped` that belongs to the polygon; empty for a fan.
std::span<const Triangle> clipped_of(const Surface& surface, std::size_t polygon);

/// True if the polygons are equal, or if the triangles are equal and only the polygons differ.
bool same_faces(const Surface& a, const Surface& b);

/// A surface of triangles only (polygons = triangles).
Surface from_triangles(std::vector<Point> positions, const std::vector<Triangle>& triangles);

/// Axis-aligned bounding box. No points give the box (0,0,0)-(0,0,0).
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

Bounds bounds(std::span<const Point> positions);
/// The box of the listed positions.
Bounds bounds(std::span<const Point> positions, std::span<const std::uint32_t> some);

/// The box of all vertices used by a polygon; of all vertices if there are no polygons.
Bounds used_bounds(const Surface& surface);

/// Twice the largest distance of those vertices from the area centroid (from their mean without area): a size
/// that does not depend on the rotation of the surface. For a box it is the diagonal.
double used_size(const Surface& surface);

/// base::Checksum of the values and order of positions and triangles. Depends on the machine's byte order.
/// Memory-bound.
std::uint64_t content_key(const Surface& surface);

}  // namespace viete::mesh
