// exp and log of general 3x3 matrices: of a turn and a stretch in one.
//
// No iteration over the matrix but for one eigenvector, no case for equal or nearly equal eigenvalues,
// complex ones included. u = 2^-53; k is the relative condition of the function at the matrix: the largest
// relative change of the answer per relative change of the entries, Frobenius norms. (At rotations by 180
// degrees less d, k of log is 1 / d or so.) Thread-safe; no allocation, no throw.
#pragma once

#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

/// exp(L), by a power series of what is left of L without its trace, reduced by Cayley and Hamilton, and
/// squarings, and by eigenvalues where these are far apart. |answer - exact| <= 16 u (1 + k) |exact|; not
/// finite where an eigenvalue is beyond 709. Exactly I for L = 0. NaN, infinity or entries past
/// 1e60 in size: nine NaN.
Mat3<double> exp_general(const Mat3<double>& l);

/// The principal logarithm: the real L with exp(L) = M whose eigenvalues have imaginary parts below pi in
/// size. |answer - exact| <= 32 u (1 + k) |exact|; 6 u where M shears by no more than 100. Symmetric
/// for symmetric M.
///
/// Where M has none, because det M <= 0 or it has negative eigenvalues, and where rounding decides, because M
/// is flat (a stretch below 1e-11 of another) or its eigenvalues turn by 180 degrees but for 1e-7, the answer
/// is X + Y of log_polar(): bounded, and the same as log M where turn and stretch commute, as those of all
/// rotations and similarities do. has_log() tells. M = 0 counts as 2^-1074 I. NaN or infinity in M: nine NaN.
Mat3<double> log_general(const Mat3<double>& m);

/// True if exp_general(log_general(M)) is M, but for rounding.
bool has_log(const Mat3<double>& m);

/// The branch n (theta + 2 pi k) of the rotation vector v = n theta that is nearest to `reference`, any whole
/// k. Where v is zero, or along the reference up to 1e-13, the axis is the reference's, so that full turns do
/// not lose it.
Vec3<double> nearest_branch(const Vec3<double>& v, const Vec3<double>& reference);

/// M = exp(turn) exp(stretch), by the polar decomposition.
struct PolarLog {
  Sym3<double> stretch;  ///< X = log S
  Vec3<double> turn;     ///< Y = log R as a rotation vector
};

/// Y is the branch nearest to `near`, see nearest_branch(). Stretches count as 1e-12 of the largest one at
/// least (M = 0 as 2^-1074 I), and those of a mirrored M (det M < 0, R the nearest rotation) without their
/// sign: X is finite. NaN where an entry is not finite.
PolarLog log_polar(const Mat3<double>& m, const Vec3<double>& near = {});

/// L with exp(L) = M = exp(Y) exp(X): the logarithm whose turn is nearest to Y, any number of whole turns, so
/// that branches that are coherent over many maps stay so. For blending: bounded and continuous. On the way
/// to matrices that have no logarithm, those that turn by about 180 degrees and stretch across, logarithms
/// grow without bounds. So L leaves log M for X + Y as |L| goes from twice to four times |X| + |Y| (Frobenius
/// norms); also where a turn of more than 180 degrees leaves no plane of rotation to tell it by. Exactly 0
/// where X and Y are. `parts`: of M, or with stretches that were raised to a floor.
Mat3<double> bounded_log(const Mat3<double>& m, const PolarLog& parts);
/// bounded_log() of log_polar(m, near), as accurate as log_general().
Mat3<double> log_near(const Mat3<double>& m, const Vec3<double>& near);

/// By how much exp(L) turns: the imaginary part of L's complex eigenvalues, 0 where these are real.
double angle_of(const Mat3<double>& l);

}  // namespace viete::sym3
