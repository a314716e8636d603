// Data for drawing a model, computed once: a coarse model, and the shading of creases.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Returns one value per vertex, from 0 (deep crease) to 1 (flat area or ridge). A vertex is in a crease if
/// its neighbours are above its tangent plane. Finds creases of four widths. `normals` has one
/// unit vector per position; `inside_out` reverses them. `around` is from vertex_triangles(). An unused
/// vertex gets 1. Linear time.
std::vector<float> bake_cavity(std::span<const Point> positions, std::span<const Point> normals,
                               std::span<const Triangle> triangles, Adjacency around,
                               bool inside_out = false);

/// A coarse model: some vertices of a surface, and triangles between them.
struct Draft {
  Surface surface;
  std::vector<std::uint32_t> vertices;  ///< for each vertex, its index in the model
  std::vector<std::uint32_t> sources;   ///< for each triangle, the model's triangle that it replaces
};

/// Returns a draft with about `wanted` triangles. In each cell of a grid, one vertex replaces all vertices
/// (Rossignac and Borrel 1993), or one on each side of a thin part. Near triangles follow each other. `area`
/// is the area of the surface. If it is 0, returns an empty draft. `normals` are the vertex normals, and
/// `box` is the box of used vertices. Linear time, and sorts the result.
Draft draft_of(const Surface& surface, std::span<const Point> normals, const Bounds& box, double area,
               std::size_t wanted);

/// Returns the distance between neighbours if the points are spread over a surface: the square root of its
/// area per point. Estimated from at most 8,192 points; 0 for fewer than two. Points must be finite.
double point_spacing(std::span<const Point> points);

}  // namespace viete::mesh
