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

/// Slot s stores vertex order[s] of the file. Leaf l owns slots [512 l, 512 (l + 1)); all leaves are full
/// except the last, which is padded to a multiple of 32 by repeating its last vertex. Within a leaf vertices
/// are sorted by their number of triangles, so that neighbouring slots have rings of equal length.
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

/// Builds a kd tree, split in halves along the longest side of the box. triangles_around: number of triangles
/// per vertex. O(n log n). positions must not be empty.
Leaves make_leaves(std::span<const mesh::Point> positions, std::span<const std::uint32_t> triangles_around);

inline constexpr std::size_t ring_group = 4;  ///< slots whose rings are processed together
/// Neighbours are stored as offsets in floats divided by this: half the four floats of a position, so that
/// address modes of the processor can scale them.
inline constexpr std::size_t index_floats = 2;
inline constexpr std::uint16_t closed_ring = 0x8000;  ///< added to the length of a group of closed rings

/// The normal of a vertex v with neighbours n_0, n_1, ... is the direction of the sum of (n_i - v) x (n_i+1 -
/// v), each twice the area vector of a triangle. If the triangles form several fans, their lists are
/// concatenated with v itself in between, which makes those products 0. So the lists work for nonmanifold
/// surfaces, and each vertex is independent.
///
/// Four slots form a group, padded to one length. A group is closed if all four rings are closed and equally
/// long; the last neighbour is then followed by the first. Otherwise it is open: a closed ring repeats its
/// first neighbour at the end, and all rings are padded with v to the same odd number of neighbours.
/// (Vertices of a leaf are sorted by their number of triangles, so padding is small.)
///
/// All positions are in one array, leaf after leaf: first the leaf's slots, then its ghosts, which are copies
/// of neighbours in other leaves, padded to whole groups. Leaf l has positions [position_starts[l],
/// position_starts[l + 1]), and its neighbour indices are relative to the first of them.
struct Rings {
  std::vector<std::uint32_t> position_starts;  ///< size: number of leaves + 1
  std::vector<std::uint32_t> ghosts;  ///< copied positions; first of leaf l: position_starts[l] - begin(l)
  std::vector<std::uint32_t> neighbour_starts;  ///< size: number of leaves + 1
  std::vector<std::uint16_t> neighbours;        ///< [group][neighbour][slot of the group]
  std::vector<std::uint16_t> lengths;  ///< number of neighbours per group, plus closed_ring for closed groups

  /// A vertex with so many neighbours that 16-bit indices could overflow in its leaf. Its group treats it as
  /// a vertex without triangles. Its own list is open and holds indices of positions.
  struct HighValence {
    std::uint32_t slot, position;
    std::vector<std::uint32_t> neighbours;
  };
  std::vector<HighValence> high_valence;

  std::size_t position_count() const { return position_starts.back(); }
  std::size_t bytes() const;
};

/// Linear time. Ignores triangles that repeat a corner.
Rings make_rings(const Leaves& leaves, std::span<const mesh::Triangle> triangles);

}  // namespace viete::deform
