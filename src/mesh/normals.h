// Vertex normals from triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// For each vertex the triangles around it: those of vertex v are triangles[starts[v]] up to starts[v + 1].
/// Fixed once for a surface, so that normals can be gathered per vertex, in parallel and in a fixed order.
struct VertexTriangles {
  std::vector<std::uint32_t> starts, triangles;
};

VertexTriangles vertex_triangles(std::size_t vertices, std::span<const Triangle> triangles);

/// Unit normals of vertices [begin, end): the area-weighted mean of the triangles around. A vertex without
/// area around it gets (0, 0, 1). Any length scale from 1e-70 to 1e70. normals.size() == positions.size().
void vertex_normals(std::span<const Point> positions, std::span<const Triangle> triangles,
                    const VertexTriangles& around, std::size_t begin, std::size_t end,
                    std::span<Point> normals);

}  // namespace viete::mesh
