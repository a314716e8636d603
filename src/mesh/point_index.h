// A hash table of points, over an array of positions that the caller keeps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Hash table with open addressing and linear probing, at most half full.
class PointIndex {
public:
  /// The index of the position with the same bits as p, or positions.size(); the caller then appends p.
  std::uint32_t find_or_add(const Point& p, const std::vector<Point>& positions);

private:
  void grow(const std::vector<Point>& positions);
  std::size_t slot_of(const Point& p, const std::vector<Point>& positions) const;

  std::vector<std::uint32_t> slots_;  // vertex + 1, or 0 where free; the size is a power of two
  std::size_t used_ = 0;
};

/// For each vertex the lowest vertex at exactly the same position. Linear.
std::vector<std::uint32_t> lowest_in_place(std::span<const Point> positions);

}  // namespace viete::mesh
