// Welds surfaces. Orients surfaces consistently.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Replaces each corner by the vertex of lowest index at the same position. Keeps all vertices and indices.
Surface welded(const Surface& surface);

/// Marks each polygon that has the corners of an earlier polygon in the same (or in the reversed) direction,
/// from any first corner. Vertices at equal positions count as one.
std::vector<std::uint8_t> repeated_polygons(const Surface& surface, bool reversed = false);

/// Returns the triangles, flipped so that neighbours have equal orientation. A component gets the orientation
/// that most of its triangles have. A component that is not orientable (a Moebius strip) does not change.
Surface consistently_oriented(const Surface& surface);

/// The result of one_sided(): triangles with consistent orientation.
struct OneSided {
  std::vector<Triangle> triangles;  ///< empty if consistent orientation is impossible (a Moebius strip)
  std::vector<std::uint32_t> of;    ///< the index of each triangle in the original surface, ascending
  bool closed = false;              ///< true if each edge is used equally often in both directions
};

/// Works like consistently_oriented(), but treats vertices at equal positions as one vertex. Also orients
/// closed components: outward, or inward for cavities. If all closed components would be reversed,
/// reverses none. If two faces coincide with opposite orientations, keeps only the first face.
OneSided one_sided(const Surface& surface);

}  // namespace viete::mesh
