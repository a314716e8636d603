// A polygon surface as flat arrays: what every reader fills and every later stage reads.
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

/// Files with larger ones are refused, so that volumes stay finite.
inline constexpr double largest_coordinate = 1e100;

/// In place of an index: there is none.
inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Positions in the file's order and full precision; polygons as the file has them; triangles for work.
/// Invariants (kept by the readers): every index < positions.size(); every position finite; triangles are
/// those of one polygon after the other as triangulate() cuts them, n - 2 of one with n corners.
struct Surface {
  std::vector<Point> positions;
  std::vector<std::uint32_t> corners;  ///< of one polygon after the other, counter-clockwise from outside
  std::vector<std::uint32_t> polygon_starts;  ///< p owns corners [starts[p], starts[p + 1])
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> triangle_polygon;  ///< the polygon that each triangle was cut from
  /// Of the triangles of polygons that are no fans about their first corner: places in corners.
  std::vector<Triangle> clipped;

  std::size_t polygon_count() const { return polygon_starts.empty() ? 0 : polygon_starts.size() - 1; }
};

/// use(triangle, corners) for each of triangles, in order; corners: its places in Surface::corners.
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

/// Those of `clipped` that are of the polygon: none of a fan.
std::span<const Triangle> clipped_of(const Surface& surface, std::size_t polygon);

/// True if they have the same polygons, or the same triangles of other ones.
bool same_faces(const Surface& a, const Surface& b);

/// A surface of triangles only (polygons = triangles).
Surface from_triangles(std::vector<Point> positions, const std::vector<Triangle>& triangles);

/// The smallest axis-parallel box. An empty set of points gives the box (0,0,0)-(0,0,0).
struct Bounds {
  Point low{0, 0, 0}, high{0, 0, 0};

  Point center() const;
  double diagonal() const;
};

/// True if the boxes share a point.
inline bool meet(const Bounds& a, const Bounds& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

Bounds bounds(std::span<const Point> positions);
/// Of these positions alone.
Bounds bounds(std::span<const Point> positions, std::span<const std::uint32_t> some);

/// The box of the vertices that a polygon uses (stray vertices do not count); of all vertices if there is no
/// polygon.
Bounds used_bounds(const Surface& surface);

/// Twice as far as the farthest of those vertices is from the centre of the surface's area (from their mean
/// where it has none): of a box its diagonal, and the same however the surface is turned, which the diagonal
/// of its bounds is not.
double used_size(const Surface& surface);

/// base::Checksum of positions and triangles: of their values and their order. Depends on the machine's byte
/// order. At the speed of memory.
std::uint64_t content_key(const Surface& surface);

}  // namespace viete::mesh
