// Cotangent and intrinsic Laplacians of a triangle mesh, and thin plates on springs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"
#include "pose/cage.h"
#include "sparse/sparse_cholesky.h"
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

/// The parts of a surface that have springs.
struct HeldParts {
  static constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> of_vertex;  ///< the part of each vertex, or none
  std::vector<std::uint32_t>
      grounds;  ///< the fixed vertex of each part: of the vertices with a spring, the lowest index

  bool holds(std::uint32_t vertex) const { return of_vertex[vertex] != none; }
};

/// Finds the parts with springs. Nonzero entries of the stiffness connect the vertices of a part.
HeldParts held_parts(const sparse::SparseMatrix& stiffness, const std::vector<bool>& has_spring);

/// A surface as a thin plate on springs, which pull their vertices to given values.
///
/// For each of many loads t (a value at each vertex with a spring), computes the w that minimises
///
///     w^T * L * M^-1 * L * w + sum over springs v of s_v * (w_v - t_v)^2.
///
/// Factoring this problem's matrix would take ten times as long as factoring L. Therefore, first computes
/// the springs' forces f_v = s_v * (t_v - w_v). Then L * y = f and L * w = M * y give w. Each part has one
/// fixed vertex, the ground, where the solution w' of these equations is 0. So w = w' + b, with one b per
/// part: at the ground, b = t - f / s. The forces phi of springs that are not at a ground solve
///
///     (K + S^-1 + D) * phi = t - t_ground.
///
/// K_uv: w'_u for a force 1 at v and a force -1 at the ground. S: the diagonal matrix of the strengths s.
/// D_uv: 1 / s_ground if u and v are in the same part, otherwise 0. The matrix is symmetric and positive
/// definite. At the ground, the force is minus the sum of phi over the part.
///
/// K is dense: if many vertices have springs, factors the matrix L * M^-1 * L + S instead, unless masses near
/// 0 make it imprecise. Thread-safe.
class ThinPlate {
public:
  struct Target {
    std::uint32_t vertex;  ///< must have a spring
    double value;          ///< t of this vertex
  };
  /// A vertex must not occur twice. At all other vertices, t is 0.
  using Load = std::vector<Target>;
  /// Throws base::Cancelled. Throws base::Error if memory is insufficient or
  /// no solution exists in double precision. Needs memory for springs^2 + springs * loads numbers.
  ThinPlate(const IntrinsicLaplacian& laplacian, const HeldParts& parts, const std::vector<bool>& has_spring,
            std::vector<double> springs, std::vector<Load> loads, base::WorkerPool& pool,
            base::Progress* progress = nullptr);

  const sparse::BlockSolver& solver() const { return solver_; }
  bool factors_whole() const { return whole_; }  ///< true if solver() has L * M^-1 * L + S instead of L
  /// Writes the w of the loads [begin, end) to `block`. Vertices of parts without springs get 0. `block`
  /// must contain 0 before the call, and end - begin must be at most solved_columns.
  void solve(std::size_t begin, std::size_t end, std::span<double> block) const;

private:
  template <class Change>
  void for_rows(std::span<double> block, const Change& change) const;
  void bend(std::span<double> block, const sparse::BlockSolver::Part& given,
            const sparse::BlockSolver::Part* wanted = nullptr) const;
  std::vector<double> stiffness_of_springs(base::WorkerPool& pool, base::Progress* progress) const;
  void find_forces(std::vector<double> stiffness);

  const std::vector<double> masses_;
  HeldParts parts_;
  std::vector<double> part_masses_;
  std::vector<double> strengths_;  // s of each vertex
  std::vector<Load> loads_;
  bool whole_ = false;
  sparse::BlockSolver solver_;
  std::vector<std::uint32_t> springs_;  // vertices with springs, without the grounds
  sparse::BlockSolver::Part with_springs_;
  std::vector<double> forces_;  // [load][spring]: phi
};

}  // namespace viete::weights
