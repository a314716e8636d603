// exp and log of general 3x3 matrices, which combine a rotation and a stretch.
//
// Iterates only for one eigenvector; needs no case for equal, nearly equal or complex eigenvalues. u = 2^-53;
// k is the relative condition of the function at the matrix: the largest relative change of the result per
// relative change of the entries, Frobenius norms. (At rotations by 180 degrees minus d, k of log is about 1
// / d.) Thread-safe; no allocation, no throw.
#pragma once

#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

/// exp(L): a power series of the traceless part, reduced by Cayley-Hamilton, and squarings; by eigenvalues if
/// these are far apart. |result - exact| <= 16 u (1 + k) |exact|; not finite if an eigenvalue exceeds 709.
/// Exactly I for L = 0. NaN, infinity or entries above 1e60 in size: nine NaN.
Mat3<double> exp_general(const Mat3<double>& l);

/// The principal logarithm: the real L with exp(L) = M whose eigenvalues have imaginary parts below pi in
/// size. |result - exact| <= 32 u (1 + k) |exact|; 6 u if M shears by at most 100. Symmetric for symmetric M.
///
/// M has no logarithm if det M <= 0 or it has negative eigenvalues, and an unreliable one if it is flat (a
/// stretch below 1e-11 of another) or its eigenvalues rotate by 180 degrees up to 1e-7. The result is then X
/// + Y of log_polar(): bounded, and equal to log M if rotation and stretch commute, as for all rotations and
/// similarities. See has_log(). M = 0 counts as 2^-1074 I. NaN or infinity in M: nine NaN.
Mat3<double> log_general(const Mat3<double>& m);

/// True if exp_general(log_general(M)) is M up to rounding.
bool has_log(const Mat3<double>& m);

/// The branch n (theta + 2 pi k), k any integer, of the rotation vector v = n theta that is nearest to
/// `reference`. If v is zero, or along the reference up to 1e-13, the axis is the reference's, so that full
/// turns are kept.
Vec3<double> nearest_branch(const Vec3<double>& v, const Vec3<double>& reference);

/// M = exp(turn) exp(stretch), by the polar decomposition.
struct PolarLog {
  Sym3<double> stretch;  ///< X = log S
  Vec3<double> turn;     ///< Y = log R as a rotation vector
};

/// Y is the branch nearest to `near`, see nearest_branch(). Stretches are raised to 1e-12 of the largest one
/// (M = 0 counts as 2^-1074 I) and, for a mirrored M (det M < 0, R the nearest rotation), taken in absolute
/// value: X is finite. NaN if an entry is not finite.
PolarLog log_polar(const Mat3<double>& m, const Vec3<double>& near = {});

/// L with exp(L) = M = exp(Y) exp(X): the logarithm whose rotation is nearest to Y, with any number of whole
/// turns, so that branches that are coherent over many maps stay coherent. For blending: bounded and
/// continuous. Near matrices without logarithm, which rotate by about 180 degrees and stretch perpendicular
/// to the axis, logarithms are unbounded. Therefore L changes from log M to X + Y as |L| goes from two to
/// four times |X| + |Y| (Frobenius norms); also if a rotation of more than 180 degrees has no well-defined
/// plane. Exactly 0 if X and Y are. `parts`: of M, or with stretches raised to a floor.
Mat3<double> bounded_log(const Mat3<double>& m, const PolarLog& parts);
/// bounded_log() of log_polar(m, near), as accurate as log_general().
Mat3<double> log_near(const Mat3<double>& m, const Vec3<double>& near);

/// Rotation angle of exp(L): the imaginary part of L's complex eigenvalues, 0 if all are real.
double angle_of(const Mat3<double>& l);

}  // namespace viete::sym3
