// In which order the unknowns of a sparse symmetric system are eliminated, so that little fills in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/worker_pool.h"
#include "deform/sparse/sparse_matrix.h"
#include "mesh/adjacency.h"

namespace viete::deform {

/// Called often, from any thread of the pool, with how much is done, in [0, 1]; what it throws ends the work.
using FactorReport = std::function<void(double)>;

/// The unknowns that each one shares an entry of the lower triangle with, itself excluded.
mesh::Adjacency neighbours_of_unknowns(const SparseMatrix& matrix);

/// A permutation of the unknowns, the first to be eliminated first. Up to `whole` of them, approximate
/// minimum degree (P. R. Amestoy, T. A. Davis, I. S. Duff, 1996; Eigen's), which nothing can interrupt:
/// 0.04 seconds for 100,000. More are first cut in two, again and again, by separators that come last
/// (nested dissection: A. George, SIAM J. Numer. Anal. 10, 1973), down to pieces of `piece`: on surfaces of
/// half a million vertices a quarter fewer entries of the factor and a third of the operations. A separator
/// begins as the vertices as far from one end of the piece as from the other, by edges, and is then improved
/// move by move (C. Ashcraft and J. W. H. Liu, SIAM J. Matrix Anal. Appl. 19, 1998, after Fiduccia and
/// Mattheyses). The same for any number of threads.
std::vector<std::uint32_t> elimination_order(const mesh::Adjacency& neighbours, base::WorkerPool& pool,
                                             const FactorReport& report = {}, std::size_t whole = 100'000,
                                             std::size_t piece = 500);

}  // namespace viete::deform
