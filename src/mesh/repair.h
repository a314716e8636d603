// Welding and consistent orientation: of copies, for checks that need it; what the user opened stays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Of each vertex the lowest one at exactly the same position. Linear.
std::vector<std::uint32_t> lowest_in_place(std::span<const Point> positions);

/// The same triangles, but each corner the lowest vertex at its position. Positions and their numbers stay.
Surface welded(const Surface& surface);

/// Triangles turned so that neighbours agree across edges of two triangles. In each part that they connect,
/// the side that most of them had stays; a part that cannot agree (a Moebius strip) is left as it is.
/// Polygons become triangles.
Surface consistently_oriented(const Surface& surface);

/// Triangles of which each shows the same side outwards.
struct OneSided {
  std::vector<Triangle> triangles;  ///< none: parts of the surface cannot agree (a Moebius strip)
  std::vector<std::uint32_t> of;    ///< which of the surface's each is, ascending
  bool closed = false;              ///< every edge is run through as often in one direction as in the other
};

/// As consistently_oriented, but of faces that are each other's backs the first alone, and closed parts
/// turned so that these agree too: all outward, cavities in them inward, or all the other way around if they
/// are so. A surface that agrees keeps its triangles as they are. Vertices at the same position count as one.
OneSided one_sided(const Surface& surface);

}  // namespace viete::mesh
