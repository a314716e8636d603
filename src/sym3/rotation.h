// Rotations: Rodrigues' exponential of a rotation vector, and its logarithm up to and including 180 degrees.
#pragma once

#include <array>
#include <cstddef>

#include "sym3/batch.h"
#include "sym3/view.h"

namespace viete::sym3 {

template <class T>
using Vec3 = std::array<T, 3>;

/// A general 3x3 matrix, entries by rows: m[3 * row + column].
template <class T>
using Mat3 = std::array<T, 9>;

/// The rotation about axis w / |w| by |w| radians (any angle). w = 0 gives exactly I. By the quaternion of
/// the half angle: polynomials in |w|^2 up to 3.24 radians, no root, no case for small angles. |R - exact| <=
/// (8 + 5 |w|) u, Frobenius norm, u = 2^-53 or 2^-24. NaN or infinity in w: nine NaN.
template <class T>
Mat3<T> exp_rotation(const Vec3<T>& w);

/// The same for `count` vectors, from any layout but `full` to any but `full`; planes are fastest. `in` and
/// `out` must not overlap. Each answer has the bits of the single call under that kernel.
void exp_rotation(const VecView<const double>& in, const MatView<double>& out, std::size_t count,
                  const Batch& batch = {});
void exp_rotation(const VecView<const float>& in, const MatView<float>& out, std::size_t count,
                  const Batch& batch = {});

/// The rotation vector w, |w| <= pi up to rounding, with exp_rotation(w) = R. At exactly 180 degrees (R
/// symmetric to the last bit), where w and -w are both valid, the first nonzero component of w is positive.
/// By the quaternion, from its largest component (Shepperd 1978), and the tangent of a quarter of the angle,
/// which is at most one: a polynomial, no case for small angles or half turns. |w - exact| <= 6 u |w| if
/// entries of R are exact up to rounding. R need not be an exact rotation: an error E, Frobenius norm up to
/// 0.1, changes w by at most 2 |E|. NaN or infinity in R, or entries whose squares overflow: three NaN.
template <class T>
Vec3<T> log_rotation(const Mat3<T>& r);

/// The same for `count` matrices, from any layout but `full` to any but `full`; planes are fastest. `in` and
/// `out` must not overlap. Each answer has the bits of the single call under that kernel.
void log_rotation(const MatView<const double>& in, const VecView<double>& out, std::size_t count,
                  const Batch& batch = {});
void log_rotation(const MatView<const float>& in, const VecView<float>& out, std::size_t count,
                  const Batch& batch = {});

}  // namespace viete::sym3
