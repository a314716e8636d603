// Positive definite matrices with a given condition number, general matrices with given singular values.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "bench/ensembles.h"
#include "sym3/rotation.h"

namespace viete::test {

/// The middle eigenvalue is equal or close to another eigenvalue, or is the geometric mean of the others. The
/// smallest eigenvalue is `size` in half of the matrices, and `size` times 0.001 to 1000 in the others.
template <class T>
std::vector<sym3::Sym3<T>> with_condition(double condition, int count, double size = 1) {
  namespace ensembles = bench::ensembles;
  return ensembles::made<T>(count, 54, [=](ensembles::Random& random, std::size_t i) {
    const double near = (condition - 1) * std::pow(10.0, ensembles::uniform(random, -16, -1));
    const double middle[] = {1, condition, 1 + near, condition - near, std::sqrt(condition)};
    const double lowest = size * (i % 2 ? 1 : std::pow(10.0, ensembles::uniform(random, -3, 3)));
    return ensembles::with_eigenvalues<T>({lowest, lowest * middle[i % 5], lowest * condition}, random);
  });
}

/// Returns a general matrix with the singular values s; negative values mirror.
template <class T>
sym3::Mat3<T> with_singular_values(const std::array<double, 3>& s, bench::ensembles::Random& random) {
  const auto a = bench::ensembles::random_rotation(random), b = bench::ensembles::random_rotation(random);
  sym3::Mat3<T> m;
  for (int i = 0; i < 9; ++i) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += a[i / 3][k] * s[k] * b[i % 3][k];
    m[i] = T(sum);
  }
  return m;
}

/// Returns matrices with eigenvalues from 1 - size to 1 + size.
inline std::vector<Sym3<double>> near_identity(double size, int count, Random& random) {
  std::vector<Sym3<double>> all;
  for (int i = 0; i < count; ++i) {
    auto& s = all.emplace_back(with_eigenvalues<double>({size, uniform(random, -size, size), -size}, random));
    s.xx += 1;
    s.yy += 1;
    s.zz += 1;
  }
  return all;
}

}  // namespace viete::test
