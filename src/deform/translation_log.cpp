#include "deform/translation_log.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "deform/matrix_log.h"

namespace viete::deform {

namespace {

using mesh::cross, mesh::dot, mesh::norm, mesh::squared_norm, mesh::Vec3;
using Matrix = Eigen::Matrix3d;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double pole_width = std::numbers::pi / 3;
constexpr double small_angle = 0.05;

// How much of the even part is kept at an angle: 0 at whole turns, 1 where none is near, its slope
// continuous.
double kept(double angle) {
  if (angle < full_turn - pole_width) return 1;
  const double t = std::min(std::abs(angle - full_turn * std::round(angle / full_turn)) / pole_width, 1.0);
  return t * t * (3 - 2 * t);
}

// (angle / 2) cot(angle / 2), times what is kept of it.
double across(double angle) {
  const double square = angle * angle;
  if (angle < small_angle) return 1 - square / 12 * (1 + square / 60 * (1 + square / 42));
  const double share = kept(angle);
  return share > 0 ? share * (angle / 2) / std::tan(angle / 2) : 0;
}

// n n^T of an axis.
Matrix projector(const Vec3& axis) {
  const Eigen::Vector3d n = Eigen::Map<const Eigen::Vector3d>(axis.data()).normalized();
  return n * n.transpose();
}

double angle_of(const Matrix& log) {
  return Eigen::EigenSolver<Matrix>(log, false).eigenvalues().imag().maxCoeff();
}

// Powers of L / 2^k, each a combination of the first three (Cayley and Hamilton).
struct Powers {
  double t1, t2, t3;  // L^3 = t1 L^2 - t2 L + t3 I

  // Times L.
  Vec3 shifted(const Vec3& p) const { return {p[2] * t3, p[0] - p[2] * t2, p[1] + p[2] * t1}; }

  Vec3 product(const Vec3& p, const Vec3& q) const {
    const Vec3 once = shifted(q), twice = shifted(once);
    return p[0] * q + p[1] * once + p[2] * twice;
  }
};

}  // namespace

sym3::Sym3<double> even_part(const Vec3& y) {
  const double angle = norm(y), g = across(angle);
  if (angle == 0) return {1, 0, 0, 1, 0, 1};
  // 1 - g is small where the axis is rounding.
  const double along = (1 - g) / squared_norm(y);
  return {g + along * y[0] * y[0], along * y[0] * y[1], along * y[0] * y[2],
          g + along * y[1] * y[1], along * y[1] * y[2], g + along * y[2] * y[2]};
}

sym3::Mat3<double> even_part(const sym3::Mat3<double>& log, const Vec3& y) {
  const Matrix l = Eigen::Map<const RowMajor>(log.data());
  if (l.isZero(0)) return {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double share = norm(y) > 3 ? kept(angle_of(l)) : 1;
  Matrix e = Matrix::Zero();
  if (share > 1e-9) {
    Matrix phi;
    for (int c = 0; c < 3; ++c) {
      const Vec3 column = phi_times(log, {c == 0 ? 1.0 : 0, c == 1 ? 1.0 : 0, c == 2 ? 1.0 : 0});
      phi.col(c) = Eigen::Map<const Eigen::Vector3d>(column.data());
    }
    e = share * (phi.inverse() + l / 2);
  }
  if (share < 1) e += (1 - share) * projector(y);
  sym3::Mat3<double> entries;
  Eigen::Map<RowMajor>(entries.data()) = e;
  return entries;
}

// phi(2 A) = phi(A) + A phi(A)^2 / 2, from |A| <= 1/2 up.
Vec3 phi_times(const sym3::Mat3<double>& log, const Vec3& x) {
  constexpr int last = 14;
  const Matrix l = Eigen::Map<const RowMajor>(log.data());
  const double size = l.norm();
  const int doublings = size > 0.5 ? static_cast<int>(std::min(std::ceil(std::log2(2 * size)), 60.0)) : 0;
  const Matrix a = std::exp2(-doublings) * l;
  const double trace = a.trace();
  const Powers powers{trace, (trace * trace - (a * a).trace()) / 2, a.determinant()};
  double factorial = 1;  // of n + 1
  for (int n = 2; n <= last + 1; ++n) factorial *= n;
  Vec3 phi{1 / factorial, 0, 0};
  for (int n = last - 1; n >= 0; --n) {
    factorial /= n + 2;
    phi = powers.shifted(phi) + Vec3{1 / factorial, 0, 0};
  }
  double half = 0.5;
  for (int k = 0; k < doublings; ++k, half *= 2) phi = phi + half * powers.shifted(powers.product(phi, phi));
  const Eigen::Vector3d v = Eigen::Map<const Eigen::Vector3d>(x.data()), av = a * v;
  const Eigen::Vector3d sum = phi[0] * v + phi[1] * av + phi[2] * (a * av);
  return {sum[0], sum[1], sum[2]};
}

// I + (1 - cos) / theta^2 Y + (theta - sin) / theta^3 Y^2, by half the angle: x sin / theta + ... + what is
// along the axis.
Vec3 phi_times(const Vec3& y, const Vec3& x) {
  const double square = squared_norm(y), angle = std::sqrt(square);
  const double half_sine = angle > 0 ? std::sin(angle / 2) / angle : 0.5,
               sinc = 2 * std::cos(angle / 2) * half_sine;
  const double along = angle < small_angle ? (1 - square / 20 * (1 - square / 42 * (1 - square / 72))) / 6
                                           : (1 - sinc) / square;
  return sinc * x + (2 * half_sine * half_sine) * cross(y, x) + (along * dot(y, x)) * y;
}

}  // namespace viete::deform
