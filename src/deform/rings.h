// The triangles around each vertex as one walk over its neighbours, leaf by leaf.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/leaves.h"
#include "mesh/surface.h"

namespace viete::deform {

inline constexpr std::size_t ring_group = 4;   ///< slots that walk together
inline constexpr std::size_t walk_floats = 2;  ///< that a walk counts by: of the four of a place, as processors address

/// A vertex's walk goes over its neighbours: each step from one to the next is a triangle with the vertex itself,
/// and the sum of their cross products is its normal, times twice the area. A closed ring ends where it began;
/// between fans that do not hang together the walk goes through the vertex itself, where the triangles have no
/// area. So every surface has such walks, and each vertex can be computed alone.
///
/// Walks are stored for four slots at once, as vector code makes them: the same number of steps for all four, where
/// shorter ones end with the vertex itself. (Within a leaf vertices are sorted by their number of triangles.)
///
/// A leaf sees its own slots, and copies of the slots of other leaves that its walks go over: its halo. Places
/// are numbers in an array of both, the leaves one after the other: leaf l owns places [places[l],
/// places[l + 1]), first its slots, then its halo, filled up to whole groups. Walks count from places[l],
/// in halves of places.
struct Rings {
  std::vector<std::uint32_t> places;         ///< one more than leaves
  std::vector<std::uint32_t> halo;           ///< of leaf l from places[l] - begin(l) on: the place that is copied
  std::vector<std::uint32_t> walk_starts;    ///< one more than leaves
  std::vector<std::uint16_t> walk;           ///< [group][step][slot of the group]
  std::vector<std::uint16_t> lengths;        ///< steps of each group; filling and hubs make none

  /// A vertex with so many triangles that it would crowd a leaf; its walk counts from 0.
  struct Hub {
    std::uint32_t slot, place;
    std::vector<std::uint32_t> walk;
  };
  std::vector<Hub> hubs;

  std::size_t place_count() const { return places.back(); }
  std::size_t bytes() const;
};

/// Linear. Triangles that repeat a corner are left out.
Rings make_rings(const Leaves& leaves, std::span<const mesh::Triangle> triangles);

}  // namespace viete::deform
