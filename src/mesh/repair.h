// Welds surfaces, and orients them consistently.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Replaces each corner by the lowest vertex at the same position. Does not change positions and numbering.
Surface welded(const Surface& surface);

/// Returns the triangles, flipped so that neighbours have equal orientation. A component gets the orientation
/// that most of its triangles have. A component that is not orientable (a Moebius strip) does not change.
Surface consistently_oriented(const Surface& surface);

/// The result of one_sided(): triangles with consistent orientation.
struct OneSided {
  std::vector<Triangle> triangles;  ///< empty if a component is not orientable (a Moebius strip)
  std::vector<std::uint32_t> of;    ///< the index of each triangle in the original surface, ascending
  bool closed = false;              ///< true if all edges are used equally often in both directions
};

/// Like consistently_oriented(), but also orients closed components: outward, or inward if they are cavities.
/// If all of them are reversed, keeps their orientation. If two faces coincide with opposite orientations,
/// keeps only the first face. Merges vertices at equal positions.
OneSided one_sided(const Surface& surface);

}  // namespace viete::mesh
