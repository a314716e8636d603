// The sparse solver of `deform` beside Eigen's, of one matrix.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/table.h"
#include "deform/sparse/sparse_matrix.h"

namespace viete::bench {

/// Prints what ordering, factors, and solutions of three and of sixteen columns take, by `deform` and by
/// Eigen's SimplicialLDLT with its order (AMD), on one thread. Where entries will be is found with the order
/// by Eigen, with the factors by `deform`. The lower triangle of the matrix counts, which is positive
/// definite.
std::vector<BenchResult> compare_solvers(const deform::SparseMatrix& matrix, std::size_t rounds);

}  // namespace viete::bench
