// Logarithm, exponential, weighted sums, interpolation and means of affine maps.
//
// The functions add and scale the logarithms of maps (M. Alexa, Linear combination of transformations, 2002).
// If a map has no translation, its logarithm has no translation. For precision and range see general.h and
// translation_log.h.
//
// A map has no logarithm if its linear part has none, see has_log(). Such a map mirrors or is flat, or it
// rotates by 180 degrees and stretches perpendicular to the axis. log_affine() then returns a bounded result
// L, but exp_affine(L) is another map. Input that is not finite gives NaN. Thread-safe; no allocation, no
// throw.
//
// combine() does not depend on the order of the maps. If all maps are inverted, the result is inverted. If
// each map A becomes C A C^-1, the result R becomes C R C^-1. Therefore the choice of coordinates does not
// matter. For interpolate() and mean(), if each map A becomes C A D, the result R becomes C R D.
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

/// The logarithm of an affine map: the upper three rows of a 4x4 matrix whose fourth row is 0.
struct AffineLog {
  Mat3<double> linear{};
  Vec3<double> translation{};

  friend bool operator==(const AffineLog&, const AffineLog&) = default;
};

/// Returns the map that first applies b and then a.
Affine operator*(const Affine& a, const Affine& b);
/// Returns the inverse map. If the linear part is singular, the result is not finite.
Affine inverse(const Affine& a);

/// Returns the principal logarithm of the map x' = M x + l. The result has the linear part L = log_general(M)
/// and the translation phi(L)^-1 l. For phi see translation_log.h.
AffineLog log_affine(const Affine& map);
/// Like log_affine(map), but with L = log_near(M, near): the branch nearest to the rotation vector `near`. To
/// follow a motion, pass turn_of() of the previous logarithm as `near`. If the rotation is close to 360, 720
/// ... degrees, the translation part is approximate and bounded.
AffineLog log_affine(const Affine& map, const Vec3<double>& near);

/// Returns the map with the linear part e^L and the translation phi(L) l, where L and l are the parts of
/// `log`. For log = 0 the result is exactly the identity.
Affine exp_affine(const AffineLog& log);

/// Returns the antisymmetric part of log.linear as a rotation vector. Its direction is the rotation axis, and
/// its length is the angle.
Vec3<double> turn_of(const AffineLog& log);

/// Returns exp(sum of weights[i] * log(maps[i])) with principal logarithms. Both arrays must have equal
/// sizes. If the weights sum to 1, the result approximates mean(). Other sums are allowed: combine({A},
/// {0.5}) is the square root of A. To choose branches, add the logs of log_affine().
Affine combine(std::span<const Affine> maps, std::span<const double> weights);

/// Returns A exp(t log(A^-1 B)) for any t, also outside [0, 1]. At t = 0 the result is exactly A. At t = 1
/// the result is B up to rounding, if A^-1 B has a logarithm. If A has no inverse, the result is not finite.
Affine interpolate(const Affine& a, const Affine& b, double t);
/// Like interpolate() above, but uses the branch of log(A^-1 B) nearest to the rotation vector `near`. `near`
/// may have more than one turn.
Affine interpolate(const Affine& a, const Affine& b, double t, const Vec3<double>& near);

/// The sum of all weights, as `sum` * 2^shift, which avoids overflow and underflow. If the sum of all weights
/// is 0 up to rounding, `sum` is exactly 0.
struct WeightSum {
  int shift;
  double sum;
};
WeightSum sum_of(std::span<const double> weights);

struct AffineMean {
  Affine map;
  bool converged;
};

/// Returns the bi-invariant mean m (V. Arsigny, X. Pennec, N. Ayache, Bi-invariant means in Lie groups,
/// 2006): the sum of weights[i] * log(m^-1 maps[i]) is 0. Requires at least one map, and one weight for each
/// map. Only the ratios of the weights matter. The computation starts at the map with the largest weight or,
/// if the sum of weights is negative, at the map with the smallest weight. It takes at most 200 steps.
/// If the steps do not converge, `converged` is false and `map` is the last iterate. Possible reasons: maps
/// half a turn apart, a map without inverse, or weights whose sum is 0 up to rounding.
AffineMean mean(std::span<const Affine> maps, std::span<const double> weights);

}  // namespace viete::sym3
