// The translation part of the logarithm of a screw motion or an affine map.
#pragma once

#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

/// The map x' = e^L x + l has the logarithm (L, W l), W = phi(L)^-1 with
///
///     phi(L) = (e^L - I) / L = I + L / 2 + L^2 / 6 + ...,    W = E - L / 2,    E = (L / 2) coth(L / 2),
///
/// E being even in L: for a rotation vector Y with theta = |Y| it is symmetric, 1 along Y and (theta / 2)
/// cot(theta / 2) perpendicular to it. For maps of handles with centres c and c', taken about the points m
/// and m', the translation is (c' - m') - e^L (c - m); since W e^L = E + L / 2, its log is linear in m and
/// m':
///
///     u = a - E (m' - m) + L (m' + m) / 2,    a = E (c' - c) - L (c' + c) / 2.
///
/// So E, L and a can be blended, and u evaluated about the blended centres. Logs about an origin would depend
/// on the origin; this form moves with the handles, and u is 0 if all handles move rigidly together.
///
/// Near turns by 360, 720 ... degrees there is no logarithm: perpendicular to the axis cot has poles. Within
/// 60 degrees of these, E is damped to 0 there, so that it is continuous and bounded at every angle.
/// Thread-safe; no allocation, no throw.
Sym3<double> even_part(const Vec3<double>& turn);
/// turn: the rotation of L, accurate enough to define its axis.
Mat3<double> even_part(const Mat3<double>& log, const Vec3<double>& turn);

/// phi(L) x, to about 1e-14 of |x| e^|L|, for |L| up to 60.
Vec3<double> phi_times(const Mat3<double>& log, const Vec3<double>& x);
Vec3<double> phi_times(const Vec3<double>& turn, const Vec3<double>& x);

/// W x = E x - L x / 2 of even_part(): phi(L)^-1 x except near whole turns. Finite: E may count as 0 if e^L
/// overflows, and for L of hundreds of turns.
Vec3<double> inverse_phi_times(const Mat3<double>& log, const Vec3<double>& turn, const Vec3<double>& x);

}  // namespace viete::sym3
