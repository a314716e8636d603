// The polar decomposition M = R U of general 3x3 matrices. R is a rotation even if det M < 0.
#pragma once

#include <cstddef>

#include "sym3/batch.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

// R is the rotation nearest to M, and U = R^T M is symmetric. The eigenvalues of U are s1 >= s2 >= |s3|.
// These numbers are the singular values of M, but s3 has the sign of det M.
//
// |R - exact| <= 8 u (1 + s1 / (s2 + s3)) in the Frobenius norm; u is 2^-53 for double and 2^-24 for float.
// The error of U relative to M has the same bound. The trace of U is a root of a polynomial of degree four
// (polar-inl.h). If (s1 + s2)(s1 + s3)(s2 + s3) is less than 3 % of |M|^3, R is computed from the largest
// eigenvector of Horn's 4x4 matrix (1987), in about 1 us. If s2 + s3 = 0, several rotations are nearest, and
// the result is one of these rotations. For M = 0 the result is the identity. Entries of U that overflow are
// infinite. A NaN or an infinity in M gives NaN. Thread-safe; no allocation, no throw.

template <class T>
struct Polar {
  Mat3<T> rotation;
  Sym3<T> stretch;
};

template <class T>
Polar<T> polar(const Mat3<T>& m);

/// Computes the rotations of many matrices, with the same bits as single calls with the same kernel. All
/// layouts except `full` are allowed; planes are fastest. `in` and `rotations` must be equal or not overlap.
void polar(const MatView<const double>& in, const MatView<double>& rotations, std::size_t count,
           const Batch& batch = {});
void polar(const MatView<const float>& in, const MatView<float>& rotations, std::size_t count,
           const Batch& batch = {});

/// Computes rotations and stretches. `stretches` may have any layout and must not overlap other views.
void polar(const MatView<const double>& in, const MatView<double>& rotations,
           const SymView<double>& stretches, std::size_t count, const Batch& batch = {});
void polar(const MatView<const float>& in, const MatView<float>& rotations, const SymView<float>& stretches,
           std::size_t count, const Batch& batch = {});

}  // namespace viete::sym3
