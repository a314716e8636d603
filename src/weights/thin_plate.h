// A surface as a thin plate on springs. The springs pull their vertices to given values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "sparse/sparse_cholesky.h"
#include "weights/laplacian.h"

namespace viete::weights {

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
