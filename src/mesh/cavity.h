// Shading of creases, computed once per model: keeps details visible in soft light.
#pragma once

#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// One value per vertex, 0 (deep crease) to 1 (flat, or a ridge): mean height of the neighbours over the
/// tangent plane, relative to their distance, gathered over `levels` growing neighbourhoods by smoothing.
/// Linear time, on all processors. normals: unit, one per position. around: see vertex_triangles(); a vertex
/// counts the next corner of each triangle as a neighbour. Unused vertices get 1.
std::vector<float> bake_cavity(std::span<const Point> positions, std::span<const Point> normals,
                               std::span<const Triangle> triangles, Adjacency around, int levels = 4);

}  // namespace viete::mesh
