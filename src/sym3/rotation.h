// Rodrigues' exponential of a rotation vector, and the logarithm of a rotation up to exactly 180 degrees.
#pragma once

#include <array>
#include <cstddef>

#include "sym3/batch.h"
#include "sym3/view.h"

namespace viete::sym3 {

template <class T>
using Vec3 = std::array<T, 3>;

/// A general 3x3 matrix by rows: m[3 * row + column].
template <class T>
using Mat3 = std::array<T, 9>;

/// Returns the rotation R about the axis w / |w| by |w| radians, for any angle. w = 0 gives exactly the
/// identity. |R - exact| <= (8 + 5 |w|) u in the Frobenius norm; u is 2^-53 for double and 2^-24 for float. A
/// NaN or an infinity in w gives nine NaN. Up to 3.24 radians, the function uses polynomials in |w|^2.
template <class T>
Mat3<T> exp_rotation(const Vec3<T>& w);

/// Computes exp_rotation() of `count` vectors. All layouts except `full` are allowed; planes are fastest.
/// `in` and `out` must not overlap. Each result has the same bits as a single call with the same kernel.
void exp_rotation(const VecView<const double>& in, const MatView<double>& out, std::size_t count,
                  const Batch& batch = {});
void exp_rotation(const VecView<const float>& in, const MatView<float>& out, std::size_t count,
                  const Batch& batch = {});

/// Returns the rotation vector w with exp_rotation(w) = R and |w| <= pi up to rounding. If R rotates by
/// exactly 180 degrees (symmetric to the last bit), w and -w are both valid; the result is the vector whose
/// first nonzero component is positive. |w - exact| <= 6 u |w| if the entries of R are exact up to rounding.
/// R need not be an exact rotation: an error E of R with |E| <= 0.1 (Frobenius norm) changes w by at most
/// 2 |E|. If R has a NaN, an infinity or an entry whose square overflows, the result is three NaN. Computes w
/// from the quaternion (Shepperd 1978) and the tangent of a quarter of the angle, which is at most one.
template <class T>
Vec3<T> log_rotation(const Mat3<T>& r);

/// Computes log_rotation() of `count` matrices. The rules of the batched exp_rotation() apply.
void log_rotation(const MatView<const double>& in, const VecView<double>& out, std::size_t count,
                  const Batch& batch = {});
void log_rotation(const MatView<const float>& in, const VecView<float>& out, std::size_t count,
                  const Batch& batch = {});

}  // namespace viete::sym3
