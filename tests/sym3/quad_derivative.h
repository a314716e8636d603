// What derivatives are measured against: eigenvectors and divided differences in 113 bits.
#pragma once

#include <quadmath.h>

#include <algorithm>
#include <array>

#include "sym3/fallback.h"
#include "sym3/quad_reference.h"

namespace viete::test {

/// (f(x) - f(y)) / (x - y), f'(x) where they are equal. p: the exponent of pow.
inline Quad quad_slope(sym3::Of f, double p, Quad x, Quad y) {
  const Quad d = x - y;
  const auto expm1_over = [](Quad t) { return t != 0 ? expm1q(t) / t : 1; };
  if (f == sym3::Of::exp) return expq(y) * expm1_over(d);
  if (f == sym3::Of::sqrt) return 1 / (sqrtq(x) + sqrtq(y));
  const Quad of_log = d != 0 ? log1pq(d / y) / d : 1 / y;
  if (f == sym3::Of::log) return of_log;
  return p * of_log * expq(p * logq(y)) * expm1_over(p * of_log * d);
}

struct QuadDerivative {
  QuadSym value;
  Quad norm;  ///< of the derivative as a map: its largest value for a direction of norm 1
};

inline QuadDerivative quad_derivative(sym3::Of f, double p, const QuadSym& s, const QuadSym& direction) {
  const QuadEigen e = quad_eigen(s);
  const auto& v = e.vectors;
  const Quad m[3][3] = {{direction.xx, direction.xy, direction.xz},
                        {direction.xy, direction.yy, direction.yz},
                        {direction.xz, direction.yz, direction.zz}};
  Quad g[3][3] = {}, norm = 0;
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) g[k][l] += v[i][k] * m[i][j] * v[j][l];
      }
      const Quad slope = quad_slope(f, p, e.values[k], e.values[l]);
      g[k][l] *= slope, norm = std::max(norm, fabsq(slope));
    }
  }
  const auto entry = [&](int i, int j) {
    Quad sum = 0;
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) sum += v[i][k] * g[k][l] * v[j][l];
    }
    return sum;
  };
  return {{entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)}, norm};
}

/// In u of T, relative to the norm of the map times that of the direction.
template <class T>
double derivative_error(const sym3::Sym3<T>& computed, const QuadDerivative& exact,
                        const QuadSym& direction) {
  const Quad size = exact.norm * quad_frobenius(direction);
  return static_cast<double>(quad_distance(to_quad(computed), exact.value) / size) / unit_roundoff<T>;
}

}  // namespace viete::test
