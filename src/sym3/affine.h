// Transformations by themselves: log, exp, weighted sums, interpolation and means of affine maps.
//
// M. Alexa, Linear combination of transformations (2002): maps are added and multiplied by numbers through
// their logarithms. A linear map (3x3) is one without translation, and stays so exactly. Precision and range
// of log and exp: see general.h and translation_log.h. Maps that have no logarithm are those whose linear
// part has none (has_log() tells): mirrored and flat ones, and those that turn by 180 degrees and stretch
// across. They get a bounded one, which exp does not lead back from. What is not finite gives NaN.
// Thread-safe; no allocation, no throw.
//
// combine() does not ask for the order of maps; of inverses it is the inverse, of C A C^-1 it is C combine
// C^-1: no coordinates are special. interpolate() and mean() go along with maps before and after, too: of C A
// D they are C mean D; and of inverses the inverse.
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

/// The logarithm of one, whose fourth row is 0. These can be added and multiplied by numbers.
struct AffineLog {
  Mat3<double> linear{};
  Vec3<double> translation{};

  friend bool operator==(const AffineLog&, const AffineLog&) = default;
};

/// First b, then a.
Affine operator*(const Affine& a, const Affine& b);
/// By elimination; not finite where the linear part is singular.
Affine inverse(const Affine& a);

/// The principal logarithm: (L, phi(L)^-1 l) of (M, l), L = log_general(M).
AffineLog log_affine(const Affine& map);
/// The logarithm on the branch nearest to a rotation vector, as that of a log before (see turn_of()): L =
/// log_near(M, near). Near turns of 360, 720 ... degrees the translation's log is bounded, too, and not
/// exact.
AffineLog log_affine(const Affine& map, const Vec3<double>& near);

/// (e^L, phi(L) l). Exactly the identity for 0.
Affine exp_affine(const AffineLog& log);

/// What L is but for what is symmetric of it: by how much, and about what axis, exp(L) turns.
Vec3<double> turn_of(const AffineLog& log);

/// sum w L. As many weights as logs; any sum.
AffineLog weighted_sum(std::span<const AffineLog> logs, std::span<const double> weights);

/// exp(sum w log A), principal logarithms. As many weights as maps. With weights that sum to 1 a mean that
/// mean() improves upon; with others a scaled one: combine({A}, {0.5}) is the square root. To choose
/// branches, add logs.
Affine combine(std::span<const Affine> maps, std::span<const double> weights);

/// A exp(t log(A^-1 B)): from A at 0 (exactly) to B at 1, on at a constant rate; any t. Where A^-1 B has no
/// logarithm it does not reach B; where A has no inverse it is not finite.
Affine interpolate(const Affine& a, const Affine& b, double t);
/// With the branch of log(A^-1 B) nearest to a rotation vector: any number of turns on the way.
Affine interpolate(const Affine& a, const Affine& b, double t, const Vec3<double>& near);

struct AffineMean {
  Affine map;
  bool converged;
  int steps;
};

/// The map with sum w log(mean^-1 A) = 0 (V. Arsigny, X. Pennec, N. Ayache, Bi-invariant means in Lie groups,
/// 2006), by steps mean exp(sum w log(mean^-1 A)) from the map that weighs most. Each takes a part of what is
/// left, less the farther the maps are apart: some 15 where they differ by 60 degrees and a factor of 2. At
/// most 200; where these do not end, as may be for maps half a turn apart, where a map has no inverse, and
/// where the weights sum to 0 but for rounding, `converged` is false and the map the last one. Weights are
/// divided by their sum, whatever their size; as many as maps, at least one.
AffineMean mean(std::span<const Affine> maps, std::span<const double> weights);

}  // namespace viete::sym3
