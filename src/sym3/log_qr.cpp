#include <Eigen/Eigenvalues>

#include "sym3/eigen.h"
#include "sym3/entries.h"
#include "sym3/log.h"

namespace viete::sym3 {

template <class T>
Sym3<T> log_qr(const Sym3<T>& s) {
  if (!is_finite(s)) return nan_matrix<T>();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<T, 3, 3>> solver;
  solver.compute(to_eigen(s));
  const auto& v = solver.eigenvectors();
  const Eigen::Matrix<T, 3, 1> values = solver.eigenvalues().array().log();
  return from_eigen<T>(v * values.asDiagonal() * v.transpose());
}

template Sym3<float> log_qr(const Sym3<float>&);
template Sym3<double> log_qr(const Sym3<double>&);

}  // namespace viete::sym3
