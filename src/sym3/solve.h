// Linear systems of three equations. Internal; not for the kernels, which share no inline code.
#pragma once

#include <cmath>
#include <utility>

#include "sym3/rotation.h"

namespace viete::sym3 {

/// X with A X = B, by elimination with pivots of columns: backward stable. B and X by rows; not finite where
/// A is singular.
template <std::size_t N>
std::array<std::array<double, N>, 3> solved(Mat3<double> a, std::array<std::array<double, N>, 3> b) {
  std::array<std::size_t, 3> row{0, 1, 2};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = k + 1; i < 3; ++i) {
      if (std::abs(a[3 * row[i] + k]) > std::abs(a[3 * row[k] + k])) std::swap(row[i], row[k]);
    }
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double factor = a[3 * row[i] + k] / a[3 * row[k] + k];
      for (std::size_t c = k + 1; c < 3; ++c) a[3 * row[i] + c] -= factor * a[3 * row[k] + c];
      for (std::size_t c = 0; c < N; ++c) b[row[i]][c] -= factor * b[row[k]][c];
    }
  }
  std::array<std::array<double, N>, 3> x;
  for (std::size_t k = 3; k-- > 0;) {
    for (std::size_t c = 0; c < N; ++c) {
      double sum = b[row[k]][c];
      for (std::size_t j = k + 1; j < 3; ++j) sum -= a[3 * row[k] + j] * x[j][c];
      x[k][c] = sum / a[3 * row[k] + k];
    }
  }
  return x;
}

}  // namespace viete::sym3
