// Computes vertex normals from triangles, and deforms normals and tangents from a file.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Returns the triangles around each vertex, ascending. Call it once per surface. With the lists, several
/// threads can compute vertex normals, and the result does not depend on the threads.
Adjacency vertex_triangles(std::size_t vertices, std::span<const Triangle> triangles);

/// Sets normals[v] for begin <= v < end to the mean normal of the triangles around v, weighted by area, with
/// length 1. If these triangles have no area, sets (0, 0, 1). Lengths must be from 1e-70 to 1e70.
void vertex_normals(std::span<const Point> positions, std::span<const Triangle> triangles,
                    const Adjacency& around, std::size_t begin, std::size_t end, std::span<Point> normals);

/// Returns the normals after the vertices moved from `rest` to `positions`, with length 1. `corner_normal`
/// has an index into `normals`, or `none`, for each of rest.corners. Each triangle moves by an affine map,
/// and the cofactors of the map transform the normals. A normal becomes the mean over its corners, weighted
/// by the deformed area. If a normal is not finite, uses the normal of the triangle instead. If no triangle
/// of a normal moved, returns the normal unchanged.
/// If no triangle with area uses a normal, the normal rotates with the nearest triangle. If the model has no
/// triangle with area, it rotates with triangles between the nearest six points. `vertex_of_normal` has the
/// vertex of each normal; it is used only for normals that no corner uses.
std::vector<Vec3> deformed_normals(const Surface& rest, std::span<const Point> positions,
                                   std::span<const Vec3> normals,
                                   std::span<const std::uint32_t> corner_normal,
                                   std::span<const std::uint32_t> vertex_of_normal = {});

/// Returns 0, 1, 2, ... for all vertices. Use it as vertex_of_normal if a file has one normal per vertex.
std::vector<std::uint32_t> every_vertex(const Surface& surface);

/// Like deformed_normals(), for tangents. Tangents move with the surface.
std::vector<Vec3> deformed_tangents(const Surface& rest, std::span<const Point> positions,
                                    std::span<const Vec3> tangents,
                                    std::span<const std::uint32_t> corner_tangent,
                                    std::span<const std::uint32_t> vertex_of_tangent = {});

/// True if all components are finite.
inline bool is_direction(const Vec3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// True if a vector read from a file has a new, finite value.
inline bool changed(const Vec3& before, const Vec3& now) {
  return before != now && is_direction(now);
}

/// Scales changed vectors of unit length to their lengths in `before`. If a length in `before` differs from 1
/// by at most 0.01, the vector keeps unit length.
void keep_lengths(std::span<const Vec3> before, std::span<Vec3> now);

}  // namespace viete::mesh
