#include "sym3/affine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sym3/general.h"
#include "sym3/small_matrices.h"
#include "sym3/translation_log.h"

namespace viete::sym3 {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double pole_width = std::numbers::pi / 3;

// Returns a factor that keeps E bounded: 0 at 360, 720 ... degrees, 1 if these are pole_width or more away.
double kept(double angle) {
  if (angle < full_turn - pole_width) return 1;
  const double t = std::min(std::abs(angle - full_turn * std::round(angle / full_turn)) / pole_width, 1.0);
  return t * t * (3 - 2 * t);
}

double kept(const Mat3<double>& log, const Vec3<double>& turn) {
  return norm(turn) > 3 ? kept(angle_of(log)) : 1;
}

Mat3<double> projector(const Vec3<double>& axis) {
  const Vec3<double> n = times(1 / norm(axis), axis);
  Mat3<double> m;
  for (int i = 0; i < 9; ++i) m[i] = n[i / 3] * n[i % 3];
  return m;
}

// Polynomials p[0] I + p[1] L + p[2] L^2. Products reduce to this form (Cayley-Hamilton).
struct Powers {
  double t1, t2, t3;  // L^3 = t1 L^2 - t2 L + t3 I

  Vec3<double> shifted(const Vec3<double>& p) const {
    return {p[2] * t3, p[0] - p[2] * t2, p[1] + p[2] * t1};
  }

  Vec3<double> times(const Vec3<double>& p, const Vec3<double>& q) const {
    const Vec3<double> once = shifted(q), twice = shifted(once);
    return plus(plus(sym3::times(p[0], q), p[1], once), p[2], twice);
  }
};

// Computes phi(L) = c[0] I + c[1] A + c[2] A^2 with A = L / 2^k and |A| <= 1/2. Then applies
// phi(2 A) = phi(A) + A phi(A)^2 / 2, k times.
struct Phi {
  Mat3<double> a;
  Vec3<double> c;

  explicit Phi(const Mat3<double>& log) {
    constexpr int last = 14;
    const double size = norm(log);
    const int doublings = size > 0.5 ? static_cast<int>(std::min(std::ceil(std::log2(2 * size)), 60.0)) : 0;
    a = times(std::exp2(-doublings), log);
    const double sum = trace(a);
    const Powers powers{sum, (sum * sum - trace(product(a, a))) / 2, determinant(a)};
    double factorial = 1;  // (n + 1)!
    for (int n = 2; n <= last + 1; ++n) factorial *= n;
    c = {1 / factorial, 0, 0};
    for (int n = last - 1; n >= 0; --n) {
      factorial /= n + 2;
      c = powers.shifted(c);
      c[0] += 1 / factorial;
    }
    double half = 0.5;
    for (int k = 0; k < doublings; ++k, half *= 2) c = plus(c, half, powers.shifted(powers.times(c, c)));
  }

  Vec3<double> operator*(const Vec3<double>& x) const {
    const Vec3<double> once = product(a, x);
    return plus(plus(times(c[0], x), c[1], once), c[2], product(a, once));
  }

  std::array<Vec3<double>, 3> rows() const {
    const Mat3<double> m = plus(times(c[1], a), c[2], product(a, a));
    return {{{c[0] + m[0], m[1], m[2]}, {m[3], c[0] + m[4], m[5]}, {m[6], m[7], c[0] + m[8]}}};
  }
};

Mat3<double> by_rows(const std::array<Vec3<double>, 3>& m) {
  return {m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2]};
}

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

Mat3<double> even_part(const Mat3<double>& log, const Vec3<double>& y) {
  const double share = kept(log, y);
  Mat3<double> e{};
  if (share > 1e-9) {
    const Mat3<double> inverse =
        by_rows(solved<3>(by_rows(Phi(log).rows()), {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));
    e = times(share, plus(inverse, 0.5, log));
  }
  return share < 1 ? plus(e, 1 - share, projector(y)) : e;
}

Vec3<double> phi_times(const Mat3<double>& log, const Vec3<double>& x) {
  return Phi(log) * x;
}

Vec3<double> inverse_phi_times(const Mat3<double>& log, const Vec3<double>& turn, const Vec3<double>& x) {
  if (kept(log, turn) < 1) return plus(product(even_part(log, turn), x), -0.5, product(log, x));
  const auto solution = solved<1>(by_rows(Phi(log).rows()), {{{x[0]}, {x[1]}, {x[2]}}});
  const Vec3<double> w{solution[0][0], solution[1][0], solution[2][0]};
  return std::isfinite(w[0] + w[1] + w[2]) ? w : times(-0.5, product(log, x));
}

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
  for (const double w : weights) {
    sum += std::scalbn(w, -shift);
    size += std::abs(std::scalbn(w, -shift));
  }
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
    turned = turns;
    moved = moves;
  }
  return m;
}

}  // namespace viete::sym3
