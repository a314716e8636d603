// Extraction of the surface at a given clearance, as triangles and as quads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cages/clearance.h"
#include "mesh/surface.h"

namespace viete::cages {

/// An indexed triangle mesh for further processing.
struct Shell {
  std::vector<Point> positions;
  std::vector<mesh::Triangle> triangles;
};

/// The isosurface at `level`, counter-clockwise as seen from larger clearance. An oriented manifold: closed,
/// or, on a mirrored grid, ending in the plane x = 0 with no vertex beyond. Marching cubes (Lorensen and
/// Cline 1987) with loops traced on the faces of each cell: ambiguous faces join the nodes below the level,
/// so that neighbouring cells agree. About two triangles per cell on the surface.
Shell extract(const Clearance& clearance, double level);

using TrianglePair = std::array<std::uint32_t, 2>;

/// Pairs of neighbours that form a good quad, best first: nearly flat, convex, angles near 90 degrees. Each
/// triangle is in at most one pair.
std::vector<TrianglePair> quad_pairs(const Shell& shell);

/// The shell with its pairs as quads, triangulated along the shared edge: the triangles are those of the
/// shell, in another order.
mesh::Surface with_quads(const Shell& shell, std::span<const TrianglePair> pairs);

}  // namespace viete::cages
