#include "sym3/eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <limits>

#include "sym3/call_kernel.h"
#include "sym3/eigen.h"
#include "sym3/trigonometric.h"
#include "sym3/small_matrices.h"

namespace viete::sym3 {

namespace {

template <class T>
std::array<T, 3> three_nan() {
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  return {nan, nan, nan};
}

}  // namespace

template <class T>
std::array<T, 3> eigenvalues_qr(const Sym3<T>& s) {
  if (!is_finite(s)) return three_nan<T>();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<T, 3, 3>> solver;
  solver.compute(to_eigen(s), Eigen::EigenvaluesOnly);
  const auto& values = solver.eigenvalues();
  return {values[0], values[1], values[2]};
}

template <class T>
std::array<T, 3> eigenvalues_viete(const Sym3<T>& s) {
  if (!is_finite(s)) return three_nan<T>();
  const auto [largest, smallest, middle] = viete_roots(depressed_cubic(s));
  return {smallest, middle, largest};
}

template <class T>
std::array<T, 3> eigenvalues(const Sym3<T>& s) {
  T out[3];
  call_one(&KernelFunctions<T>::eigenvalues, &s.xx, out);
  return {out[0], out[1], out[2]};
}

#define VIETE_FOR(T)                                                                     \
  template std::array<T, 3> eigenvalues(const Sym3<T>&);                                 \
  void eigenvalues(const SymView<const T>& in, const VecView<T>& out, std::size_t count, \
                   const Batch& batch) {                                                 \
    call_many(&KernelFunctions<T>::eigenvalues, in, out, count, batch);                  \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

template std::array<float, 3> eigenvalues_qr(const Sym3<float>&);
template std::array<double, 3> eigenvalues_qr(const Sym3<double>&);
template std::array<float, 3> eigenvalues_viete(const Sym3<float>&);
template std::array<double, 3> eigenvalues_viete(const Sym3<double>&);

}  // namespace viete::sym3
