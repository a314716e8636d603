#include "sym3/general.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "sym3/jacobi.h"
#include "sym3/log.h"
#include "sym3/polar.h"
#include "sym3/small_matrices.h"

namespace viete::sym3 {

namespace {

constexpr double pi = std::numbers::pi, u = 0x1p-53;
// The smallest stretch relative to the largest stretch. This value replaces smaller stretches.
constexpr double flattest = 1e-12;
// Limits of |log M| / (|X| + |Y|): bounded_log() is log M up to kept_up_to, and X + Y from left_from on.
constexpr double kept_up_to = 2, left_from = 4;
// If |sin| of a rotation angle is below this value, X + Y replaces log M.
constexpr double least_clear = 1e-7;
// If |L| is above this value, exp_general() tries eigenvalues first, because squarings lose digits.
constexpr double squared_to = 100;

void add_to_diagonal(Mat3<double>& m, double x) {
  for (const int i : {0, 4, 8}) m[i] += x;
}

// M = (base + above) I + D. D has trace zero, and D^3 = p D + q I (Cayley-Hamilton).
struct Deviator {
  double base, above;
  Mat3<double> d;
  double p, q;

  double mean() const { return base + above; }
};

Deviator deviator(Mat3<double> m, double base) {
  add_to_diagonal(m, -base);
  const double above = trace(m) / 3;
  add_to_diagonal(m, -above);
  const double p = (m[0] * m[0] + m[4] * m[4] + m[8] * m[8]) / 2 + m[1] * m[3] + m[2] * m[6] + m[5] * m[7];
  return {base, above, m, p, determinant(m)};
}

// The polynomial a I + b D + c D^2. Every power series of D has this form.
struct InPowers {
  double a, b, c;
};

template <std::size_t N>
InPowers power_series(const std::array<double, N>& terms, double p, double q) {
  InPowers s{};
  for (std::size_t n = N; n-- > 0;) s = {s.c * q + terms[n], s.c * p + s.a, s.b};
  return s;
}

InPowers squared(const InPowers& s, double p, double q) {
  const double bc2 = 2 * s.b * s.c, cc = s.c * s.c;
  return {s.a * s.a + bc2 * q, 2 * s.a * s.b + (bc2 * p + cc * q), s.b * s.b + s.c * (2 * s.a + s.c * p)};
}

Mat3<double> in_matrix(const InPowers& s, const Mat3<double>& d) {
  Mat3<double> m = product(d, d);
  for (int i = 0; i < 9; ++i) m[i] = s.b * d[i] + s.c * m[i];
  add_to_diagonal(m, s.a);
  return m;
}

constexpr auto exp_terms = [] {
  std::array<double, 25> terms{1};
  double factorial = 1;
  for (std::size_t n = 1; n < terms.size(); ++n) terms[n] = 1 / (factorial *= static_cast<double>(n));
  return terms;
}();

constexpr auto log_terms = [] {
  std::array<double, 19> terms{0};
  for (std::size_t n = 1; n < terms.size(); ++n) terms[n] = (n % 2 ? 1.0 : -1.0) / static_cast<double>(n);
  return terms;
}();

// Returns the real root of x^3 = p x + q with the largest absolute value, by Newton's method from above.
double largest_root(double p, double q) {
  const double size = std::abs(q);
  double x = std::cbrt(size) + std::sqrt(std::max(p, 0.0));
  for (int i = 0; i < 8 && x > 0; ++i) x = (2 * x * x * x + size) / (3 * x * x - p);
  return std::copysign(x, q);
}

// Returns true if eigenvalues differ by at most about 13 %. Then the series of log in M / mean - I converges.
bool close_together(const Deviator& v) {
  const double m = v.mean();
  return m > 0 && std::abs(v.p) <= 0.01 * m * m && std::abs(v.q) <= 0.001 * m * m * m;
}

// Computes log M by a series about a power of two, because subtracting it from M has no rounding errors.
Mat3<double> log_of_close(const Mat3<double>& m, double mean) {
  int exponent;
  if (std::frexp(mean, &exponent) < std::numbers::sqrt2 / 2) --exponent;
  Deviator v = deviator(m, std::ldexp(1.0, exponent));
  const double scale = 1 / v.mean();
  for (double& x : v.d) x *= scale;
  Mat3<double> l = in_matrix(power_series(log_terms, v.p * scale * scale, v.q * scale * scale * scale), v.d);
  add_to_diagonal(l, std::log1p(v.above / v.base) + exponent * std::numbers::ln2);
  return l;
}

// M = A T A, where A = `axes` is symmetric and orthogonal. In T, t[3] = t[6] = 0: t[0] is an eigenvalue.
struct Deflated {
  Mat3<double> axes, t;
};

Mat3<double> reflection(const Vec3<double>& v) {
  const double length = norm(v);
  const Vec3<double> n{v[0] + std::copysign(length, v[0]), v[1], v[2]};
  const double factor = -2 / dot(n, n);
  Mat3<double> m{};
  for (int i = 0; i < 9; ++i) m[i] = factor * n[i / 3] * n[i % 3];
  add_to_diagonal(m, 1);
  return m;
}

// Returns an approximate eigenvector for `value`: the longest cross product of two rows of M - value * I.
Vec3<double> eigenvector(Mat3<double> m, double value) {
  add_to_diagonal(m, -value);
  const Vec3<double> rows[] = {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
  Vec3<double> longest{1, 0, 0};
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3<double> v = cross(rows[i], rows[(i + 1) % 3]);
    if (dot(v, v) > most) {
      longest = v;
      most = dot(v, v);
    }
  }
  return longest;
}

// Finds A and T by Newton's method for the first axis, until t[3] and t[6] are zero up to rounding. `value`
// must be close to a well separated eigenvalue. If the steps do not converge, returns nullopt.
std::optional<Deflated> deflated(const Mat3<double>& m, double value) {
  constexpr int most_steps = 8;
  const double rounding = 32 * u * norm(m), surely = rounding / 8;
  double least = std::numeric_limits<double>::infinity();
  Deflated best;
  Vec3<double> v = eigenvector(m, value);
  for (int step = 0; step < most_steps && least > surely; ++step) {
    Deflated d{reflection(v), {}};
    d.t = product(d.axes, product(m, d.axes));
    const Mat3<double>& t = d.t;
    const double left = std::hypot(t[3], t[6]);
    if (!(left < least)) break;
    const bool ends = left <= rounding && left > least / 2;
    least = left;
    best = d;
    if (ends) break;
    const double a = t[4] - t[0], b = t[5], c = t[7], e = t[8] - t[0], det = a * e - b * c;
    v = product(d.axes, Vec3<double>{1, (b * t[6] - e * t[3]) / det, (c * t[3] - a * t[6]) / det});
  }
  if (least > rounding) return std::nullopt;
  best.t[3] = best.t[6] = 0;
  return best;
}

// The eigenvalues of the 2x2 block are middle +- sqrt(disc). Their product is det.
struct Pair {
  double middle, disc, det;

  explicit Pair(const Mat3<double>& t) {
    const double half = (t[4] - t[8]) / 2;
    middle = (t[4] + t[8]) / 2;
    disc = half * half + t[5] * t[7];
    det = turns() ? middle * middle - disc : t[4] * t[8] - t[5] * t[7];
  }

  bool turns() const { return disc < 0; }
  bool positive() const { return turns() || (middle > 0 && det > 0); }
  double angle() const { return turns() ? std::atan2(std::sqrt(-disc), middle) : 0; }
  // Returns false if |sin| of the angle is too small to define the rotation plane.
  bool clear() const { return -disc >= least_clear * least_clear * det; }
};

// The value f(T) of a function f. `single` is f(t[0]). f(B) = mean + slope * (B - middle) for the 2x2 block B
// of T. `difference` is single - mean.
struct Values {
  double single, mean, slope, difference;
};

// Returns (log s - log t) / (s - t) for the eigenvalues s and t of the pair.
double log_slope(const Pair& pair) {
  if (pair.turns()) return pair.angle() / std::sqrt(-pair.disc);
  const double d = std::sqrt(pair.disc), part = d / pair.middle;
  if (part > 0.5) return std::log((pair.middle + d) / std::sqrt(pair.det)) / d;
  return d > 0 ? std::atanh(part) / d : 1 / pair.middle;
}

// Returns f(M) by Newton's form: f(T) = mean + slope * (T - middle) + curve * ((T - middle)^2 - disc).
Mat3<double> value_of(const Values& f, const Deflated& d, const Pair& pair) {
  const Mat3<double>& t = d.t;
  const double offset = t[0] - pair.middle,
               curve = (f.difference - f.slope * offset) / (offset * offset - pair.disc);
  const double x =
      f.slope + curve * (offset - pair.middle);  // the first row is (t[1], t[2]) * (x + curve * B)
  const Mat3<double> value{f.single,
                           x * t[1] + curve * (t[1] * t[4] + t[2] * t[7]),
                           x * t[2] + curve * (t[1] * t[5] + t[2] * t[8]),
                           0,
                           f.mean + f.slope * (t[4] - pair.middle),
                           f.slope * t[5],
                           0,
                           f.slope * t[7],
                           f.mean + f.slope * (t[8] - pair.middle)};
  return product(d.axes, product(value, d.axes));
}

Mat3<double> log_of_apart(const Deflated& d, const Pair& pair) {
  const double r = d.t[0];
  return value_of({std::log(r), std::log(pair.det) / 2, log_slope(pair), std::log(r / pair.det * r) / 2}, d,
                  pair);
}

Mat3<double> exp_of_apart(const Deflated& d, const Pair& pair) {
  const double single = std::exp(d.t[0]), middle = std::exp(pair.middle),
               root = std::sqrt(std::abs(pair.disc));
  double mean, slope;
  if (pair.turns()) {
    mean = middle * std::cos(root);
    slope = middle * std::sin(root) / root;
  } else if (root < 1) {
    mean = middle * std::cosh(root);
    slope = root > 0 ? middle * std::sinh(root) / root : middle;
  } else {
    const double high = std::exp(pair.middle + root), low = std::exp(pair.middle - root);
    mean = (high + low) / 2;
    slope = (high - low) / (2 * root);
  }
  return value_of({single, mean, slope, single - mean}, d, pair);
}

// Computes exp(L) by eigenvalues. If no eigenvalue is well separated, returns nullopt.
std::optional<Mat3<double>> exp_of_apart(const Mat3<double>& l, const Deviator& v) {
  const auto d = deflated(l, v.mean() + largest_root(v.p, v.q));
  if (!d) return std::nullopt;
  return exp_of_apart(*d, Pair(d->t));
}

}  // namespace

double angle_of(const Mat3<double>& l) {
  const Deviator v = deviator(l, 0);
  const double x = largest_root(v.p, v.q);
  return std::sqrt(std::max(0.75 * x * x - v.p, 0.0));
}

Mat3<double> exp_general(const Mat3<double>& l) {
  const Deviator v = deviator(l, 0);
  double p = v.p, q = v.q, scale = 1;
  if (!(std::abs(p) < 1e121 && std::abs(q) < 1e181)) return nine_nan();
  if (std::abs(p) > squared_to * squared_to) {
    if (const auto m = exp_of_apart(l, v)) return *m;
  }
  int squarings = 0;
  for (; std::abs(p) > 2 || std::abs(q) > 4; ++squarings) {
    scale /= 2;
    p /= 4;
    q /= 8;
  }
  InPowers s = power_series(exp_terms, p, q);
  const double factor = std::exp(v.mean() * scale);
  s = {factor * s.a, factor * s.b, factor * s.c};
  for (int i = 0; i < squarings; ++i) s = squared(s, p, q);
  return in_matrix({s.a, s.b * scale, s.c * scale * scale}, v.d);
}

namespace {

// Returns the number of whole turns between the angle of the principal branch and `turn`.
double whole_turns(const Mat3<double>& j, double angle, const Vec3<double>& turn) {
  const Vec3<double> axis{j[7] - j[5], j[2] - j[6], j[3] - j[1]};
  return std::round((dot(axis, turn) / norm(axis) - angle) / (2 * pi));
}

// Returns the logarithm on the branch nearest to the rotation vector `turn`. If `turn` is 0, this is the
// principal logarithm. If M has no logarithm or rounding would decide the branch, returns nullopt.
std::optional<Mat3<double>> log_of_branch(const Mat3<double>& m, const Vec3<double>& turn) {
  constexpr double close_angle = 0.2;  // matrices with close eigenvalues rotate by smaller angles
  const Deviator v = deviator(m, 0);
  const bool close = close_together(v);
  const double turned = norm(turn);
  if (close && turned + close_angle < pi) return log_of_close(m, v.mean());
  const auto d = deflated(m, v.mean() + largest_root(v.p, v.q));
  if (!d) return std::nullopt;
  const Pair pair(d->t);
  const bool other = turned + pair.angle() > pi;  // another branch can be nearer to `turn`
  if (!(d->t[0] > 0) || !pair.positive()) return std::nullopt;
  if ((other || (pair.turns() && pair.middle < 0)) && !pair.clear()) return std::nullopt;
  const Mat3<double> l = close ? log_of_close(m, v.mean()) : log_of_apart(*d, pair);
  if (!other) return l;
  // J rotates the plane of the pair by 90 degrees. Adding 2 pi J adds a whole turn.
  const Mat3<double> j = value_of({0, 0, 1 / std::sqrt(-pair.disc), 0}, *d, pair);
  return plus(l, 2 * pi * whole_turns(j, pair.angle(), turn), j);
}

// `m` is M / e^shift. Powers of the entries of `m` neither overflow nor underflow.
struct InRange {
  Mat3<double> m;
  double shift;
};

// If an entry is not finite, all entries become NaN. M = 0 counts as 2^-1074 I.
InRange in_range(const Mat3<double>& m) {
  double largest = 0;
  for (const double x : m) largest = std::max(largest, std::abs(x) + 0 * x);
  if (largest > 1e-60 && largest < 1e60) return {m, 0};
  if (m == Mat3<double>{}) return {{1, 0, 0, 0, 1, 0, 0, 0, 1}, -1074 * std::numbers::ln2};
  if (!(largest > 0 && largest < std::numeric_limits<double>::infinity())) return {nine_nan(), 0};
  const int exponent = std::ilogb(largest);
  InRange r{m, exponent * std::numbers::ln2};
  for (double& x : r.m) x = std::scalbn(x, -exponent);
  return r;
}

std::optional<Mat3<double>> log_in_range(const Mat3<double>& m, const Vec3<double>& turn) {
  if (m == Mat3<double>{}) return std::nullopt;
  const InRange r = in_range(m);
  auto l = log_of_branch(r.m, turn);
  if (!l || !std::isfinite(dot(*l, *l))) return std::nullopt;
  add_to_diagonal(*l, r.shift);
  return l;
}

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Mat3<double> sum_of(const PolarLog& parts) {
  return plus(full(parts.stretch), 1, cross_matrix(parts.turn));
}

// Returns true if X and Y commute up to rounding. Then X + Y is log M.
bool commute(const PolarLog& parts) {
  const Mat3<double> x = full(parts.stretch), y = cross_matrix(parts.turn);
  return norm(plus(product(x, y), -1, product(y, x))) <= 8 * u * norm(parts.turn) * (1 + norm(x));
}

struct Split {
  PolarLog parts;
  bool whole;  // true if M = exp(Y) exp(X); false if log_of_sizes() replaced a stretch or its sign
};

Sym3<double> log_of_sizes(const Sym3<double>& stretch) {
  const auto e = eigen_by_jacobi<double>(stretch);
  double largest = 0;
  for (const double s : e.values) largest = std::max(largest, std::abs(s));
  return recompose([&](double s) { return std::log(std::max(std::abs(s), flattest * largest)); }, e);
}

Split split(const Mat3<double>& m, const Vec3<double>& near) {
  const InRange r = in_range(m);
  const Polar<double> p = polar(r.m);
  const Vec3<double> turn = log_rotation(p.rotation);
  // If `near` is 0, both directions of a half turn are equally near; log_rotation() chooses the direction.
  Split s{{log(p.stretch), norm(near) > 0 ? nearest_branch(turn, near) : turn}, true};
  Mat3<double> across = full(s.parts.stretch);
  add_to_diagonal(across, -trace(across) / 3);
  s.whole = norm(across) < -std::log(flattest) / std::numbers::sqrt2 && m != Mat3<double>{};  // false for NaN
  Sym3<double>& x = s.parts.stretch;
  if (!s.whole) x = log_of_sizes(p.stretch);
  x.xx += r.shift;
  x.yy += r.shift;
  x.zz += r.shift;
  return s;
}

bool is_sum(const Split& s) {
  return s.whole && commute(s.parts);
}

// log M if M has a logarithm, otherwise X + Y.
struct Answer {
  Mat3<double> log;
  bool is_log;
};

// If |log M| < 3, M rotates by less than 122 degrees and is not flat. Then the logarithm is reliable.
Answer principal_log(const Mat3<double>& m) {
  constexpr double is_short = 3;
  const bool symmetric = m[1] == m[3] && m[2] == m[6] && m[5] == m[7];
  const auto l = symmetric ? std::nullopt : log_in_range(m, {});
  if (l && norm(*l) < is_short) return {*l, true};
  const Split s = split(m, {});
  const bool sum = is_sum(s) || !s.whole || !l;
  return {sum ? sum_of(s.parts) : *l, !sum || is_sum(s)};
}

}  // namespace

// With v = angle * n and |n| = 1, the branches are (angle + 2 pi k) * n. The branch nearest to the reference
// has k = round((dot(n, reference) - angle) / (2 pi)). If v is nearly 0, rounding errors decide n. In this
// case, if the reference is longer than pi, its axis replaces n.
Vec3<double> nearest_branch(const Vec3<double>& v, const Vec3<double>& reference) {
  // If v is at most this far from the axis of the reference, the distance counts as a rounding error.
  constexpr double along_reference = 1e-13;
  const double angle = norm(v);
  if (dot(reference, reference) > pi * pi) {
    const double length = norm(reference);
    const Vec3<double> axis = times(1 / length, reference);
    const double along = dot(v, axis);
    if (norm(plus(v, -1, times(along, axis))) <= along_reference) {
      return times(along + 2 * pi * std::round((length - along) / (2 * pi)), axis);
    }
  }
  if (angle == 0) return v;
  const double gap = dot(reference, v) / angle - angle;
  if (std::abs(gap) < pi) return v;
  return times((angle + 2 * pi * std::round(gap / (2 * pi))) / angle, v);
}

PolarLog log_polar(const Mat3<double>& m, const Vec3<double>& near) {
  return split(m, near).parts;
}

Mat3<double> log_general(const Mat3<double>& m) {
  return principal_log(m).log;
}

bool has_log(const Mat3<double>& m) {
  return principal_log(m).is_log;
}

Mat3<double> bounded_log(const Mat3<double>& m, const PolarLog& parts) {
  const double size = norm(full(parts.stretch)) + norm(cross_matrix(parts.turn));
  if (size == 0) return {};
  const Mat3<double> sum = sum_of(parts);
  const auto l = log_in_range(m, parts.turn);
  if (!l) return sum;
  const double left = smooth_step((norm(*l) / size - kept_up_to) / (left_from - kept_up_to));
  return plus(*l, left, plus(sum, -1, *l));
}

Mat3<double> log_near(const Mat3<double>& m, const Vec3<double>& near) {
  const Split s = split(m, near);
  return is_sum(s) ? sum_of(s.parts) : bounded_log(m, s.parts);
}

}  // namespace viete::sym3
