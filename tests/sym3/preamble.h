// Matrices, and short names for most tests of sym3.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <vector>

#include "bench/ensembles.h"
#include "sym3/sym3.h"

namespace viete::test {

using namespace bench::ensembles;
using sym3::Sym3;

/// Calls check(spread, lowest) for each spread, with several values of the lowest eigenvalue. exp neither
/// overflows nor underflows for these values.
template <class T, class Check>
void for_spreads(std::initializer_list<double> spreads, const Check& check) {
  const double least = sizeof(T) == 8 ? -700 : -80, most = sizeof(T) == 8 ? 705 : 87;
  for (const double spread : spreads)
    for (const double lowest : {0.0, -spread / 3, -spread / 2, -spread, sizeof(T) == 8 ? -690.0 : -80.0})
      if (lowest + spread < most && lowest + spread > least) check(spread, lowest);
}

/// Returns sets of matrices: of the paper, with wide spectra, and with two or three close eigenvalues.
template <class T>
std::vector<std::vector<Sym3<T>>> all_gaps() {
  std::vector<std::vector<Sym3<T>>> all = {paper_ensemble<T>(2000), spreads<T>(300, -100, 500)};
  for (int digits = 1; digits <= 16; ++digits) {
    all.push_back(pairs<T>(std::pow(10.0, -digits), 200));
    all.push_back(triples<T>(std::pow(10.0, -digits), 200));
  }
  return all;
}

template <class T>
Sym3<T> any_finite(Random& random) {
  const auto any = [&] {
    const double sign = random() % 2 ? 1 : -1;
    return T(sign * std::exp2(uniform(random, -150, sizeof(T) == 8 ? 1023.9 : 127.9)));
  };
  return {any(), any(), any(), any(), any(), any()};
}

/// Returns general matrices with entries in [-1, 1).
template <class T>
std::vector<sym3::Mat3<T>> random_matrices(std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<sym3::Mat3<T>> all(count);
  for (auto& m : all)
    for (T& x : m) x = T(uniform(random, -1, 1));
  return all;
}

template <class T>
T determinant(const std::array<T, 9>& m) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
         m[2] * (m[3] * m[7] - m[4] * m[6]);
}

}  // namespace viete::test

using namespace viete;
using namespace viete::test;
