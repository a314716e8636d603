// Positions that files can hold: whatever is written goes through this one check.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "mesh/surface.h"

namespace viete::mesh {

inline constexpr double largest_float = std::numeric_limits<float>::max();

/// False also where a coordinate is not a number.
inline bool is_place(const Point& p, double largest = largest_coordinate) {
  return std::abs(p[0]) <= largest && std::abs(p[1]) <= largest && std::abs(p[2]) <= largest;
}

/// Throws base::Error where such a position is none that a reader would take again. largest: of the numbers
/// that the file holds. place: the file, its frame.
void check_written(const std::string& place, std::size_t vertex, const Point& p,
                   double largest = largest_coordinate);
/// The same of all vertices, the first one first.
void check_written(const std::string& place, std::span<const Point> positions,
                   double largest = largest_coordinate);

}  // namespace viete::mesh
