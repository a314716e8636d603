// The Laplacian of a surface whose weights are never negative, however bad its triangles are.
#pragma once

#include <vector>

#include "deform/laplacian.h"
#include "mesh/surface.h"

namespace viete::deform {

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
