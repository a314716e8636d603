// Compression: writes the weights of a leaf as linear combinations of a few of its rows.
#pragma once

#include <cstddef>
#include <vector>

#include "base/memory.h"
#include "deform/bind_kernel.h"

namespace viete::deform {

struct Factors {
  std::vector<std::size_t> pivots;     ///< slots of the rows to combine; empty if more than `most` are needed
  base::AlignedVector<float> factors;  ///< [tile][pivot][lane]: row = sum of (factor * row of the pivot)
};

/// Computes a row interpolative decomposition with pivoting: eliminates the largest remaining row until the
/// norms of the residuals of the first `vertices` slots are at most `tolerance`. If this needs more than
/// `most` rows, returns empty factors. Overwrites `rows`.
Factors factor_rows(const LeafRows& rows, std::size_t vertices, double tolerance, std::size_t most,
                    const BindKernel& kernel);

}  // namespace viete::deform
