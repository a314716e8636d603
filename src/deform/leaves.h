// The model's vertices in an order for locality: leaves of neighbours, each cut into tiles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::deform {

inline constexpr std::size_t leaf_slots = 512;
inline constexpr std::size_t slot_block = 32;  ///< leaves are padded to multiples of it

/// Slot s holds the file's vertex order[s]. Leaf l owns slots [512 l, 512 (l + 1)); all are full but the
/// last, which is padded to a multiple of 32 by repeating its last vertex. Within a leaf vertices are
/// sorted by their number of triangles, so that loops around them have the same length for long.
struct Leaves {
  std::vector<std::uint32_t> order;  ///< slot_count() entries
  std::size_t vertices = 0;          ///< slots [vertices, slot_count()) are padding

  std::size_t slot_count() const { return order.size(); }
  std::size_t count() const { return (order.size() + leaf_slots - 1) / leaf_slots; }
  std::size_t begin(std::size_t leaf) const { return leaf * leaf_slots; }
  std::size_t end(std::size_t leaf) const { return std::min(order.size(), (leaf + 1) * leaf_slots); }
};

/// The slot of each vertex.
std::vector<std::uint32_t> slots_of(const Leaves& leaves);

/// A kd tree: halves along the longest side of the box. triangles_around: how many each vertex has. O(n log
/// n). positions must not be empty.
Leaves make_leaves(std::span<const mesh::Point> positions, std::span<const std::uint32_t> triangles_around);

}  // namespace viete::deform
