#include "bench/methods.h"

#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/MatrixFunctions>

#include "sym3/eigen.h"
#include "sym3/exp.h"

namespace viete::bench {

namespace {

using sym3::Method;
using sym3::Sym3;

template <Method method, class T>
Sym3<T> by(const Sym3<T>& s) {
  return sym3::exp(s, method);
}

template <class T>
Sym3<T> by_direct(const Sym3<T>& s) {
  using Matrix = Eigen::Matrix<T, 3, 3>;
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  solver.computeDirect(sym3::to_eigen(s));
  const Matrix& v = solver.eigenvectors();
  return sym3::from_eigen<T>(v * solver.eigenvalues().array().exp().matrix().asDiagonal() * v.transpose());
}

template <class T>
Sym3<T> by_pade(const Sym3<T>& s) {
  return sym3::from_eigen<T>(Eigen::Matrix<T, 3, 3>(sym3::to_eigen(s).exp()));
}

template <Method method>
ExpMethod by_method() {
  return {sym3::label(method).data(), by<method, double>, by<method, float>};
}

const ExpMethod methods[] = {
    by_method<Method::diag>(),        {"Direct", by_direct<double>, by_direct<float>},
    by_method<Method::sd>(),          by_method<Method::improved_sd_faithful>(),
    by_method<Method::improved_sd>(), {"Pade", by_pade<double>, by_pade<float>},
    by_method<Method::fast>(),
};

}  // namespace

std::span<const ExpMethod> exp_methods() {
  return methods;
}

}  // namespace viete::bench
