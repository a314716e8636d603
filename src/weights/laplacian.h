// Cotangent and intrinsic Laplacians of a triangle mesh as sparse matrices.
#pragma once

#include <span>
#include <vector>

#include "mesh/surface.h"
#include "pose/cage.h"
#include "sparse/sparse_matrix.h"

namespace viete::weights {

using mesh::Vec3;

/// A triangle is thin if 2 * area / (longest side)^2 is at most this number. Computations then use the area
/// for which the ratio equals this number.
inline constexpr double thin_triangle = 1e-6;

bool is_thin(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c);

/// Returns h_k = cotangent(angle at k) / 2 for each corner k. For a linear function f, the sum over all k of
///     h_k * (f_i - f_j)^2, where i and j are the other two corners,
/// is area * |grad f|^2. The sum is never negative. Lengths may be from 1e-300 to 1e300. A thin triangle is
/// computed with a larger area (see thin_triangle), so |h_k| is at most 0.5 / thin_triangle. If all corners
/// coincide, all h_k are 0. Otherwise the sum is positive for some f.
Vec3 half_cotangents(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c);

/// Returns the matrix K with f^T K f = sum over triangles of area * |grad f|^2, for every f that is linear on
/// each triangle (M. Meyer et al., Discrete Differential-Geometry Operators, 2003; U. Pinkall, K. Polthier,
/// 1993). K is symmetric (both halves are stored) and positive semi-definite. The rows of K sum to 0. For the
/// valid lengths and thin triangles, see half_cotangents(). Every vertex has a diagonal entry (0 without
/// triangles). Triangles that repeat a corner are ignored. Works for nonmanifold meshes. Thread-safe.
sparse::SparseMatrix stiffness_matrix(std::span<const mesh::Point> positions,
                                      std::span<const mesh::Triangle> triangles);

/// Polygons of models with more corners have no center, see mesh::split_unsettled(), because a solve joins
/// all corners of a polygon with a center.
inline constexpr std::size_t most_split_corners = 32;

struct IntrinsicLaplacian {
  /// Has the properties of stiffness_matrix(). In addition, no entry off the diagonal is positive.
  sparse::SparseMatrix stiffness;
  std::vector<double> masses;  ///< area around each vertex divided by the total area; 0 without triangles
};

/// Returns cotangent weights of the intrinsic Delaunay triangulation (A. Bobenko and B. Springborn, Discrete
/// Comput. Geom. 38, 2007). No weight is negative, so harmonic functions obey the maximum principle for any
/// triangle quality. Follows N. Sharp and K. Crane, A Laplacian for Nonmanifold Triangle Meshes (SGP 2020):
/// - Lengthens all edges by up to 1e-5 of the mean edge, so that every triangle has an area.
/// - Doubles a surface with a boundary, nonmanifold edges or inconsistent orientation (front and back).
/// - Flips edges within the surface until no weight is negative.
/// Unlike the paper, joins the sides around an edge of three or more triangles in file order, not by angle.
///
/// Returns the mean over triangulations from all corners of the polygons, so that first corners have no
/// effect and mirrored models have mirrored results. Exceptions are bent polygons with more than four corners
/// in large models, and flips of edges between bent polygons.
///
/// Omits weights below 1e-10 and ignores triangles that repeat a corner. Works at any length scale, in nearly
/// linear time. Parts connected by triangles are connected by weights. Thread-safe.
IntrinsicLaplacian intrinsic_laplacian(const mesh::Surface& surface);

}  // namespace viete::weights
