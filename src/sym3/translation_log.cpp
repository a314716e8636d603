#include "sym3/translation_log.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sym3/general.h"
#include "sym3/small_matrices.h"

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

}  // namespace viete::sym3
