// Cotangent and intrinsic Laplacians of a triangle mesh as sparse matrices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "deform/sparse/sparse_matrix.h"
#include "mesh/surface.h"

namespace viete::deform {

/// A triangle with less than this for twice its area over the square of its longest side is thin: it counts
/// as if it had that area.
inline constexpr double thin_triangle = 1e-6;

bool is_thin(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c);

/// Half the cotangent of the angle at each corner: what the opposite edge weighs in the triangle's share of
/// the Dirichlet energy, 1/2 sum h_k |f_i - f_j|^2 = area / 2 |grad f|^2. Free of scale: lengths from 1e-300
/// to 1e300. At most 1 / (2 thin_triangle) in size, as a thin triangle has the energy above times its area
/// over the area that it counts with: never less than 0, and more than 0 for some f unless all three corners
/// coincide; then all three are 0.
Vec3 half_cotangents(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c);

/// K with f^T K f = sum over triangles of area |grad f|^2 for every function f that is linear on each (M.
/// Meyer et al., Discrete Differential-Geometry Operators, 2003; U. Pinkall, K. Polthier, 1993). n x n for n
/// positions, symmetric, both halves stored, rows sum to 0, positive semi-definite; free of scale, and thin
/// triangles bounded, by half_cotangents(). Every vertex has a diagonal entry, 0 if it is in no triangle;
/// triangles that repeat a corner add nothing. Any triangles, manifold or not. Thread-safe.
SparseMatrix stiffness_matrix(std::span<const mesh::Point> positions,
                              std::span<const mesh::Triangle> triangles);

struct IntrinsicLaplacian {
  /// As stiffness_matrix(), every vertex with a diagonal entry; but no entry off the diagonal is positive.
  SparseMatrix stiffness;
  std::vector<double>
      masses;  ///< the share of each vertex in the area: of sum 1, 0 for a vertex of no triangle
};

/// Cotangent weights of the intrinsic Delaunay triangulation (A. Bobenko and B. Springborn, Discrete Comput.
/// Geom. 38, 2007): edges are flipped within the surface, which keeps its shape, until no weight is negative,
/// so that solutions of L u = 0 obey the maximum principle however bad the triangles are. After N. Sharp and
/// K. Crane, A Laplacian for Nonmanifold Triangle Meshes (SGP 2020): triangles without area become thin ones,
/// all edges being lengthened by up to 1e-5 of the mean one; a surface with a boundary, or with edges of more
/// than two triangles or of opposite orientation, is taken as both its sides sewn together, so that there,
/// too, no weight is negative. (Around an edge of three or more triangles they are sewn in the order of the
/// file, not by angle.)
///
/// Weights below 1e-10 are left out; what hangs together by triangles hangs together by weights. Any length
/// scale. Triangles that repeat a corner do not count. Nearly linear. Thread-safe.
IntrinsicLaplacian intrinsic_laplacian(const mesh::Surface& surface);

}  // namespace viete::deform
