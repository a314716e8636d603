// Data for drawing a model, computed once: coarse triangles, and the shading of creases.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Returns one value per vertex, from 0 (deep crease) to 1 (flat area or ridge). The value is the mean height
/// of the neighbours over the tangent plane, relative to their distance, smoothed at `levels` scales and
/// summed. `normals` has one unit vector per position. An unused vertex gets 1. `around` is the result of
/// vertex_triangles(); the next corner in each of these triangles is a neighbour. Linear time.
std::vector<float> bake_cavity(std::span<const Point> positions, std::span<const Point> normals,
                               std::span<const Triangle> triangles, Adjacency around, int levels = 4);

/// About `wanted` triangles between vertices of the surface: one vertex stands for all in a cell of a grid
/// (Rossignac and Borrel 1993), so that deformed vertices deform these triangles too. area: of the surface.
/// Empty without area. Linear time.
std::vector<Triangle> clustered_triangles(const Surface& surface, double area, std::size_t wanted);

}  // namespace viete::mesh
