// Finds equal points by a hash table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// A hash table of points. The caller owns the array of the points.
class PointIndex {
public:
  /// Returns the index of p in `positions`. If p is new, returns positions.size(), and the caller must append
  /// p to the array. A coordinate -0 is usually not found as 0, because their bits differ.
  std::uint32_t find_or_add(const Point& p, const std::vector<Point>& positions);

private:
  void grow(const std::vector<Point>& positions);
  std::size_t slot_of(const Point& p, const std::vector<Point>& positions) const;

  // index + 1, or 0 for a free slot; the size is a power of two
  std::vector<std::uint32_t> slots_ = std::vector<std::uint32_t>(1024, 0);
  std::size_t used_ = 0;
};

/// Returns for each vertex the lowest index of the vertices at exactly the same position.
std::vector<std::uint32_t> lowest_in_place(std::span<const Point> positions);

}  // namespace viete::mesh
