// Converts between Sym3, Eigen's matrices and Voigt vectors. No other header of sym3 includes Eigen.
#pragma once

#include <Eigen/Core>

#include "sym3/derivative.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

template <class T>
Eigen::Matrix<T, 3, 3> to_eigen(const Sym3<T>& s) {
  Eigen::Matrix<T, 3, 3> m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}

/// Converts a symmetric matrix. Reads only the upper triangle.
template <class T>
Sym3<T> from_eigen(const Eigen::Matrix<T, 3, 3>& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

/// Converts a stress to Voigt order: xx, yy, zz, yz, xz, xy.
template <class T>
Eigen::Matrix<T, 6, 1> to_voigt_stress(const Sym3<T>& s) {
  Eigen::Matrix<T, 6, 1> v;
  v << s.xx, s.yy, s.zz, s.yz, s.xz, s.xy;
  return v;
}

template <class T>
Sym3<T> from_voigt_stress(const Eigen::Matrix<T, 6, 1>& v) {
  return {v[0], v[5], v[4], v[1], v[3], v[2]};
}

/// Converts a strain to Voigt order: xx, yy, zz, 2 yz, 2 xz, 2 xy (engineering shear strains).
template <class T>
Eigen::Matrix<T, 6, 1> to_voigt_strain(const Sym3<T>& s) {
  Eigen::Matrix<T, 6, 1> v;
  v << s.xx, s.yy, s.zz, 2 * s.yz, 2 * s.xz, 2 * s.xy;
  return v;
}

template <class T>
Sym3<T> from_voigt_strain(const Eigen::Matrix<T, 6, 1>& v) {
  return {v[0], v[5] / 2, v[4] / 2, v[1], v[3] / 2, v[2]};
}

/// Returns the tangent stiffness in Voigt order. This matrix times a strain rate is the stress rate. The
/// matrix is symmetric up to rounding.
template <class T>
Eigen::Matrix<T, 6, 6> to_voigt_tangent(const Tangent<T>& t) {
  Eigen::Matrix<T, 6, 6> m;
  m << to_voigt_stress(t[0]), to_voigt_stress(t[3]), to_voigt_stress(t[5]), to_voigt_stress(t[4]) / 2,
      to_voigt_stress(t[2]) / 2, to_voigt_stress(t[1]) / 2;
  return m;
}

}  // namespace viete::sym3
