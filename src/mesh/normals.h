// Vertex normals from triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// The triangles around each vertex, ascending. Fixed once for a surface, so that normals can be gathered per
/// vertex, in parallel and in a fixed order.
Adjacency vertex_triangles(std::size_t vertices, std::span<const Triangle> triangles);

/// Unit normals of vertices [begin, end): the area-weighted mean of the triangles around. A vertex without
/// area around it gets (0, 0, 1). Any length scale from 1e-70 to 1e70. normals.size() == positions.size().
void vertex_normals(std::span<const Point> positions, std::span<const Triangle> triangles,
                    const Adjacency& around, std::size_t begin, std::size_t end, std::span<Point> normals);

}  // namespace viete::mesh
