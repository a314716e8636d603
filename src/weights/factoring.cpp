#include "weights/factoring.h"

#include <algorithm>
#include <cmath>

#include "weights/leaves.h"

namespace viete::weights {

namespace {

void copy_row(const LeafRows& leaf, std::size_t slot, double scale, std::vector<float>& out) {
  const TileLines<float> rows{leaf.rows, leaf.columns};
  for (std::size_t j = 0; j < leaf.columns; ++j) out[j] = static_cast<float>(scale * rows.at(slot, j));
}

}  // namespace

Basis find_basis(const LeafRows& leaf, std::size_t vertices, double tolerance, std::size_t most,
                 const BindKernel& kernel) {
  const std::size_t slots = leaf.tiles * lanes;
  std::vector<float> unit(leaf.columns, 0.0f);
  base::AlignedVector<float> norms(slots), taken(slots);
  Basis result;
  kernel.take_out(leaf, unit.data(), taken.data(), norms.data());
  for (;;) {
    const auto largest =
        std::max_element(norms.begin(), norms.begin() + static_cast<std::ptrdiff_t>(vertices));
    if (!(*largest > tolerance * tolerance)) break;
    if (result.pivots.size() == most) return {};
    const auto pivot = static_cast<std::size_t>(largest - norms.begin());
    copy_row(leaf, pivot, 1 / std::sqrt(static_cast<double>(*largest)), unit);
    kernel.take_out(leaf, unit.data(), taken.data(), norms.data());
    norms[pivot] = 0;
    result.pivots.push_back(pivot);
    result.coefficients.push_back(taken);
  }
  return result;
}

Factors factor_rows(const LeafRows& leaf, std::size_t vertices, double tolerance, std::size_t most,
                    const BindKernel& kernel) {
  const auto [pivots, coefficients] = find_basis(leaf, vertices, tolerance, most, kernel);
  const std::size_t rank = pivots.size(), slots = leaf.tiles * lanes;
  Factors result{pivots, {}};
  result.factors.resize(slots * rank);
  const TileLines<float> factors{result.factors.data(), rank};
  for (std::size_t t = 0; t < rank; ++t)
    for (std::size_t s = 0; s < slots; ++s) factors.at(s, t) = coefficients[t][s];
  std::vector<float> lower(rank * rank);
  for (std::size_t s = 0; s < rank; ++s) {
    for (std::size_t t = 0; t < rank; ++t) lower[s * rank + t] = coefficients[t][pivots[s]];
  }
  kernel.solve(result.factors.data(), leaf.tiles, rank, lower.data());
  return result;
}

}  // namespace viete::weights
