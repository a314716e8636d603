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

/// Returns the triangles around each vertex, in ascending order. Call this once per surface. With these
/// lists, several threads can compute vertex normals, always with the same result.
Adjacency vertex_triangles(std::size_t vertices, std::span<const Triangle> triangles);

/// Sets normals[v] for begin <= v < end to the mean normal of the triangles around v, weighted by area, with
/// length 1. If these triangles have no area, sets (0, 0, 1). Lengths must be from 1e-70 to 1e70.
void vertex_normals(std::span<const Point> positions, std::span<const Triangle> triangles,
                    const Adjacency& around, std::size_t begin, std::size_t end, std::span<Point> normals);

/// Returns unit normals after the vertices moved from rest.positions to `positions`.
///   corner_normal: for each entry of rest.corners, an index into `normals`, or `none`.
///   vertex_of_normal: the vertex of each normal; needed only for normals that no corner has.
/// The affine map of each triangle transforms the normals at its corners. If corners of several triangles
/// have the same normal, the results are averaged by deformed area. The triangle's normal replaces a normal
/// that is not finite. If no triangle at a normal moved, the normal does not change. If no triangle at a
/// normal has area, the normal rotates with the nearest triangle that has area. If the model has no triangle
/// with area, the normal rotates with triangles between its vertex and the six nearest points.
/// Normals of single vertices at one place, for example on both sides of a texture seam, stay equal if they
/// are equal.
std::vector<Vec3> deformed_normals(const Surface& rest, std::span<const Point> positions,
                                   std::span<const Vec3> normals,
                                   std::span<const std::uint32_t> corner_normal,
                                   std::span<const std::uint32_t> vertex_of_normal = {});

/// Works like deformed_normals(), but for tangents, which move with the surface.
std::vector<Vec3> deformed_tangents(const Surface& rest, std::span<const Point> positions,
                                    std::span<const Vec3> tangents,
                                    std::span<const std::uint32_t> corner_tangent,
                                    std::span<const std::uint32_t> vertex_of_tangent = {});

enum class OffsetKind { positions, directions };

/// Works like deformed_normals(), but for offsets of positions, or of normals and tangents: the offsets of a
/// morph target. Offsets of positions stretch with the surface; offsets of directions only rotate and shear.
std::vector<Vec3> deformed_offsets(const Surface& rest, std::span<const Point> positions,
                                   std::span<const Vec3> offsets, OffsetKind kind,
                                   std::span<const std::uint32_t> corner_offset,
                                   std::span<const std::uint32_t> vertex_of_offset = {});

/// True if all components are finite.
inline bool is_direction(const Vec3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// True if the new value differs and is finite.
inline bool changed(const Vec3& before, const Vec3& now) {
  return before != now && is_direction(now);
}

/// Scales each changed vector of `now` to its length in `before`. Lengths from 0.99 to 1.01 count as 1. `now`
/// must have unit vectors.
void keep_lengths(std::span<const Vec3> before, std::span<Vec3> now);

}  // namespace viete::mesh
