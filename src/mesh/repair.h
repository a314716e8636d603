// Welding and consistent orientation. Checks use these on copies; the user's model stays unchanged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Replaces each corner by the lowest vertex at its position. Positions and numbering stay.
Surface welded(const Surface& surface);

/// Flips triangles so that neighbours agree across edges with two triangles. Each component keeps the
/// orientation that most of its triangles had; non-orientable components (a Moebius strip) stay unchanged.
/// Polygons become triangles.
Surface consistently_oriented(const Surface& surface);

/// Triangles with consistent orientation.
struct OneSided {
  std::vector<Triangle> triangles;  ///< empty if a component is not orientable (a Moebius strip)
  std::vector<std::uint32_t> of;    ///< index of each in the surface's triangles, ascending
  bool closed = false;              ///< every edge is used equally often in both directions
};

/// As consistently_oriented(), but keeps only the first of coincident opposite faces, and orients closed
/// components consistently with each other: all outward with cavities inward, or all reversed if they were. A
/// consistent surface keeps its triangles. Vertices at the same position count as one.
OneSided one_sided(const Surface& surface);

}  // namespace viete::mesh
