#include "sym3/log.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "sym3/call_kernel.h"
#include "sym3/eigen.h"
#include "sym3/small_matrices.h"

namespace viete::sym3 {

template <class T>
Sym3<T> log(const Sym3<T>& s) {
  return call_one<Sym3<T>>(&KernelFunctions<T>::log, &s.xx);
}

template <class T>
Sym3<T> sqrt(const Sym3<T>& s) {
  return call_one<Sym3<T>>(&KernelFunctions<T>::sqrt, &s.xx);
}

template <class T>
Sym3<T> inv_sqrt(const Sym3<T>& s) {
  return call_one<Sym3<T>>(&KernelFunctions<T>::inv_sqrt, &s.xx);
}

template <class T>
Sym3<T> pow(const Sym3<T>& s, double p) {
  return call_one<Sym3<T>>(&KernelFunctions<T>::pow, &s.xx, p);
}

#define VIETE_FOR(T)                                                                                        \
  template Sym3<T> log(const Sym3<T>&);                                                                     \
  template Sym3<T> log_qr(const Sym3<T>&);                                                                  \
  template Sym3<T> sqrt(const Sym3<T>&);                                                                    \
  template Sym3<T> inv_sqrt(const Sym3<T>&);                                                                \
  template Sym3<T> pow(const Sym3<T>&, double);                                                             \
  void log(const SymView<const T>& in, const SymView<T>& out, std::size_t count, const Batch& batch) {      \
    call_many(&KernelFunctions<T>::log, in, out, count, batch);                                             \
  }                                                                                                         \
  void sqrt(const SymView<const T>& in, const SymView<T>& out, std::size_t count, const Batch& batch) {     \
    call_many(&KernelFunctions<T>::sqrt, in, out, count, batch);                                            \
  }                                                                                                         \
  void inv_sqrt(const SymView<const T>& in, const SymView<T>& out, std::size_t count, const Batch& batch) { \
    call_many(&KernelFunctions<T>::inv_sqrt, in, out, count, batch);                                        \
  }                                                                                                         \
  void pow(const SymView<const T>& in, double p, const SymView<T>& out, std::size_t count,                  \
           const Batch& batch) {                                                                            \
    call_many(&KernelFunctions<T>::pow, in, out, count, batch, p);                                          \
  }
template <class T>
Sym3<T> log_qr(const Sym3<T>& s) {
  if (!is_finite(s)) return nan_matrix<T>();
  if (has_huge_eigenvalues(s)) return log_of_256_times(log_qr(times(s, T(0x1p-8))));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<T, 3, 3>> solver;
  solver.compute(to_eigen(s));
  const auto& v = solver.eigenvectors();
  if (!(solver.eigenvalues().minCoeff() > 0)) return nan_matrix<T>();
  Eigen::Matrix<T, 3, 1> values = solver.eigenvalues().array().log();
  for (int k = 0; k < 3; ++k) {  // Eigen's log changes subnormal numbers to the smallest normal number
    const T value = solver.eigenvalues()[k];
    if (value < std::numeric_limits<T>::min()) values[k] = std::log(value);
  }
  return from_eigen<T>(v * values.asDiagonal() * v.transpose());
}

VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

}  // namespace viete::sym3
