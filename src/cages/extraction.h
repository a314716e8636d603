// Extracts the surface of a given clearance, as triangles or quads.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cages/clearance.h"
#include "mesh/triangle.h"

namespace viete::cages {

/// A triangle mesh that becomes a cage.
struct Shell {
  std::vector<Point> positions;
  std::vector<mesh::Triangle> triangles;
};

/// Extracts the isosurface at `level` by marching cubes (Lorensen and Cline 1987). If a cell face can be cut
/// in two ways, the cut connects the nodes below the level. The result is an oriented manifold,
/// counter-clockwise as seen from the side of larger clearance. In a grid that is not mirrored, the result is
/// closed. In a mirrored grid, the result is one half, with its boundary in the plane x = 0.
Shell extract(const Clearance& clearance, double level);

using TrianglePair = std::array<std::uint32_t, 2>;

/// Returns pairs of neighbouring triangles that form good quads: nearly flat, convex, and with angles near 90
/// degrees. Begins with the best pair. A triangle is in at most one pair. If `fits` is not empty, it must be
/// true for the triangles of each quad, see mesh::CenterSplit.
using TriangleTest = std::function<bool(const mesh::Corners&)>;
std::vector<TrianglePair> quad_pairs(const Shell& shell, const TriangleTest& fits = {});

/// Joins the pairs to quads. The result has the same triangles as the shell, but in another order.
mesh::Surface with_quads(const Shell& shell, std::span<const TrianglePair> pairs);

}  // namespace viete::cages
