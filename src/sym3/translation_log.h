// The translation part of the logarithm of an affine map.
#pragma once

#include "sym3/rotation.h"
#include "sym3/sym3.h"

namespace viete::sym3 {

// The map x' = e^L x + l has the logarithm (L, W l) with W = phi(L)^-1 and
//
//     phi(L) = (e^L - I) / L = I + L / 2 + L^2 / 6 + ...,    W = E - L / 2,    E = (L / 2) coth(L / 2).
//
// E is an even function of L. For a rotation by the angle theta, E is 1 along the axis, and
// (theta / 2) cot(theta / 2) perpendicular to the axis.
//
// For rotations by 360, 720 ... degrees there is no logarithm, because cot is infinite. Within 60 degrees of
// these angles, E perpendicular to the axis decreases smoothly to 0, so that E is continuous and bounded.
// Thread-safe; no allocation, no throw.

/// Returns E for a logarithm L. `turn` is the rotation of L; its axis must be accurate.
Mat3<double> even_part(const Mat3<double>& log, const Vec3<double>& turn);

/// Returns phi(L) x with an error of about 1e-14 |x| e^|L|, for |L| up to 60.
Vec3<double> phi_times(const Mat3<double>& log, const Vec3<double>& x);

/// Returns E x - L x / 2 with E of even_part(). Except near whole turns, the result is phi(L)^-1 x. The
/// result is always finite: if e^L overflows or L has hundreds of turns, the code may use 0 for E.
Vec3<double> inverse_phi_times(const Mat3<double>& log, const Vec3<double>& turn, const Vec3<double>& x);

}  // namespace viete::sym3
