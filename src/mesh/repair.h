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

}  // namespace viete::mesh
