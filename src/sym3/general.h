// exp and log of general 3x3 matrices, which combine a rotation and a stretch.
//
// In the bounds below, u = 2^-53. k is the condition number of the function at the matrix: the largest ratio
// of the relative change of the result to the relative change of the matrix, in Frobenius norms. For log of a
// rotation by pi - d radians, k is about 1 / d. Thread-safe; no allocation, no throw.
#pragma once

#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

/// Returns exp(L) with |result - exact| <= 16 u (1 + k) |exact|. For L = 0 the result is exactly the
/// identity. If an eigenvalue is above 709, the result is not finite. If L has a NaN, an infinity or an entry
/// above 1e60 in size, the result is nine NaN.
Mat3<double> exp_general(const Mat3<double>& l);

/// Returns the principal logarithm of M: the real L with exp(L) = M. The imaginary parts of the eigenvalues
/// of L are between -pi and pi. |result - exact| <= 32 u (1 + k) |exact|. If M shears by at most 100, the
/// factor is 6 instead of 32. If M is symmetric, L is also symmetric. In these cases, log M does
/// not exist or is not reliable:
///   - det M <= 0, or an eigenvalue is negative;
///   - a stretch is below 1e-11 * another stretch, or an angle is 180 degrees up to 1e-7.
/// The result is then X + Y of log_polar(), which is bounded, and has_log() is false. Exception: if rotation
/// and stretch commute (for example, for a rotation), X + Y is log M, and has_log() is true. M = 0 counts as
/// 2^-1074 I. A NaN or an infinity in M gives nine NaN.
Mat3<double> log_general(const Mat3<double>& m);

/// Returns true if M has a logarithm, so that exp_general(log_general(M)) is M up to rounding.
bool has_log(const Mat3<double>& m);

/// Adds whole turns to the rotation vector v, so that the result is nearest to `reference`. The axis does not
/// change, and the angle changes by a multiple of 2 pi. Exception: if the reference is longer than pi and v
/// is at most 1e-13 away from the axis of the reference, the result has this axis.
Vec3<double> nearest_branch(const Vec3<double>& v, const Vec3<double>& reference);

/// The logarithms of the polar decomposition M = exp(turn) exp(stretch).
struct PolarLog {
  Sym3<double> stretch;  ///< X: the logarithm of the stretch
  Vec3<double> turn;     ///< Y: the logarithm of the rotation, as a rotation vector
};

/// Returns X and Y of M. Y is the branch nearest to `near`, see nearest_branch(). If M is finite, X is also
/// finite: 1e-12 * the largest stretch replaces smaller stretches, and a negative stretch (det M < 0) becomes
/// positive. M = 0 counts as 2^-1074 I. If an entry of M is not finite, the result is NaN.
PolarLog log_polar(const Mat3<double>& m, const Vec3<double>& near = {});

/// Returns the logarithm of M on the branch nearest to Y = parts.turn, which may have any number of whole
/// turns. Use bounded_log() to blend maps: each logarithm keeps the whole turns of its Y.
/// Near matrices that rotate by 180 degrees and stretch perpendicular to the axis, log M is unbounded.
/// Therefore the result changes from log M to X + Y while |log M| grows from two to four times |X| + |Y|
/// (Frobenius norms). If a rotation of more than 180 degrees has no well-defined plane, the result is X + Y.
/// If X and Y are 0, the result is exactly 0. `parts` must be log_polar() of M; whole turns may be added to
/// parts.turn.
Mat3<double> bounded_log(const Mat3<double>& m, const PolarLog& parts);
/// Returns bounded_log() with log_polar(m, near), as accurate as log_general().
Mat3<double> log_near(const Mat3<double>& m, const Vec3<double>& near);

/// Returns the rotation angle of exp(L): the imaginary part of L's complex eigenvalues, or 0 if all
/// eigenvalues are real.
double angle_of(const Mat3<double>& l);

}  // namespace viete::sym3
