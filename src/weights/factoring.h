// Compression: expresses the weights of a leaf as linear combinations of a few rows of the leaf.
#pragma once

#include <cstddef>
#include <vector>

#include "base/memory.h"
#include "weights/bind_kernel.h"

namespace viete::weights {

/// Rows that span all rows of a leaf, in the order in which Gram and Schmidt make them orthonormal.
struct Basis {
  std::vector<std::size_t> pivots;  ///< slots of the rows
  std::vector<base::AlignedVector<float>>
      coefficients;  ///< per pivot: each row's part along the orthonormal row
};

/// The next pivot is always the row with the largest residual. Stops when the residuals of the first
/// `vertices` slots have norms of at most `tolerance`. Returns nothing if this needs more than `most` pivots.
/// Overwrites `rows`.
Basis find_basis(const LeafRows& rows, std::size_t vertices, double tolerance, std::size_t most,
                 const BindKernel& kernel);

struct Factors {
  std::vector<std::size_t> pivots;     ///< slots of the pivot rows; empty if too many are needed
  base::AlignedVector<float> factors;  ///< [tile][pivot][lane]: row = sum of (factor * row of the pivot)
};

/// Computes a row interpolative decomposition with the pivots of find_basis(). If this needs more than `most`
/// pivots, returns empty factors. Overwrites `rows`.
Factors factor_rows(const LeafRows& rows, std::size_t vertices, double tolerance, std::size_t most,
                    const BindKernel& kernel);

}  // namespace viete::weights
