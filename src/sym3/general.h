// exp and log of general 3x3 matrices, which combine a rotation and a stretch.
//
// In the bounds below, u = 2^-53, and k is the relative condition of the function at the matrix: the largest
// relative change of the result per relative change of the matrix, in Frobenius norms. For log of a rotation
// by pi - d radians, k is about 1 / d. Thread-safe; no allocation, no throw.
#pragma once

#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

/// exp(L), with |result - exact| <= 16 u (1 + k) |exact|. For L = 0 it is exactly the identity. If an
/// eigenvalue is above 709, the result is not finite. A NaN, an infinity or an entry above 1e60 in size gives
/// nine NaN.
Mat3<double> exp_general(const Mat3<double>& l);

/// The principal logarithm: the real L with exp(L) = M whose eigenvalues have imaginary parts between -pi and
/// pi. |result - exact| <= 32 u (1 + k) |exact|, with 6 instead of 32 if M shears by at most 100. If M is
/// symmetric, so is L.
/// M has no logarithm if det M <= 0 or an eigenvalue is negative. The logarithm is unreliable if a stretch is
/// below 1e-11 of another, or if eigenvalues rotate by 180 degrees up to 1e-7. In these cases the result is X
/// + Y of log_polar(), which is bounded. If rotation and stretch commute, as for all rotations and
/// similarities, it is log M; otherwise has_log() is false. M = 0 counts as 2^-1074 I. A NaN or an infinity
/// in M gives nine NaN.
Mat3<double> log_general(const Mat3<double>& m);

/// True if exp_general(log_general(M)) is M up to rounding.
bool has_log(const Mat3<double>& m);

/// Adds whole turns to the rotation vector v, so that the result is nearest to `reference`: the axis stays
/// the same, the angle changes by a multiple of 2 pi. If v is zero, or parallel to the reference up to 1e-13,
/// the result has the axis of the reference.
Vec3<double> nearest_branch(const Vec3<double>& v, const Vec3<double>& reference);

/// M = exp(turn) exp(stretch), by the polar decomposition.
struct PolarLog {
  Sym3<double> stretch;  ///< X: the logarithm of the stretch
  Vec3<double> turn;     ///< Y: the logarithm of the rotation, as a rotation vector
};

/// Y is the branch nearest to `near`, see nearest_branch(). X is always finite: stretches are at least 1e-12
/// of the largest stretch, and negative stretches (det M < 0) are replaced by their absolute values. M = 0
/// counts as 2^-1074 I. If an entry is not finite, the result is NaN.
PolarLog log_polar(const Mat3<double>& m, const Vec3<double>& near = {});

/// The logarithm L of M whose rotation is nearest to Y, with any number of whole turns. It is made for
/// blending: if the Y of many maps are coherent, so are their logarithms.
/// Some matrices have no logarithm: they rotate by 180 degrees and stretch perpendicular to the axis. Close
/// to them log M is unbounded. To stay bounded and continuous, the result changes from log M to X + Y while
/// |log M| grows from two to four times |X| + |Y| (Frobenius norms). It is X + Y if a rotation of more than
/// 180 degrees has no well-defined plane, and exactly 0 if X and Y are 0. `parts` must be log_polar() of M;
/// its stretches may have been raised.
Mat3<double> bounded_log(const Mat3<double>& m, const PolarLog& parts);
/// bounded_log() with log_polar(m, near), as accurate as log_general().
Mat3<double> log_near(const Mat3<double>& m, const Vec3<double>& near);

/// The rotation angle of exp(L): the imaginary part of the complex eigenvalues of L, or 0 if all are real.
double angle_of(const Mat3<double>& l);

}  // namespace viete::sym3
