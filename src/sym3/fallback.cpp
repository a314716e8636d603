#include "sym3/fallback.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sym3/jacobi.h"
#include "sym3/small_matrices.h"

namespace viete::sym3 {

namespace {

// Exponents are clamped to this size: e^2800 times any positive double is infinite, and e^-2800 times any
// double is 0. times_exp() multiplies four times by at most e^(2800 / 4), which does not overflow.
constexpr double exponent_limit = 2800;

// If an entry is above large_entry, the matrix is multiplied by `down`, so that nothing overflows.
constexpr double large_entry = 1e270, down = 0x1p-64;

/// The eigenvalues of S are eigen.values / scale. exponent() clamps quotients that overflow.
struct Exponents {
  Eigen3<DoubleDouble> eigen;
  double scale;
};

DoubleDouble exponent(const DoubleDouble& value, double scale) {
  const DoubleDouble x = scaled(value, 1 / scale);
  return std::fabs(x.hi) <= exponent_limit ? x : DoubleDouble{std::copysign(exponent_limit, x.hi), 0};
}

double exp_of(const DoubleDouble& x) {
  return std::exp(x.hi) * (1 + x.lo);
}

/// Returns x * e^y. Multiplies by four factors, because e^y as one factor may overflow.
double times_exp(double x, const DoubleDouble& y) {
  const double part = std::exp(y.hi / 4);
  for (int k = 0; k < 4; ++k) x *= part;
  return x * (1 + y.lo);
}

/// Returns entry (i, j) of V exp(values) V^T. The largest exponential is a common factor, so that only the
/// result can overflow. Skips terms that are 0: 0 times an infinite exponential would be NaN.
double entry(const Exponents& e, int i, int j) {
  const auto& [values, vectors] = e.eigen;
  double weight[3];
  int top = -1;
  for (int k = 0; k < 3; ++k) {
    weight[k] = vectors[i][k].hi * vectors[j][k].hi;
    if (weight[k] != 0 && (top < 0 || values[k].hi > values[top].hi)) top = k;
  }
  if (top < 0) return 0;
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (weight[k] != 0) sum += weight[k] * exp_of(exponent(values[k] - values[top], e.scale));
  }
  return times_exp(sum, exponent(values[top], e.scale));
}

Exponents exponents_of(const Sym3<double>& s) {
  const double scale = largest_entry(s) > large_entry ? down : 1;
  return {eigen_by_jacobi<DoubleDouble>(times(s, scale)), scale};
}

Sym3<double> exp_in_double(const Sym3<double>& s) {
  if (!is_finite(s)) return nan_matrix<double>();
  if (is_diagonal(s)) return {std::exp(s.xx), 0, 0, std::exp(s.yy), 0, std::exp(s.zz)};
  const Exponents e = exponents_of(s);
  return {entry(e, 0, 0), entry(e, 0, 1), entry(e, 0, 2), entry(e, 1, 1), entry(e, 1, 2), entry(e, 2, 2)};
}

/// The row (first_of) and the column (second_of) of each entry of Sym3.
constexpr int first_of[] = {0, 0, 0, 1, 1, 2}, second_of[] = {0, 1, 2, 1, 2, 2};

/// Returns the slope (e^x - e^y) / (x - y) relative to max(e^x, e^y). `distance` is |x - y|.
double relative_slope(double distance) {
  return distance > 0 ? -std::expm1(-distance) / distance : 1;
}

/// Returns entry (i, j) of exp'(S)[E]. `direction` is E in the axes `v`. The entry is a sum over all pairs of
/// axes. Each term has the factor slope * component of E.
double slope_entry(const Exponents& e, const Axes& v, const double (&direction)[6], int i, int j) {
  const auto& values = e.eigen.values;
  double weight[6];
  int larger[6], top = -1;
  for (int n = 0; n < 6; ++n) {
    const int k = first_of[n], l = second_of[n];
    larger[n] = values[k].hi > values[l].hi ? k : l;
    weight[n] = direction[n] * (k == l ? v[i][k] * v[j][k] : v[i][k] * v[j][l] + v[i][l] * v[j][k]);
    if (weight[n] != 0 && (top < 0 || values[larger[n]].hi > values[top].hi)) top = larger[n];
  }
  if (top < 0) return 0;
  double sum = 0;
  for (int n = 0; n < 6; ++n) {
    if (weight[n] == 0) continue;
    const double distance = std::fabs((values[first_of[n]] - values[second_of[n]]).hi / e.scale);
    sum += weight[n] * relative_slope(distance) * exp_of(exponent(values[larger[n]] - values[top], e.scale));
  }
  return times_exp(sum, exponent(values[top], e.scale));
}

Sym3<double> derivative_in_double(const Sym3<double>& s, const Sym3<double>& direction) {
  if (!is_finite(s) || !is_finite(direction)) return nan_matrix<double>();
  if (largest_entry(direction) > large_entry)
    return times(derivative_in_double(s, times(direction, down)), 1 / down);
  const Exponents e = exponents_of(s);
  const Axes v = axes_of(e.eigen);
  const auto [xx, xy, xz, yy, yz, zz] = in_axes(v, direction);
  const double parts[6] = {xx, xy, xz, yy, yz, zz};
  const auto at = [&](int i, int j) { return slope_entry(e, v, parts, i, j); };
  return {at(0, 0), at(0, 1), at(0, 2), at(1, 1), at(1, 2), at(2, 2)};
}

// Computes the nearest rotation by Horn's quaternion (Closed-form solution of absolute orientation using unit
// quaternions, 1987) and a Newton step.

constexpr int n = 4;
constexpr int most_sweeps = 12;  // usually five or six are enough

using Matrix4 = std::array<std::array<double, n>, n>;

/// Horn's matrix H: q^T H q = tr(R^T M) for the rotation R of a unit quaternion q = (w, x, y, z).
Matrix4 horn(const std::array<double, 9>& m) {
  const auto [xx, xy, xz, yx, yy, yz, zx, zy, zz] = m;
  return {{{xx + yy + zz, zy - yz, xz - zx, yx - xy},
           {zy - yz, xx - yy - zz, xy + yx, xz + zx},
           {xz - zx, xy + yx, yy - xx - zz, yz + zy},
           {yx - xy, xz + zx, yz + zy, zz - xx - yy}}};
}

void rotate(Matrix4& a, Matrix4& v, int p, int q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]), root = std::sqrt(1 + theta * theta);
  const double t = 1 / (theta < 0 ? theta - root : theta + root), c = 1 / std::sqrt(1 + t * t), s = t * c;
  const auto turn = [c, s](double& x, double& y) {
    const double old = x;
    x = c * old - s * y;
    y = s * old + c * y;
  };
  for (auto& row : a) turn(row[p], row[q]);
  for (int k = 0; k < n; ++k) turn(a[p][k], a[q][k]);
  for (auto& row : v) turn(row[p], row[q]);
}

double off_diagonal(const Matrix4& a) {
  double sum = 0;
  for (int p = 0; p < n; ++p) {
    for (int q = p + 1; q < n; ++q) sum += std::fabs(a[p][q]);
  }
  return sum;
}

std::array<double, n> top_vector(Matrix4 a) {
  Matrix4 v = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  for (int sweep = 0; sweep < most_sweeps && off_diagonal(a) > 1e-20; ++sweep)
    for (int p = 0; p < n; ++p) {
      for (int q = p + 1; q < n; ++q) rotate(a, v, p, q);
    }
  int top = 0;
  for (int k = 1; k < n; ++k) {
    if (a[k][k] > a[top][top]) top = k;
  }
  return {v[0][top], v[1][top], v[2][top], v[3][top]};
}

std::array<double, 9> normalized(const std::array<double, 9>& m) {
  double largest = 0;
  for (const double x : m) largest = std::max(largest, std::fabs(x));
  if (largest == 0) return m;
  const int exponent = -std::ilogb(largest);
  std::array<double, 9> out;
  for (int k = 0; k < 9; ++k) out[k] = std::scalbn(m[k], exponent);
  return out;
}

/// Returns entry (i, j) minus entry (j, i) of R^T M, added in double-double.
double asymmetry(const std::array<double, 9>& r, const std::array<double, 9>& m, int i, int j) {
  DoubleDouble sum;
  for (int k = 0; k < 9; k += 3) {
    sum = sum + two_product(r[k + i], m[k + j]) + two_product(-r[k + j], m[k + i]);
  }
  return sum.hi;
}

/// Takes a Newton step to make U = R^T M symmetric. A rotation by a small vector w changes the asymmetry by
/// (tr(U) I - U) w.
std::array<double, n> refined(const std::array<double, n>& q, const std::array<double, 9>& m) {
  const auto r = rotation_of_quaternion(q);
  const auto dot = [&](int i, int j) { return r[i] * m[j] + r[3 + i] * m[3 + j] + r[6 + i] * m[6 + j]; };
  const double xx = dot(1, 1) + dot(2, 2), yy = dot(0, 0) + dot(2, 2), zz = dot(0, 0) + dot(1, 1);
  const double xy = -(dot(0, 1) + dot(1, 0)) / 2, xz = -(dot(0, 2) + dot(2, 0)) / 2,
               yz = -(dot(1, 2) + dot(2, 1)) / 2;
  const double cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
  const double cyy = xx * zz - xz * xz, cyz = xy * xz - xx * yz, czz = xx * yy - xy * xy;
  const double det = xx * cxx + xy * cxy + xz * cxz;
  if (!(det > 1e-30)) return q;  // the nearest rotation is not unique
  const double a = asymmetry(r, m, 1, 2), b = asymmetry(r, m, 2, 0), c = asymmetry(r, m, 0, 1);
  const double x = -(cxx * a + cxy * b + cxz * c) / det / 2, y = -(cxy * a + cyy * b + cyz * c) / det / 2,
               z = -(cxz * a + cyz * b + czz * c) / det / 2;
  if (!(x * x + y * y + z * z < 1e-6)) return q;
  return {q[0] - (q[1] * x + q[2] * y + q[3] * z), q[1] + (q[0] * x + q[2] * z - q[3] * y),
          q[2] + (q[0] * y + q[3] * x - q[1] * z), q[3] + (q[0] * z + q[1] * y - q[2] * x)};
}

std::array<double, 9> nearest_rotation(const std::array<double, 9>& m) {
  double finite = 0;
  for (const double x : m) finite += x * 0;
  if (finite != 0) return nine_nan();
  const auto scaled = normalized(m);
  return rotation_of_quaternion(refined(top_vector(horn(scaled)), scaled));
}

// Jacobi's method in double has errors relative to the largest eigenvalue. If the largest entry is more than
// `wide` times the smallest eigenvalue, the functions repeat the method in double-double.
constexpr double wide = 8;

struct LogOf {
  double operator()(double x) const { return std::log(x); }
  double operator()(const DoubleDouble& x) const { return std::log(x.hi) + x.lo / x.hi; }
};

template <class Real>
double smallest(const Eigen3<Real>& e) {
  return std::min({jacobi::leading(e.values[0]), jacobi::leading(e.values[1]), jacobi::leading(e.values[2])});
}

/// Returns a power of two. If S is multiplied by this power, Jacobi's method neither overflows nor
/// underflows.
double comfortable_scale(const Sym3<double>& s) {
  const double largest = largest_entry(s);
  if (is_diagonal(s)) return 1;
  return largest > 1e250 ? 0x1p-512 : largest < 1e-150 ? 0x1p512 : 1;
}

template <class Real>
Eigen3<Real> eigen_of(const Sym3<double>& s, double scale) {
  auto e = eigen_by_jacobi<Real>(times(s, scale));
  for (Real& x : e.values) x = x * Real{1 / scale};
  return e;
}

/// Returns f(S) if all eigenvalues of S are above `least` times the largest entry, otherwise NaN.
template <class F>
Sym3<double> of_spectrum_above(double least, const F& f, const Sym3<double>& s) {
  const double scale = comfortable_scale(s), bound = least * largest_entry(s);
  const auto quick = eigen_of<double>(s, scale);
  const double low = smallest(quick);
  if (is_diagonal(s)) return low > bound ? recompose(f, quick) : nan_matrix<double>();
  if (low * wide >= largest_entry(s)) return recompose(f, quick);
  const auto exact = eigen_of<DoubleDouble>(s, scale);
  return smallest(exact) > bound ? recompose(f, exact) : nan_matrix<double>();
}

/// Returns true if S is so close to I that S - I is exact. Then log1p of the eigenvalues of S - I is more
/// accurate than log of the eigenvalues of S.
bool is_near_identity(const Sym3<double>& s) {
  const double off = std::max({std::fabs(s.xy), std::fabs(s.xz), std::fabs(s.yz)});
  const auto [low, high] = std::minmax({s.xx, s.yy, s.zz});
  return low >= 0.75 && high <= 1.5 && off <= 0.2;
}

bool is_usable(const Sym3<double>& s) {
  return is_finite(s) && largest_entry(s) > 0;
}

Sym3<double> log_in_double(const Sym3<double>& s) {
  if (!is_usable(s)) return nan_matrix<double>();
  if (has_huge_eigenvalues(s)) return log_of_256_times(log_in_double(times(s, 0x1p-8)));
  if (is_near_identity(s)) {
    return recompose([](double x) { return std::log1p(x); },
                     eigen_by_jacobi<double>({s.xx - 1, s.xy, s.xz, s.yy - 1, s.yz, s.zz - 1}));
  }
  return of_spectrum_above(0, LogOf(), s);
}

Sym3<double> inv_sqrt_in_double(const Sym3<double>& s) {
  if (!is_usable(s)) return nan_matrix<double>();
  if (has_huge_eigenvalues(s)) return times(inv_sqrt_in_double(times(s, 0x1p-8)), 0x1p-4);
  return of_spectrum_above(
      0, [](const auto& x) { return 1 / std::sqrt(jacobi::leading(x)); }, s);
}

/// Negative eigenvalues above this number * largest entry are rounding errors. sqrt uses 0 instead.
template <class T>
constexpr double rounding = -8 * static_cast<double>(std::numeric_limits<T>::epsilon());

template <class T>
Sym3<double> sqrt_in_double(const Sym3<double>& s) {
  if (!is_finite(s)) return nan_matrix<double>();
  if (has_huge_eigenvalues(s)) return times(sqrt_in_double<T>(times(s, 0x1p-8)), 0x1p4);
  const auto sqrt = [](const auto& x) { return std::sqrt(std::max(jacobi::leading(x), 0.0)); };
  return largest_entry(s) > 0 ? of_spectrum_above(rounding<T>, sqrt, s) : Sym3<double>{};
}

/// The columns of a matrix.
using Columns3 = std::array<Vec3<double>, 3>;

Vec3<double> with_positive_largest(const Vec3<double>& u) {
  return times(*std::ranges::max_element(u, {}, [](double x) { return std::fabs(x); }) < 0 ? -1 : 1, u);
}

std::array<double, 12> eigensystem_in_double(const Sym3<double>& s) {
  std::array<double, 12> system;
  system.fill(std::numeric_limits<double>::quiet_NaN());
  if (!is_finite(s)) return system;
  const double scale = comfortable_scale(s);
  const auto [values, vectors] = eigen_by_jacobi<double>(times(s, scale));
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  Columns3 columns;
  for (std::size_t k = 0; k < 3; ++k) {
    system[k] = values[order[k]] / scale;
    for (std::size_t i = 0; i < 3; ++i) columns[k][i] = vectors[i][order[k]];
  }
  for (const std::size_t k : {1, 2}) columns[k] = with_positive_largest(columns[k]);
  columns[0] = cross(columns[1], columns[2]);
  for (std::size_t i = 0; i < 9; ++i) system[3 + i] = columns[i % 3][i / 3];
  return system;
}

double length(const Vec3<double>& u) {
  return std::hypot(u[0], u[1], u[2]);
}

/// Returns u / |u|, also if 1 / |u| would overflow; 0 for 0.
Vec3<double> unit(const Vec3<double>& u) {
  const double size = length(u);
  return size > 0 ? Vec3<double>{u[0] / size, u[1] / size, u[2] / size} : u;
}

/// Makes two columns of W orthogonal, and rotates V equally. Returns false if the columns are orthogonal.
/// Uses only ratios of lengths, so that squares of short columns do not underflow.
bool make_orthogonal(Vec3<double>& wp, Vec3<double>& wq, Vec3<double>& vp, Vec3<double>& vq) {
  const double p = length(wp), q = length(wq);
  if (p == 0 || q == 0) return false;
  const double cosine = dot(unit(wp), unit(wq));
  if (!(std::fabs(cosine) > 0x1p-52)) return false;
  const double zeta = (q / p - p / q) / (2 * cosine), size = std::fabs(zeta);
  const double t = std::copysign(size > 1e8 ? 0.5 / size : 1 / (size + std::sqrt(1 + size * size)), zeta);
  const double c = 1 / std::sqrt(1 + t * t), s = c * t;
  const auto turn = [&](Vec3<double>& a, Vec3<double>& b) {
    const Vec3<double> old = a;
    a = plus(times(c, a), -s, b);
    b = plus(times(c, b), s, old);
  };
  turn(wp, wq);
  turn(vp, vq);
  return true;
}

/// Returns a unit vector orthogonal to the unit vector `n`: the given direction if it is orthogonal, or else
/// any.
Vec3<double> orthogonal_to(const Vec3<double>& n, const Vec3<double>& direction) {
  const Vec3<double> rest = plus(direction, -dot(direction, n), n);
  if (norm(rest) > 0.5) return unit(rest);
  const auto least = std::ranges::min_element(n, {}, [](double x) { return std::fabs(x); });
  Vec3<double> axis{};
  axis[least - n.begin()] = 1;
  return unit(plus(axis, -*least, n));
}

/// Returns U, the singular values and V for M V = W, where W has orthogonal columns.
std::array<double, 21> singular_system(Columns3 w, Columns3 v, double scale) {
  for (const auto& [p, q] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
    if (!(length(w[q]) > length(w[p]))) continue;
    w[p] = times(-1, std::exchange(w[q], w[p]));
    v[p] = times(-1, std::exchange(v[q], v[p]));
  }
  for (std::size_t k = 0; k < 2; ++k) {
    if (with_positive_largest(v[k]) == v[k]) continue;
    for (Columns3* m : {&w, &v})
      for (const std::size_t i : {k, std::size_t{2}}) (*m)[i] = times(-1, (*m)[i]);
  }
  Columns3 u{unit(w[0])};
  if (length(w[0]) == 0) u[0] = {1, 0, 0};
  u[1] = orthogonal_to(u[0], unit(w[1]));
  u[2] = cross(u[0], u[1]);
  std::array<double, 21> system;
  for (std::size_t k = 0; k < 3; ++k) {
    const double last = std::copysign(std::min(length(w[1]), length(w[2])), dot(w[2], u[2]));
    system[9 + k] = (k < 2 ? length(w[k]) : last) * scale;
    for (std::size_t i = 0; i < 3; ++i) {
      system[3 * i + k] = u[k][i];
      system[12 + 3 * i + k] = v[k][i];
    }
  }
  return system;
}

std::array<double, 21> singular_system_in_double(const std::array<double, 9>& m) {
  constexpr int most_rounds = 40;
  double size = 0, finite = 0;
  for (const double x : m) {
    size = std::max(size, std::fabs(x));
    finite += x * 0;
  }
  if (finite != 0) {
    std::array<double, 21> nan;
    nan.fill(std::numeric_limits<double>::quiet_NaN());
    return nan;
  }
  const auto scaled = normalized(m);
  Columns3 w, v{Vec3<double>{1, 0, 0}, Vec3<double>{0, 1, 0}, Vec3<double>{0, 0, 1}};
  for (std::size_t i = 0; i < 9; ++i) w[i % 3][i / 3] = scaled[i];
  bool turned = true;
  for (int round = 0; round < most_rounds && turned; ++round) {
    turned = false;
    for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
      turned |= make_orthogonal(w[p], w[q], v[p], v[q]);
  }
  return singular_system(w, v, size > 0 ? std::scalbn(1.0, std::ilogb(size)) : 1);
}

/// Computes (f(x) - f(y)) / (x - y) for positive x >= y, or f'(x) if x = y.
struct SlopeOf {
  Of f;
  double p;

  double operator()(const DoubleDouble& x, const DoubleDouble& y) const {
    const double distance = (x - y).hi;
    if (f == Of::sqrt) return 1 / (std::sqrt(x.hi) + std::sqrt(y.hi));
    const double of_log = distance > 0 ? std::log1p(distance / y.hi) / distance : 1 / y.hi;
    if (f == Of::log) return of_log;
    const double t = p * of_log * distance;  // p log(x / y)
    const double of_exp = t != 0 ? -std::expm1(-std::fabs(t)) / std::fabs(t) : 1;
    return p * of_log * std::pow(t > 0 ? x.hi : y.hi, p) * of_exp;
  }
};

/// Returns the exponent h with f(256 S) = 256^h f(S), up to an added constant.
double homogeneity(const SlopeOf& slope) {
  return slope.f == Of::pow ? slope.p : slope.f == Of::sqrt ? 0.5 : 0;
}

Sym3<double> derivative_by_slopes(const SlopeOf& slope, const Sym3<double>& s,
                                  const Sym3<double>& direction) {
  if (!is_usable(s) || !is_finite(direction)) return nan_matrix<double>();
  if (has_huge_eigenvalues(direction)) {
    return times(derivative_by_slopes(slope, s, times(direction, 0x1p-8)), 0x1p8);
  }
  if (has_huge_eigenvalues(s)) {
    return times(derivative_by_slopes(slope, times(s, 0x1p-8), direction),
                 std::exp2(8 * (homogeneity(slope) - 1)));
  }
  const auto e = eigen_of<DoubleDouble>(s, comfortable_scale(s));
  if (!(smallest(e) > 0)) return nan_matrix<double>();
  const auto between = [&](int k, int l) {
    const DoubleDouble &x = e.values[k], &y = e.values[l];
    return x.hi >= y.hi ? slope(x, y) : slope(y, x);
  };
  const Axes v = axes_of(e);
  Sym3<double> g = in_axes(v, direction);
  g.xx *= between(0, 0);
  g.xy *= between(0, 1);
  g.xz *= between(0, 2);
  g.yy *= between(1, 1);
  g.yz *= between(1, 2);
  g.zz *= between(2, 2);
  return in_axes(transposed(v), g);
}

template <class T>
void any_half_angle(const T* w, T* cosine_and_sine) {
  const T zero_if_finite = w[0] * 0 + w[1] * 0 + w[2] * 0;  // because std::hypot(inf, nan, 0) is inf
  const T angle = std::hypot(w[0], w[1], w[2]) + zero_if_finite;
  if (std::isinf(angle)) {  // the length overflows, but half the length does not
    const T half = std::hypot(w[0] / 2, w[1] / 2, w[2] / 2);
    cosine_and_sine[0] = std::cos(half);
    cosine_and_sine[1] = std::sin(half) / half / 2;
    return;
  }
  cosine_and_sine[0] = std::cos(angle / 2);
  cosine_and_sine[1] = std::sin(angle / 2) / angle;
}

}  // namespace

#define VIETE_FOR(T)                                                           \
  void exp_by_jacobi(const T* in, T* out) {                                    \
    to_six(exp_in_double(from_six(in)), out);                                  \
  }                                                                            \
  void exp_derivative_by_jacobi(const T* in, T* out) {                         \
    to_six(derivative_in_double(from_six(in), from_six(in + 6)), out);         \
  }                                                                            \
  void polar_by_jacobi(const T* in, T* out) {                                  \
    std::array<double, 9> m;                                                   \
    std::copy(in, in + 9, m.begin());                                          \
    const auto r = nearest_rotation(m);                                        \
    for (int k = 0; k < 9; ++k) out[k] = T(r[k]);                              \
  }                                                                            \
  void log_by_jacobi(const T* in, T* out) {                                    \
    to_six(log_in_double(from_six(in)), out);                                  \
  }                                                                            \
  void sqrt_by_jacobi(const T* in, T* out) {                                   \
    to_six(sqrt_in_double<T>(from_six(in)), out);                              \
  }                                                                            \
  void inv_sqrt_by_jacobi(const T* in, T* out) {                               \
    to_six(inv_sqrt_in_double(from_six(in)), out);                             \
  }                                                                            \
  void spectral_derivative_by_jacobi(Of f, double p, const T* in, T* out) {    \
    to_six(derivative_by_slopes({f, p}, from_six(in), from_six(in + 6)), out); \
  }                                                                            \
  void eigenvalues_by_jacobi(const T* in, T* out) {                            \
    const auto system = eigensystem_in_double(from_six(in));                   \
    for (int k = 0; k < 3; ++k) out[k] = T(system[k]);                         \
  }                                                                            \
  void eigh_by_jacobi(const T* in, T* out) {                                   \
    const auto system = eigensystem_in_double(from_six(in));                   \
    for (int k = 0; k < 12; ++k) out[k] = T(system[k]);                        \
  }                                                                            \
  void svd_by_jacobi(const T* in, T* out) {                                    \
    std::array<double, 9> m;                                                   \
    std::copy(in, in + 9, m.begin());                                          \
    const auto system = singular_system_in_double(m);                          \
    for (int k = 0; k < 21; ++k) out[k] = T(system[k]);                        \
  }                                                                            \
  void half_angle(const T* w, T* cosine_and_sine) {                            \
    any_half_angle(w, cosine_and_sine);                                        \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

}  // namespace viete::sym3
