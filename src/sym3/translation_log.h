// The translation part of the logarithm of an affine map.
#pragma once

#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

// The map x' = e^L x + l has the logarithm (L, W l) with W = phi(L)^-1 and
//
//     phi(L) = (e^L - I) / L = I + L / 2 + L^2 / 6 + ...,    W = E - L / 2,    E = (L / 2) coth(L / 2).
//
// E is an even function of L. For a rotation by the angle theta it is symmetric: 1 along the axis, and (theta
// / 2) cot(theta / 2) perpendicular to it.
//
// A handle moves from its centre c to c'. About points m and m', the translation of its map is (c' - m') -
// e^L (c - m). Since W e^L = E + L / 2, the logarithm v of this translation is linear in m and m':
//
//     v = a - E (m' - m) + L (m' + m) / 2,    a = E (c' - c) - L (c' + c) / 2.
//
// Therefore E, L and a can be blended, and v evaluated about the blended centres. The result does not depend
// on the origin, and v is 0 if all handles move rigidly together.
//
// For rotations by 360, 720 ... degrees there is no logarithm: cot has poles. Within 60 degrees of these
// angles E is damped, down to 0 at the pole, so that it is continuous and bounded. Thread-safe; no
// allocation, no throw.

/// E of a rotation vector.
Sym3<double> even_part(const Vec3<double>& turn);
/// E of a logarithm L. `turn` is the rotation of L, accurate enough to define the axis.
Mat3<double> even_part(const Mat3<double>& log, const Vec3<double>& turn);

/// phi(L) x, with an error of about 1e-14 |x| e^|L|, for |L| up to 60.
Vec3<double> phi_times(const Mat3<double>& log, const Vec3<double>& x);
Vec3<double> phi_times(const Vec3<double>& turn, const Vec3<double>& x);

/// E x - L x / 2 with E of even_part(), which is phi(L)^-1 x except near whole turns. The result is finite:
/// if e^L overflows or L has hundreds of turns, E may count as 0.
Vec3<double> inverse_phi_times(const Mat3<double>& log, const Vec3<double>& turn, const Vec3<double>& x);

}  // namespace viete::sym3
