// Logarithm, exponential, weighted sums, interpolation and means of affine maps.
//
// M. Alexa, Linear combination of transformations (2002): maps are added and scaled through their logarithms.
// A linear map (3x3) is an affine map without translation, and stays so exactly. Precision and range of log
// and exp: see general.h and translation_log.h. Maps have no logarithm if their linear part has none (see
// has_log()): mirrored and flat maps, and maps that rotate by 180 degrees and stretch perpendicular to the
// axis. These get a bounded logarithm that exp does not invert. Input that is not finite gives NaN.
// Thread-safe; no allocation, no throw.
//
// combine() does not depend on the order of maps and commutes with inversion and conjugation: inverse maps
// give the inverse, and maps C A C^-1 give C combine() C^-1, whatever the coordinates. interpolate() and
// mean() are also bi-invariant: maps C A D give C mean() D, and inverse maps give the inverse.
#pragma once

#include <span>

#include "sym3/rotation.h"

namespace viete::sym3 {

/// x' = linear x + translation: the upper three rows of a 4x4 matrix.
struct Affine {
  Mat3<double> linear{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3<double> translation{};

  friend bool operator==(const Affine&, const Affine&) = default;
};

/// The logarithm of an affine map, with fourth row 0. Logarithms can be added and scaled.
struct AffineLog {
  Mat3<double> linear{};
  Vec3<double> translation{};

  friend bool operator==(const AffineLog&, const AffineLog&) = default;
};

/// The composition: first b, then a.
Affine operator*(const Affine& a, const Affine& b);
/// The inverse, by elimination; not finite if the linear part is singular.
Affine inverse(const Affine& a);

/// The principal logarithm: (L, phi(L)^-1 l) of (M, l), L = log_general(M).
AffineLog log_affine(const Affine& map);
/// The logarithm on the branch nearest to a rotation vector, for example that of an earlier log (see
/// turn_of()): L = log_near(M, near). Near turns of 360, 720 ... degrees the log of the translation is
/// bounded and approximate.
AffineLog log_affine(const Affine& map, const Vec3<double>& near);

/// The exponential: (e^L, phi(L) l). Exactly the identity for 0.
Affine exp_affine(const AffineLog& log);

/// The antisymmetric part of L as a rotation vector: the axis and angle by which exp(L) rotates.
Vec3<double> turn_of(const AffineLog& log);

/// sum w L. logs.size() == weights.size(); weights may have any sum.
AffineLog weighted_sum(std::span<const AffineLog> logs, std::span<const double> weights);

/// exp(sum w log A), principal logarithms. One weight per map. If weights sum to 1 this approximates
/// mean(); otherwise a scaled mean: combine({A}, {0.5}) is the square root. To choose branches, add logs.
Affine combine(std::span<const Affine> maps, std::span<const double> weights);

/// A exp(t log(A^-1 B)): exactly A at t = 0, B at t = 1, with constant rate; any t. Does not reach B if A^-1
/// B has no logarithm; not finite if A has no inverse.
Affine interpolate(const Affine& a, const Affine& b, double t);
/// As above, with the branch of log(A^-1 B) nearest to a rotation vector: any number of turns.
Affine interpolate(const Affine& a, const Affine& b, double t, const Vec3<double>& near);

/// The sum of weights times 2^-shift, which neither overflows nor underflows; 0 if it is 0 up to rounding.
struct WeightSum {
  int shift;
  double sum;
};
WeightSum sum_of(std::span<const double> weights);

struct AffineMean {
  Affine map;
  bool converged;
};

/// The map with sum w log(mean^-1 A) = 0 (V. Arsigny, X. Pennec, N. Ayache, Bi-invariant means in Lie groups,
/// 2006), by at most 200 steps mean exp(sum w log(mean^-1 A)) from the map with the largest weight. Weights
/// are divided by their sum; one per map, at least one. `converged` is false, and the map is the last
/// iterate, if steps do not converge (possible for maps half a turn apart), a map has no inverse, or the
/// weights sum to 0 up to rounding.
AffineMean mean(std::span<const Affine> maps, std::span<const double> weights);

}  // namespace viete::sym3
