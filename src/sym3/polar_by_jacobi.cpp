// The nearest rotation by Horn's quaternion ("Closed-form solution of absolute orientation using unit
// quaternions", 1987), refined once.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sym3/double_double.h"
#include "sym3/fallback.h"

namespace viete::sym3 {

namespace {

constexpr int n = 4;
constexpr int most_sweeps = 12;  // five or six are enough: convergence is quadratic

using Matrix4 = std::array<std::array<double, n>, n>;

/// Horn's matrix: q^T H q = tr(R(q)^T M) for unit quaternions q, scalar part first.
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
    x = c * old - s * y, y = s * old + c * y;
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

/// The unit quaternion of the largest eigenvalue; the first of equal ones.
std::array<double, n> top_vector(Matrix4 a) {
  Matrix4 v = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  for (int sweep = 0; sweep < most_sweeps && off_diagonal(a) > 1e-20; ++sweep) {
    for (int p = 0; p < n; ++p) {
      for (int q = p + 1; q < n; ++q) rotate(a, v, p, q);
    }
  }
  int top = 0;
  for (int k = 1; k < n; ++k) {
    if (a[k][k] > a[top][top]) top = k;
  }
  return {v[0][top], v[1][top], v[2][top], v[3][top]};
}

/// Scaled so that the largest entry is between 1 and 2; zero stays zero.
std::array<double, 9> normalized(const std::array<double, 9>& m) {
  double largest = 0;
  for (const double x : m) largest = std::max(largest, std::fabs(x));
  if (largest == 0) return m;
  const int exponent = -std::ilogb(largest);
  std::array<double, 9> out;
  for (int k = 0; k < 9; ++k) out[k] = std::scalbn(m[k], exponent);
  return out;
}

std::array<double, 9> to_matrix(const std::array<double, n>& q) {
  const auto [w, x, y, z] = q;
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return {1 - s * (y * y + z * z), s * (x * y - w * z),     s * (x * z + w * y),
          s * (x * y + w * z),     1 - s * (x * x + z * z), s * (y * z - w * x),
          s * (x * z - w * y),     s * (y * z + w * x),     1 - s * (x * x + y * y)};
}

/// Column i of R times column j of M minus the other way round, in double-double: what is left of the
/// asymmetry.
double asymmetry(const std::array<double, 9>& r, const std::array<double, 9>& m, int i, int j) {
  DoubleDouble sum;
  for (int k = 0; k < 9; k += 3) {
    sum = sum + two_product(r[k + i], m[k + j]) + two_product(-r[k + j], m[k + i]);
  }
  return sum.hi;
}

/// One Newton step: R^T M is symmetric at the solution; a turn by w changes its asymmetry by (tr U - U) w.
std::array<double, n> refined(const std::array<double, n>& q, const std::array<double, 9>& m) {
  const auto r = to_matrix(q);
  const auto dot = [&](int i, int j) { return r[i] * m[j] + r[3 + i] * m[3 + j] + r[6 + i] * m[6 + j]; };
  const double xx = dot(1, 1) + dot(2, 2), yy = dot(0, 0) + dot(2, 2), zz = dot(0, 0) + dot(1, 1);
  const double xy = -(dot(0, 1) + dot(1, 0)) / 2, xz = -(dot(0, 2) + dot(2, 0)) / 2,
               yz = -(dot(1, 2) + dot(2, 1)) / 2;
  const double cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
  const double cyy = xx * zz - xz * xz, cyz = xy * xz - xx * yz, czz = xx * yy - xy * xy;
  const double det = xx * cxx + xy * cxy + xz * cxz;
  if (!(det > 1e-30)) return q;  // no rotation is nearest alone
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
  if (finite != 0) {
    std::array<double, 9> nan;
    nan.fill(std::numeric_limits<double>::quiet_NaN());
    return nan;
  }
  const auto scaled = normalized(m);
  return to_matrix(refined(top_vector(horn(scaled)), scaled));
}

template <class T>
void by_jacobi(const T* m, T* rotation) {
  std::array<double, 9> in;
  std::copy(m, m + 9, in.begin());
  const auto r = nearest_rotation(in);
  for (int k = 0; k < 9; ++k) rotation[k] = T(r[k]);
}

}  // namespace

void polar_by_jacobi(const double* in, double* out) {
  by_jacobi(in, out);
}

void polar_by_jacobi(const float* in, float* out) {
  by_jacobi(in, out);
}

}  // namespace viete::sym3
