// Many small parts, such as leaves or hair cards: clusters that gather their vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::weights {

/// Returns a number that depends on every bit of x.
std::uint64_t mixed(std::uint64_t x);

/// Returns for each vertex whether it is in a small part, if the model has many of them; otherwise false. A
/// part is small if it would have few of `target` clusters of equal areas. Vertices must be welded.
std::vector<bool> in_small_parts(const mesh::Surface& model, std::span<const mesh::Triangle> triangles,
                                 std::size_t target);

/// The occupied cells of a grid in space.
struct Cells {
  double size;
  std::uint32_t count;
  std::vector<std::uint32_t> of_vertex;  ///< for each of the given vertices
};
/// Returns at most `most` cells. `vertices` must not be empty.
Cells cells_of(const mesh::Surface& model, std::span<const std::uint32_t> vertices, std::size_t most);

/// Returns triangles that join each of the points from `first` to the nearest points, in all directions.
std::vector<mesh::Triangle> joints(std::span<const mesh::Point> points, std::uint32_t first, double cell);

}  // namespace viete::weights
