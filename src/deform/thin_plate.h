// A surface as a thin plate on springs, and the shapes that the springs pull it to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/laplacian.h"
#include "deform/sparse/sparse_cholesky.h"

namespace viete::deform {

/// The parts of a surface that have springs.
struct HeldParts {
  static constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> of_vertex;  ///< or none
  std::vector<std::uint32_t> grounds;    ///< for each part, its lowest vertex that has a spring

  bool holds(std::uint32_t vertex) const { return of_vertex[vertex] != none; }
};

/// Parts connected by entries of the stiffness.
HeldParts held_parts(const SparseMatrix& stiffness, const std::vector<bool>& has_spring);

/// For each of many loads t (values at the vertices with springs), the w that minimises
///
///     w^T L M^-1 L w + sum over springs v of s_v (w_v - t_v)^2
///
/// The matrix L M^-1 L + E S E^T is not factored: its factor would have four times the entries of that of L
/// and take ten times as long. Instead it solves for the springs' forces f = S (t - w), one per spring, and
/// then L y = E f, L w = M y with a factor of L in which one vertex of each part, its ground, is fixed at 0.
/// The forces of a part sum to 0, so they are sums of pairs phi: a force at a spring and its opposite at the
/// ground. With w = w' + b, w' being 0 at the ground, subtracting the equations f = S (t - w) of spring and
/// ground gives
///
///     (K + S^-1 + D) phi = t - t_ground,   K_uv = w'_u of the pair v,   D = 1 / s_ground within a part
///
/// which is symmetric and positive definite; b = t - f / s at the ground. Constant; thread-safe.
class ThinPlate {
public:
  struct Target {
    std::uint32_t vertex;  ///< must have a spring
    double value;          ///< t there
  };
  /// Each vertex at most once; t is 0 at all others.
  using Load = std::vector<Target>;
  /// Reports progress up to `done`. Throws base::Cancelled; base::Error if memory is short or there is no
  /// solution in double precision. Also needs memory for springs x springs and springs x loads numbers.
  ThinPlate(const IntrinsicLaplacian& laplacian, const HeldParts& parts, const std::vector<bool>& has_spring,
            std::vector<double> springs, std::vector<Load> loads, base::WorkerPool& pool,
            base::Progress* progress = nullptr, double done = 1);

  const BlockSolver& solver() const { return solver_; }
  /// Writes the shapes of loads [begin, end), at most solved_columns, into a zeroed block of the solver.
  /// Vertices of other parts get 0.
  void solve(std::size_t begin, std::size_t end, std::span<double> block) const;

private:
  template <class Change>
  void for_rows(std::span<double> block, const Change& change) const;
  void bend(std::span<double> block, const std::vector<Supernode>* part = nullptr) const;
  std::vector<double> stiffness_of_springs(base::WorkerPool& pool, base::Progress* progress, double from,
                                           double to) const;
  void find_forces(std::vector<double> stiffness);

  const std::vector<double> masses_;
  HeldParts parts_;
  std::vector<double> part_masses_;
  std::vector<double> strengths_;  // s of each vertex
  std::vector<Load> loads_;
  BlockSolver solver_;
  std::vector<std::uint32_t> springs_;  // vertices with springs, without the grounds
  std::vector<double> forces_;          // [load][spring]: phi
};

}  // namespace viete::deform
