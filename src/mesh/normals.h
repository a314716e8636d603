// Vertex normals from triangles, and deformation of normals and tangents read from a file.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// The triangles around each vertex, ascending. Computed once per surface; lets normals be gathered per
/// vertex, in parallel and in a fixed order.
Adjacency vertex_triangles(std::size_t vertices, std::span<const Triangle> triangles);

/// Unit normals of vertices [begin, end): the area-weighted mean of the triangles around. Vertices without
/// area around them get (0, 0, 1). Any length scale from 1e-70 to 1e70. normals.size() == positions.size().
void vertex_normals(std::span<const Point> positions, std::span<const Triangle> triangles,
                    const Adjacency& around, std::size_t begin, std::size_t end, std::span<Point> normals);

/// Normals of a file after its vertices moved from `rest` to `positions`: each triangle moves by an affine
/// map, which acts on normals by its cofactors; a normal is the mean over its corners, weighted by deformed
/// area. corner_normal: for each of rest.corners an index into normals, or `none`. Split normals stay split.
/// Undefined directions get the surface's normal. Results are unit vectors; normals around which nothing
/// moved keep their bits.
///
/// A normal that only points, lines or degenerate faces use rotates with the nearest triangle; in a model
/// without triangles, with triangles of the six nearest points. vertex_of_normal: the vertex of each normal;
/// used only for normals without a corner.
std::vector<Vec3> deformed_normals(const Surface& rest, std::span<const Point> positions,
                                   std::span<const Vec3> normals,
                                   std::span<const std::uint32_t> corner_normal,
                                   std::span<const std::uint32_t> vertex_of_normal = {});

/// The numbers 0, 1, 2, ... of all vertices: vertex_of_normal for a file with one normal per vertex.
std::vector<std::uint32_t> every_vertex(const Surface& surface);

/// As deformed_normals(), for tangents, which move with the surface.
std::vector<Vec3> deformed_tangents(const Surface& rest, std::span<const Point> positions,
                                    std::span<const Vec3> tangents,
                                    std::span<const std::uint32_t> corner_tangent,
                                    std::span<const std::uint32_t> vertex_of_tangent = {});

/// False if a component is not finite.
inline bool is_direction(const Vec3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// True if a vector read from a file has a new, finite value.
inline bool changed(const Vec3& before, const Vec3& now) {
  return before != now && is_direction(now);
}

/// Scales changed vectors to their former lengths: deformed_normals() and deformed_tangents() give unit
/// vectors. Vectors of unit length up to rounding of the file's digits become exactly unit.
void keep_lengths(std::span<const Vec3> before, std::span<Vec3> now);

}  // namespace viete::mesh
