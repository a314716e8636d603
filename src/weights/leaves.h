// The model's vertices, grouped into leaves of neighbouring vertices, and the one-ring of each vertex.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::weights {

inline constexpr std::size_t leaf_slots = 512;
inline constexpr std::size_t slot_block = 32;  ///< the number of slots is a multiple of this number

/// The number of vertices of a tile. For each quantity, a tile has one cache line (64 bytes).
template <class T>
inline constexpr std::size_t tile_lanes = 64 / sizeof(T);
inline constexpr std::size_t lanes = tile_lanes<float>;

/// Access by slot to an array [tile][line][lane].
template <class T>
struct TileLines {
  T* data;
  std::size_t lines;

  T& at(std::size_t slot, std::size_t line) const {
    return data[(slot / lanes * lines + line) * lanes + slot % lanes];
  }
  mesh::Vec3 three(std::size_t slot, std::size_t first) const {
    return {at(slot, first), at(slot, first + 1), at(slot, first + 2)};
  }
  void set(std::size_t slot, std::size_t first, const mesh::Vec3& v) const {
    for (std::size_t i = 0; i < 3; ++i) at(slot, first + i) = static_cast<float>(v[i]);
  }
};

/// Slot s contains vertex order[s] of the file. Leaf l has the slots [512 * l, 512 * (l + 1)). Only the last
/// leaf may be smaller; its last vertex is repeated up to a multiple of 32 slots. In each leaf, vertices are
/// sorted by their number of triangles, so that neighbouring slots have rings of equal length.
struct Leaves {
  std::vector<std::uint32_t> order;  ///< slot_count() entries
  std::size_t vertices = 0;          ///< slots [vertices, slot_count()) are padding

  std::size_t slot_count() const { return order.size(); }
  std::size_t count() const { return (order.size() + leaf_slots - 1) / leaf_slots; }
  std::size_t begin(std::size_t leaf) const { return leaf * leaf_slots; }
  std::size_t end(std::size_t leaf) const { return std::min(order.size(), (leaf + 1) * leaf_slots); }
};

std::vector<std::uint32_t> slots_of(const Leaves& leaves);

/// Makes leaves with a kd tree that splits the longest side of the bounding box. positions must not be empty.
/// triangles_around has the number of triangles of each vertex. O(n log n).
Leaves make_leaves(std::span<const mesh::Point> positions, std::span<const std::uint32_t> triangles_around);

inline constexpr std::size_t ring_group = 4;  ///< number of slots whose rings are processed together
/// Position i starts at float 4 * i. Rings::neighbours stores 4 * i / index_floats for this position. The
/// load instruction multiplies by index_floats at no cost.
inline constexpr std::size_t index_floats = 2;
inline constexpr std::uint16_t closed_ring = 0x8000;  ///< added to the length of a closed group, see Rings

/// The neighbours of each vertex, in the order that vertex normals need. The normal of a vertex v with the
/// neighbours n_0, n_1, ... is the direction of the sum of (n_i - v) x (n_(i+1) - v). Each product is twice
/// the area vector of a triangle. If the triangles form several fans, v is inserted between the fans, so
/// products with v are 0. The surface may be nonmanifold.
///
/// Four slots form a group with one common length. If all four rings are closed and have equal lengths, the
/// group is closed: the last neighbour is followed by the first. Otherwise the group is open: closed rings
/// repeat their first neighbour, and v is appended to all rings up to a common odd length.
///
/// All positions are in one array, leaf after leaf: first the slots of the leaf, then its ghosts. Ghosts are
/// copies of neighbours in other leaves. The positions of leaf l begin at position_starts[l]. The neighbour
/// indices in leaf l are relative to this start.
struct Rings {
  std::vector<std::uint32_t> position_starts;  ///< size: number of leaves + 1
  /// For each ghost, the index of the original. The ghosts of leaf l begin at position_starts[l] - begin(l).
  std::vector<std::uint32_t> ghosts;
  std::vector<std::uint32_t> neighbour_starts;  ///< size: number of leaves + 1
  std::vector<std::uint16_t> neighbours;        ///< [group][neighbour][slot of the group]
  std::vector<std::uint16_t> lengths;  ///< neighbours per group; closed_ring is added if the group is closed

  /// A vertex with so many neighbours that 16-bit indices could overflow. In its group, the vertex has an
  /// empty ring. `neighbours` is an open ring of indices of positions.
  struct HighValence {
    std::uint32_t slot, position;
    std::vector<std::uint32_t> neighbours;
  };
  std::vector<HighValence> high_valence;

  std::size_t position_count() const { return position_starts.back(); }
};

/// Takes linear time. Ignores triangles that repeat a corner.
Rings make_rings(const Leaves& leaves, std::span<const mesh::Triangle> triangles);

}  // namespace viete::weights
