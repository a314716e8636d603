// Data for drawing a model, computed once: coarse triangles, and the shading of creases.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Returns one value per vertex, from 0 (deep crease) to 1 (flat area or ridge). A vertex is in a crease if
/// its neighbours are above its tangent plane. With more `levels`, wider creases are found. `normals` has one
/// unit vector per position. `around` is from vertex_triangles(). An unused vertex gets 1. Linear time.
std::vector<float> bake_cavity(std::span<const Point> positions, std::span<const Point> normals,
                               std::span<const Triangle> triangles, Adjacency around, int levels = 4);

/// Returns about `wanted` coarse triangles. In each cell of a grid, one vertex replaces all vertices
/// (Rossignac and Borrel 1993). The corners are vertices of the surface, so deformed positions also apply to
/// the coarse triangles. Near triangles follow each other. `area` is the area of the surface. If it is 0,
/// returns no triangles. Linear time, and sorts the result.
std::vector<Triangle> clustered_triangles(const Surface& surface, double area, std::size_t wanted);

}  // namespace viete::mesh
