// Triangles in pairs, for people who edit quads more easily.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cages/extraction.h"
#include "mesh/surface.h"

namespace viete::cages {

using TrianglePair = std::array<std::uint32_t, 2>;

/// Neighbours that make a good quad together, the best first: nearly flat, convex, and with angles near 90
/// degrees. Each triangle is in one pair at most.
std::vector<TrianglePair> quad_pairs(const Shell& shell);

/// The shell with its pairs as quads, which are cut along the edge that the pair shares: the triangles for
/// work are those of the shell, in another order.
mesh::Surface with_quads(const Shell& shell, std::span<const TrianglePair> pairs);

}  // namespace viete::cages
