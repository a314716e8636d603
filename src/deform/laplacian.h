// Cotangent and intrinsic Laplacians of a triangle mesh as sparse matrices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "deform/sparse/sparse_matrix.h"
#include "mesh/surface.h"

namespace viete::deform {

/// A triangle is thin if twice its area over the square of its longest side is less than this; it is then
/// treated as if it had that area.
inline constexpr double thin_triangle = 1e-6;

bool is_thin(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c);

/// Half the cotangent of the angle at each corner: the weight of the opposite edge in the triangle's share of
/// the Dirichlet energy, 1/2 sum h_k |f_i - f_j|^2 = area / 2 |grad f|^2. Independent of scale: lengths from
/// 1e-300 to 1e300. At most 1 / (2 thin_triangle) in size: the energy of a thin triangle is scaled by its
/// true area over its assumed area. It is never negative, and positive for some f unless all three corners
/// coincide; then all three are 0.
Vec3 half_cotangents(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c);

/// K with f^T K f = sum over triangles of area |grad f|^2 for every f that is linear on each triangle (M.
/// Meyer et al., Discrete Differential-Geometry Operators, 2003; U. Pinkall, K. Polthier, 1993). n x n for n
/// positions, symmetric, both halves stored, rows sum to 0, positive semi-definite; scale and thin triangles
/// as in half_cotangents(). Every vertex has a diagonal entry, 0 if it is in no triangle; triangles that
/// repeat a corner add nothing. Works for nonmanifold meshes. Thread-safe.
SparseMatrix stiffness_matrix(std::span<const mesh::Point> positions,
                              std::span<const mesh::Triangle> triangles);

struct IntrinsicLaplacian {
  /// As stiffness_matrix(), with a diagonal entry for every vertex; no entry off the diagonal is positive.
  SparseMatrix stiffness;
  std::vector<double> masses;  ///< each vertex's share of the area: sum 1, 0 for a vertex of no triangle
};

/// Cotangent weights of the intrinsic Delaunay triangulation (A. Bobenko and B. Springborn, Discrete Comput.
/// Geom. 38, 2007): edges are flipped within the surface, which keeps its shape, until no weight is negative,
/// so solutions of L u = 0 obey the maximum principle for any triangle quality. Follows N. Sharp and K.
/// Crane, A Laplacian for Nonmanifold Triangle Meshes (SGP 2020): triangles without area become thin ones by
/// lengthening all edges by up to 1e-5 of the mean edge; a surface with a boundary, nonmanifold edges or
/// inconsistent orientation is doubled, with both sides sewn together, so that no weight is negative there
/// either. (Around an edge of three or more triangles, sides are sewn in file order, not by angle.)
///
/// Weights below 1e-10 are left out; parts connected by triangles stay connected by weights. Any length
/// scale. Triangles that repeat a corner do not count. Nearly linear time. Thread-safe.
IntrinsicLaplacian intrinsic_laplacian(const mesh::Surface& surface);

}  // namespace viete::deform
