// Welding and consistent orientation of surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Replaces each corner by the lowest vertex at the same position. Positions and numbering do not change.
Surface welded(const Surface& surface);

/// Returns the triangles, flipped so that neighbours have the same orientation. Each component gets the
/// orientation of most of its triangles. Components that are not orientable (Moebius strips) do not change.
Surface consistently_oriented(const Surface& surface);

/// Triangles with consistent orientation.
struct OneSided {
  std::vector<Triangle> triangles;  ///< empty if a component is not orientable (a Moebius strip)
  std::vector<std::uint32_t> of;    ///< the index of each triangle in the surface, ascending
  bool closed = false;              ///< true if every edge is used equally often in both directions
};

/// Like consistently_oriented(), but orients closed components outward and cavities inward, unless all of
/// them are reversed. If two faces coincide with opposite orientations, keeps only the first face. Merges
/// vertices at the same position.
OneSided one_sided(const Surface& surface);

}  // namespace viete::mesh
