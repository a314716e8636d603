#include "sym3/affine.h"

#include <algorithm>
#include <cmath>

#include "sym3/general.h"
#include "sym3/small_matrices.h"
#include "sym3/translation_log.h"

namespace viete::sym3 {

namespace {

// Returns A^-1 B.
Affine from(const Affine& a, const Affine& b) {
  std::array<std::array<double, 4>, 3> rows;
  for (std::size_t r = 0; r < 3; ++r) {
    rows[r] = {b.linear[3 * r], b.linear[3 * r + 1], b.linear[3 * r + 2],
               b.translation[r] - a.translation[r]};
  }
  const auto x = solved<4>(a.linear, rows);
  Affine map;
  for (std::size_t r = 0; r < 3; ++r) {
    std::copy_n(x[r].begin(), 3, map.linear.begin() + 3 * r);
    map.translation[r] = x[r][3];
  }
  return map;
}

AffineLog added(const AffineLog& a, double s, const AffineLog& b) {
  return {plus(a.linear, s, b.linear), plus(a.translation, s, b.translation)};
}

// Returns the binary exponent of the largest absolute weight. If this weight is 0 or not finite, returns 0.
int exponent_of(std::span<const double> weights) {
  double largest = 0;
  for (const double w : weights) largest = std::max(largest, std::abs(w));
  return largest > 0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
}

// Returns the sum of weights[i] * 2^-shift * log_of(i).
template <class LogOf>
AffineLog scaled_sum(std::span<const double> weights, int shift, const LogOf& log_of) {
  AffineLog sum;
  for (std::size_t i = 0; i < weights.size(); ++i)
    sum = added(sum, std::scalbn(weights[i], -shift), log_of(i));
  return sum;
}

bool is_finite(const AffineLog& log) {
  const auto finite = [](double x) { return std::isfinite(x); };
  return std::ranges::all_of(log.linear, finite) && std::ranges::all_of(log.translation, finite);
}

// Returns the sum of weights[i] * log_of(i). If a term overflows, adds all terms again at a smaller scale.
template <class LogOf>
AffineLog sum_of_terms(std::span<const double> weights, const LogOf& log_of) {
  constexpr int room = 64;  // bits of reserve, so that a sum of many scaled terms does not overflow
  AffineLog sum = scaled_sum(weights, 0, log_of);
  if (is_finite(sum)) return sum;
  const int shift = std::max(exponent_of(weights), 0) + room;
  sum = scaled_sum(weights, shift, log_of);
  for (double& x : sum.linear) x = std::scalbn(x, shift);
  for (double& x : sum.translation) x = std::scalbn(x, shift);
  return sum;
}

}  // namespace

Affine operator*(const Affine& a, const Affine& b) {
  return {product(a.linear, b.linear), plus(product(a.linear, b.translation), 1, a.translation)};
}

Affine inverse(const Affine& a) {
  return from(a, {});
}

AffineLog log_affine(const Affine& map) {
  const Mat3<double> l = log_general(map.linear);
  return {l, inverse_phi_times(l, {}, map.translation)};
}

AffineLog log_affine(const Affine& map, const Vec3<double>& near) {
  const Mat3<double> l = log_near(map.linear, near);
  return {l, inverse_phi_times(l, turn_of({l, {}}), map.translation)};
}

Affine exp_affine(const AffineLog& log) {
  return {exp_general(log.linear), phi_times(log.linear, log.translation)};
}

Vec3<double> turn_of(const AffineLog& log) {
  const Mat3<double>& l = log.linear;
  return {(l[7] - l[5]) / 2, (l[2] - l[6]) / 2, (l[3] - l[1]) / 2};
}

Affine combine(std::span<const Affine> maps, std::span<const double> weights) {
  return exp_affine(sum_of_terms(weights, [&](std::size_t i) { return log_affine(from({}, maps[i])); }));
}

Affine interpolate(const Affine& a, const Affine& b, double t) {
  return a * exp_affine(added({}, t, log_affine(from(a, b))));
}

Affine interpolate(const Affine& a, const Affine& b, double t, const Vec3<double>& near) {
  return a * exp_affine(added({}, t, log_affine(from(a, b), near)));
}

WeightSum sum_of(std::span<const double> weights) {
  const int shift = exponent_of(weights);
  double sum = 0, size = 0;
  for (const double w : weights) sum += std::scalbn(w, -shift), size += std::abs(std::scalbn(w, -shift));
  const bool is_rounding = std::abs(sum) <= 0x1p-53 * static_cast<double>(weights.size()) * size;
  return {shift, is_rounding ? 0 : sum};
}

AffineMean mean(std::span<const Affine> maps, std::span<const double> weights) {
  constexpr int most_steps = 200;
  // If the linear part of a step is below this value, a step that does not decrease is a rounding error.
  constexpr double near_the_end = 1e-6;
  const auto [shift, total] = sum_of(weights);
  const auto [least, most] = std::ranges::minmax_element(weights);
  AffineMean m{maps[(total < 0 ? least : most) - weights.begin()], false};
  double turned = HUGE_VAL, moved = HUGE_VAL;
  bool turned_enough = false, moved_enough = false;
  for (int steps = 0; !m.converged && steps < most_steps && total != 0; ++steps) {
    const auto log_of = [&](std::size_t i) { return log_affine(from(m.map, maps[i])); };
    const AffineLog step = added({}, 1 / total, scaled_sum(weights, shift, log_of));
    const double turns = norm(step.linear), moves = norm(step.translation);
    if (!std::isfinite(turns + moves)) break;
    turned_enough |= turns < near_the_end && turns >= turned;
    moved_enough |= turns < near_the_end && moves >= moved;
    m.converged = turned_enough && moved_enough;
    m.map = m.map * exp_affine(step);
    turned = turns, moved = moves;
  }
  return m;
}

}  // namespace viete::sym3
