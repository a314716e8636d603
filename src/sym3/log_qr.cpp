#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "sym3/eigen.h"
#include "sym3/entries.h"
#include "sym3/log.h"

namespace viete::sym3 {

template <class T>
Sym3<T> log_qr(const Sym3<T>& s) {
  if (!is_finite(s)) return nan_matrix<T>();
  if (has_huge_eigenvalues(s)) return log_of_256_times(log_qr(times(s, T(0x1p-8))));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<T, 3, 3>> solver;
  solver.compute(to_eigen(s));
  const auto& v = solver.eigenvectors();
  if (!(solver.eigenvalues().minCoeff() > 0)) return nan_matrix<T>();
  Eigen::Matrix<T, 3, 1> values = solver.eigenvalues().array().log();
  for (int k = 0; k < 3; ++k) {  // Eigen takes subnormal numbers for the least normal one
    const T value = solver.eigenvalues()[k];
    if (value < std::numeric_limits<T>::min()) values[k] = std::log(value);
  }
  return from_eigen<T>(v * values.asDiagonal() * v.transpose());
}

template Sym3<float> log_qr(const Sym3<float>&);
template Sym3<double> log_qr(const Sym3<double>&);

}  // namespace viete::sym3
