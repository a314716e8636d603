// The polar decomposition M = R U of general 3x3 matrices; R is a rotation for any sign of det M.
#pragma once

#include <cstddef>

#include "sym3/batch.h"
#include "sym3/rotation.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

namespace viete::sym3 {

// s1 >= s2 >= |s3| are the singular values of M, s3 with the sign of det M. R is the rotation nearest to M; U
// = R^T M is symmetric with eigenvalues s1, s2, s3: positive semi-definite for det M >= 0, indefinite below.
//
// Error |R - exact| <= 8 u (1 + s1 / (s2 + s3)), Frobenius norm, u = 2^-53 or 2^-24; U has the same error
// relative to M. By the quartic for the trace of U (polar-inl.h) if (s1 + s2)(s1 + s3)(s2 + s3) is above 3 %
// of |M|^3, else by the largest eigenvector of Horn's 4x4 matrix (1987), refined once, some 1 us. If s2 + s3
// = 0 the nearest rotation is not unique: the result is one of them, for M = 0 the identity. Any finite
// entries; entries of U that overflow are infinite. NaN or infinity in M gives NaN. Thread-safe; no
// allocation, no throw.

template <class T>
struct Polar {
  Mat3<T> rotation;
  Sym3<T> stretch;
};

template <class T>
Polar<T> polar(const Mat3<T>& m);

/// The rotations of many: the bits of the single call under that kernel. Any layout but `full`; planes are
/// fastest; both may be the same view, otherwise must not overlap.
void polar(const MatView<const double>& in, const MatView<double>& rotations, std::size_t count,
           const Batch& batch = {});
void polar(const MatView<const float>& in, const MatView<float>& rotations, std::size_t count,
           const Batch& batch = {});

/// Rotations and stretches of many; the stretches in any layout, not overlapping the other views.
void polar(const MatView<const double>& in, const MatView<double>& rotations,
           const SymView<double>& stretches, std::size_t count, const Batch& batch = {});
void polar(const MatView<const float>& in, const MatView<float>& rotations, const SymView<float>& stretches,
           std::size_t count, const Batch& batch = {});

}  // namespace viete::sym3
