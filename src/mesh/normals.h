// Vertex normals from triangles, and what a deformation does to those of a file.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

/// What becomes of a file's normals when the vertices of `rest` move to `positions`: each triangle moves by
/// an affine map, normals by its cofactors, and a normal is the mean over its corners, weighed by deformed
/// area. corner_normal: of each of rest.corners an index into normals, or `none`. Split
/// normals stay split. What is no direction becomes the surface's. Unit vectors, but for normals around which
/// nothing moved: those keep their bits.
///
/// Normals that no triangle with area holds, of points, lines and corners of faces without area, turn as the
/// nearest triangle does, and where there is none as triangles of the six nearest points do.
/// vertex_of_normal: of each normal its vertex, of use where it is of no corner.
std::vector<Vec3> deformed_normals(const Surface& rest, std::span<const Point> positions,
                                   std::span<const Vec3> normals,
                                   std::span<const std::uint32_t> corner_normal,
                                   std::span<const std::uint32_t> vertex_of_normal = {});

/// The numbers of its vertices: whose the vectors are where each vertex has one.
std::vector<std::uint32_t> every_vertex(const Surface& surface);

/// The same for tangents, which move with the surface.
std::vector<Vec3> deformed_tangents(const Surface& rest, std::span<const Point> positions,
                                    std::span<const Vec3> tangents,
                                    std::span<const std::uint32_t> corner_tangent,
                                    std::span<const std::uint32_t> vertex_of_tangent = {});

/// False where one is no direction: not three finite numbers.
inline bool is_direction(const Vec3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// True if a vector of a file has another value now. One that was no direction may have become one.
inline bool changed(const Vec3& before, const Vec3& now) {
  return before != now && is_direction(now);
}

/// Vectors that changed are made as long as they were: deformed_normals() and deformed_tangents() give unit
/// vectors. Unit vectors stay so, though a file's digits made them a little shorter.
void keep_lengths(std::span<const Vec3> before, std::span<Vec3> now);

}  // namespace viete::mesh
