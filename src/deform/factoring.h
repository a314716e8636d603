// The weights of a leaf as factors of a few of its rows.
#pragma once

#include <cstddef>
#include <vector>

#include "base/memory.h"
#include "deform/bind_kernel.h"

namespace viete::deform {

struct Factors {
  std::vector<std::size_t> pivots;     ///< slots of the leaf; empty if it has no points
  base::AlignedVector<float> factors;  ///< [tile][pivot][lane]: row = sum of factor times the pivot's row
};

/// Row interpolative decomposition with pivoting: eliminates the largest remaining row until all residuals
/// are at most `tolerance`; gives up after `most` rows. rows [tile][column][lane] is destroyed; only the
/// first `vertices` slots count.
Factors factor_rows(const LeafRows& rows, std::size_t vertices, double tolerance, std::size_t most,
                    const BindKernel& kernel);

}  // namespace viete::deform
