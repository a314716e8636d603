// The model's vertices in leaves of neighbours, cut into tiles, and the one-ring of each vertex in that
// order.
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

inline constexpr std::size_t ring_group = 4;  ///< slots whose rings are gone through together
/// Neighbours are stored as numbers of floats divided by this: half the four floats of a position, so that
/// the processor scales them when it forms an address.
inline constexpr std::size_t index_floats = 2;
inline constexpr std::uint16_t closed_ring = 0x8000;  ///< added to the length of a group of closed rings

/// The normal of a vertex v with neighbours n_0, n_1, ... is the direction of the sum of
/// (n_i - v) x (n_i+1 - v), each of which is twice the area vector of a triangle. A vertex whose triangles
/// form several fans has them one after the other with v itself in between: those products are 0. So every
/// surface has such lists, manifold or not, and each vertex can be computed alone.
///
/// Four slots form a group, padded to one length: closed, if all four rings are and have the same length, the
/// first neighbour following the last; else open, a closed ring then ending where it began, all with the same
/// odd number of neighbours, shorter ones filled up with v. (Within a leaf vertices are sorted by their
/// number of triangles, so that little is padded.)
///
/// Positions lie in one array, leaf after leaf: first those of the leaf's slots, then its ghosts, which are
/// copies of neighbours that other leaves own, padded to whole groups. Leaf l has positions
/// [position_starts[l], position_starts[l + 1]), and its neighbours count from the first of them.
struct Rings {
  std::vector<std::uint32_t> position_starts;  ///< one more than leaves
  std::vector<std::uint32_t> ghosts;  ///< positions copied; leaf l's begin at position_starts[l] - begin(l)
  std::vector<std::uint32_t> neighbour_starts;  ///< one more than leaves
  std::vector<std::uint16_t> neighbours;        ///< [group][neighbour][slot of the group]
  std::vector<std::uint16_t> lengths;  ///< neighbours of each group, plus closed_ring where that holds

  /// A vertex with so many neighbours that 16 bits might not count the positions of its leaf. In its group it
  /// stands as a vertex without triangles. Its own list is open, and counts whole positions from the first.
  struct HighValence {
    std::uint32_t slot, position;
    std::vector<std::uint32_t> neighbours;
  };
  std::vector<HighValence> high_valence;

  std::size_t position_count() const { return position_starts.back(); }
  std::size_t bytes() const;
};

/// Linear. Triangles that repeat a corner are left out.
Rings make_rings(const Leaves& leaves, std::span<const mesh::Triangle> triangles);

}  // namespace viete::deform
