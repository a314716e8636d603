#include "sym3/jacobi.h"

#include <algorithm>

#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

using sym3::DoubleDouble;

namespace {

/// |S - V diag(values) V^T| and |V^T V - I|, over |S| and 1: the larger.
template <class Real>
double residual(const Sym3<double>& s) {
  const auto e = sym3::eigen_by_jacobi<Real>(s);
  const QuadSym original = test::to_quad(s);
  QuadSym product{}, gram{};
  const auto v = [&](int i, int k) { return to_quad(e.vectors[i][k]); };
  Quad* const p[] = {&product.xx, &product.xy, &product.xz, &product.yy, &product.yz, &product.zz};
  Quad* const g[] = {&gram.xx, &gram.xy, &gram.xz, &gram.yy, &gram.yz, &gram.zz};
  const int row[] = {0, 0, 0, 1, 1, 2}, column[] = {0, 1, 2, 1, 2, 2};
  for (int n = 0; n < 6; ++n) {
    for (int k = 0; k < 3; ++k) {
      *p[n] += to_quad(e.values[k]) * v(row[n], k) * v(column[n], k);
      *g[n] += v(k, row[n]) * v(k, column[n]);
    }
  }
  const Quad of_matrix = quad_distance(product, original) / quad_frobenius(original);
  return static_cast<double>(std::max(of_matrix, quad_distance(gram, {1, 0, 0, 1, 0, 1})));
}

}  // namespace

TEST_CASE("jacobi_decomposes_to_the_precision_of_its_numbers") {
  for (const double spread : {1e-6, 1.0, 1e6}) {
    for (const auto& s : spreads<double>(spread, -spread / 3, 200)) {
      CHECK(residual<double>(s) < 30 * 0x1p-53);
      CHECK(residual<DoubleDouble>(s) < 40 * 0x1p-104);
    }
  }
  for (const auto& s : triples<double>(1e-9, 100)) CHECK(residual<DoubleDouble>(s) < 40 * 0x1p-104);
}

TEST_CASE("jacobi_keeps_blocks_and_extreme_ratios") {
  const auto e = sym3::eigen_by_jacobi<DoubleDouble>({1e280, 0, 0, 2, 1, 2});
  CHECK(e.vectors[0][0].hi == 1);
  CHECK(e.vectors[0][1].hi == 0);
  CHECK(e.vectors[1][0].hi == 0);
  CHECK(e.values[0].hi == 1e280);
  CHECK(std::min(e.values[1].hi, e.values[2].hi) == 1);
  CHECK(std::max(e.values[1].hi, e.values[2].hi) == 3);
  CHECK(sym3::eigen_by_jacobi<DoubleDouble>({1e280, 1e-100, 0, 1, 0, 1}).values[1].hi == 1);
}
