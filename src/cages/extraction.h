// The surface at a given clearance, as triangles and as quads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cages/clearance.h"
#include "mesh/surface.h"

namespace viete::cages {

/// Triangles that work goes on with: they refer to positions by number.
struct Shell {
  std::vector<Point> positions;
  std::vector<mesh::Triangle> triangles;
};

/// The triangles between nodes above the level and others, counter-clockwise from where the clearance is
/// larger. An oriented manifold: closed, or, on a mirrored grid, ending in the plane x = 0, with no vertex
/// beyond. Marching cubes (Lorensen and Cline 1987) whose loops are traced along the faces of each cell: what
/// is below the level is joined across a face where both ways are possible, so that neighbours agree. About
/// two triangles for each cell that the surface runs through.
Shell extract(const Clearance& clearance, double level);

using TrianglePair = std::array<std::uint32_t, 2>;

/// Neighbours that make a good quad together, the best first: nearly flat, convex, and with angles near 90
/// degrees. Each triangle is in one pair at most.
std::vector<TrianglePair> quad_pairs(const Shell& shell);

/// The shell with its pairs as quads, which are cut along the edge that the pair shares: the triangles for
/// work are those of the shell, in another order.
mesh::Surface with_quads(const Shell& shell, std::span<const TrianglePair> pairs);

}  // namespace viete::cages
