// The triangles around each vertex as one walk over its neighbours, leaf by leaf.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/leaves.h"
#include "mesh/surface.h"

namespace viete::deform {

inline constexpr std::size_t ring_group = 4;  ///< slots that walk together
inline constexpr std::size_t walk_floats =
    2;  ///< that a walk counts by: of the four of a place, as processors address
inline constexpr std::uint16_t closed_ring =
    0x8000;  ///< added to the length of a group whose walks are rings

/// A vertex's walk goes over its neighbours: each step from one to the next is a triangle with the vertex
/// itself, and the sum of their cross products is its normal, times twice the area. Between fans that do not
/// hang together the walk goes through the vertex itself, where the triangles have no area. So every surface
/// has such walks, and each vertex can be computed alone.
///
/// Walks are stored for four slots at once, as vector code makes them: four closed rings of the same length
/// as they are, the first neighbour following the last; other walks open, a ring ending where it began, with
/// the same odd number of neighbours for all four, where shorter ones end with the vertex itself. (Within a
/// leaf vertices are sorted by their number of triangles.)
///
/// A leaf sees its own slots, and copies of the slots of other leaves that its walks go over: its halo.
/// Places are numbers in an array of both, the leaves one after the other: leaf l owns places [places[l],
/// places[l + 1]), first its slots, then its halo, filled up to whole groups. Walks count from places[l],
/// in halves of places.
struct Rings {
  std::vector<std::uint32_t> places;  ///< one more than leaves
  std::vector<std::uint32_t> halo;    ///< of leaf l from places[l] - begin(l) on: the place that is copied
  std::vector<std::uint32_t> walk_starts;  ///< one more than leaves
  std::vector<std::uint16_t> walk;         ///< [group][neighbour][slot of the group]
  std::vector<std::uint16_t>
      lengths;  ///< neighbours in each group, plus closed_ring; filling and hubs only themselves

  /// A vertex with so many triangles that it would crowd a leaf; its walk is open and counts from 0.
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
