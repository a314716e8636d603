// Finds equal points with a hash table.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// A hash table of points. The caller stores the points in an array.
class PointIndex {
public:
  /// Returns the index of p in the array. If the array does not contain p, returns positions.size(); then the
  /// caller must append p. Compares bits: -0 and 0 are different.
  std::uint32_t find_or_add(const Point& p, const std::vector<Point>& positions);

private:
  void grow(const std::vector<Point>& positions);
  std::size_t slot_of(const Point& p, const std::vector<Point>& positions) const;

  std::vector<std::uint32_t> slots_;  // the index + 1, or 0 if the slot is free; the size is a power of two
  std::size_t used_ = 0;
};

/// Returns, for each vertex, the lowest vertex at exactly the same position.
std::vector<std::uint32_t> lowest_in_place(std::span<const Point> positions);

}  // namespace viete::mesh
