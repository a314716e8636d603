// Logarithm, exponential, weighted sums, interpolation and means of affine maps.
//
// The method adds and scales the logarithms of maps (M. Alexa, Linear combination of transformations, 2002).
// Linear maps (3x3) keep a translation of exactly zero. For precision and range see general.h and
// translation_log.h. If the linear part has no logarithm, see has_log(), the map has no logarithm: it mirrors
// or is flat, or it rotates by 180 degrees and stretches perpendicular to the axis. Such a map gets a bounded
// logarithm, but exp of that logarithm is another map. Input that is not finite gives NaN. Thread-safe; no
// allocation, no throw.
//
// The order of the maps does not change the result of combine(). Inverse maps give the inverse result, and
// maps C A C^-1 give C combine() C^-1, so the result does not depend on the coordinate system. For
// interpolate() and mean(), maps C A D also give C mean() D.
#pragma once

#include <span>

#include "sym3/rotation.h"

namespace viete::sym3 {

/// The map x' = linear x + translation: the upper three rows of a 4x4 matrix.
struct Affine {
  Mat3<double> linear{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3<double> translation{};

  friend bool operator==(const Affine&, const Affine&) = default;
};

/// The logarithm of an affine map: the upper three rows of a 4x4 matrix whose fourth row is 0. Programs can
/// add and scale logarithms.
struct AffineLog {
  Mat3<double> linear{};
  Vec3<double> translation{};

  friend bool operator==(const AffineLog&, const AffineLog&) = default;
};

/// Returns the map that first applies b and then a.
Affine operator*(const Affine& a, const Affine& b);
/// Returns the inverse map. If the linear part is singular, the result is not finite.
Affine inverse(const Affine& a);

/// Returns the principal logarithm of the map x' = M x + l: (L, phi(L)^-1 l) with L = log_general(M). phi is
/// defined in translation_log.h.
AffineLog log_affine(const Affine& map);
/// Returns the logarithm with L = log_near(M, near): the branch nearest to a rotation vector, for example to
/// turn_of() an earlier logarithm. For rotations close to 360, 720 ... degrees the translation part is
/// approximate and bounded.
AffineLog log_affine(const Affine& map, const Vec3<double>& near);

/// Returns (e^L, phi(L) l), the exponential of (L, l). For 0 the result is exactly the identity.
Affine exp_affine(const AffineLog& log);

/// Returns the antisymmetric part of the linear part as a rotation vector: axis and angle of the rotation.
Vec3<double> turn_of(const AffineLog& log);

/// Returns the sum of weight times logarithm. Each logarithm needs one weight; weights may have any sum.
AffineLog weighted_sum(std::span<const AffineLog> logs, std::span<const double> weights);

/// Returns exp(sum of weight times log(map)) with principal logarithms. Each map needs one weight. If the
/// weights sum to 1, the result approximates mean(). Other sums scale it: combine({A}, {0.5}) is the square
/// root of A. To choose branches, use log_affine() and weighted_sum().
Affine combine(std::span<const Affine> maps, std::span<const double> weights);

/// Returns A exp(t log(A^-1 B)) for any t: exactly A at t = 0, and B at t = 1, at a constant rate. If A^-1 B
/// has no logarithm, the result at t = 1 is not B. If A has no inverse, the result is not finite.
Affine interpolate(const Affine& a, const Affine& b, double t);
/// Uses the branch of log(A^-1 B) nearest to the rotation vector `near`, which may have any number of turns.
Affine interpolate(const Affine& a, const Affine& b, double t, const Vec3<double>& near);

/// The sum of weights times 2^-shift, without overflow or underflow. If it is 0 up to rounding, it is 0.
struct WeightSum {
  int shift;
  double sum;
};
WeightSum sum_of(std::span<const double> weights);

struct AffineMean {
  Affine map;
  bool converged;
};

/// Returns the bi-invariant mean (V. Arsigny, X. Pennec, N. Ayache, Bi-invariant means in Lie groups, 2006):
/// the map with sum w log(mean^-1 A) = 0 over all maps A with weights w. Requires at least one map, and one
/// weight for each map. The weights are divided by their sum. The computation takes at most 200 steps from
/// the map with the largest weight. `converged` is false and the map is the last iterate if the steps do not
/// converge (possible for maps half a turn apart), a map has no inverse, or the weights sum to 0 up to
/// rounding.
AffineMean mean(std::span<const Affine> maps, std::span<const double> weights);

}  // namespace viete::sym3
