// What holds parts of a model together that lie near each other and that no edge joins.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/intrinsic_laplacian.h"
#include "mesh/edge_paths.h"
#include "mesh/surface.h"

namespace viete::deform {

/// Two vertices; what the square of a difference between them adds to w^T L w.
struct Coupling {
  std::uint32_t a, b;
  double strength;
};

inline constexpr double most_strength = 1e4;

/// Of each vertex with the nearest one of every other part within 1.5 % of the model's diagonal, as far as
/// that is no farther than four times the nearest of them (six at most); and, within 0.1 %, of its own part
/// where no path of edges shorter than 1 % joins both: folds that touch. The gap counts as if it were filled:
/// a column between the two, of the vertices' share m of the area and as high as their distance d, has the
/// Dirichlet energy m / d^2 (1 the area of the surface) where a shell as thick as the gap has that of L;
/// twice that, and 1e4 at most. So cracks weld, layers move alike, and what is far apart hardly notices.
///
/// The surface welded, masses as in IntrinsicLaplacian. The same for any number of threads.
std::vector<Coupling> part_couplings(const mesh::Surface& surface, const mesh::EdgePaths& paths,
                                     std::span<const double> masses, base::WorkerPool& pool);

SparseMatrix with_couplings(const SparseMatrix& stiffness, std::span<const Coupling> couplings);

/// The bodies of a model, numbered from 0: its parts, those of less than the `small` share of the area being
/// one with what they touch (within 0.1 % of the diagonal), so that a soup of triangles is one body.
struct Bodies {
  std::vector<std::uint32_t> of_vertex;
  std::vector<double> shares;  ///< in the area
};
Bodies bodies(const mesh::Surface& surface, const mesh::EdgePaths& paths, std::span<const Coupling> couplings,
              std::span<const double> masses, double small);

}  // namespace viete::deform
