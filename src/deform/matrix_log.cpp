#include "deform/matrix_log.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <unsupported/Eigen/MatrixFunctions>

namespace viete::deform {

namespace {

using Matrix = Eigen::Matrix3d;

constexpr double kept_up_to = 2, left_from = 4;  // times |X| + |Y|
constexpr double least_clear = 1e-7;             // there X + Y is log M but for so much

Matrix cross_matrix(const Vec3& w) {
  return Matrix{{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
}

Matrix sum_of_logs(const MapLog& log) {
  const auto& x = log.stretch;
  return Matrix{{x.xx, x.xy, x.xz}, {x.xy, x.yy, x.yz}, {x.xz, x.yz, x.zz}} + cross_matrix(log.rotation);
}

// The logarithm of m with eigenvalues log r and log|c| +- i arg c: J, which commutes with m and turns the
// plane of the pair by a quarter, adds whole turns.
struct Turning {
  double angle;      // of the pair, in (0, pi]
  double clearness;  // |sin| of it: how many digits of the plane are left near 180 degrees
  Matrix quarter_turn;
};

std::optional<Turning> turning(const Matrix& m, const Eigen::Vector3cd& values) {
  int real = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(values[i].imag()) < std::abs(values[real].imag())) real = i;
  }
  const std::complex<double> pair = values[(real + 1) % 3];
  const double a = pair.real(), b = std::abs(pair.imag()), r = values[real].real();
  if (!(b > 0)) return std::nullopt;
  const Matrix shifted = m - a * Matrix::Identity();
  const Matrix off_plane = (shifted * shifted + b * b * Matrix::Identity()) / ((r - a) * (r - a) + b * b);
  return Turning{std::atan2(b, a), a < 0 ? b / std::hypot(a, b) : 1,
                 shifted * (Matrix::Identity() - off_plane) / b};
}

// How many whole turns the branch of Y has made more.
double whole_turns(const Turning& t, const Vec3& turn) {
  const Matrix& j = t.quarter_turn;
  const Vec3 axis{j(2, 1) - j(1, 2), j(0, 2) - j(2, 0), j(1, 0) - j(0, 1)};
  return std::round((dot(axis, turn) / norm(axis) - t.angle) / (2 * std::numbers::pi));
}

// Not where a real eigenvalue is negative, as one of every mirrored map is, or 0.
bool has_log(const Eigen::Vector3cd& values) {
  return std::all_of(values.begin(), values.end(),
                     [](const auto& v) { return v.imag() != 0 || v.real() > 0; });
}

// Nothing where there is none, and where rounding alone would decide which.
std::optional<Matrix> log_of_branch(const Matrix& m, const MapLog& log) {
  const Eigen::Vector3cd values = Eigen::EigenSolver<Matrix>(m, false).eigenvalues();
  if (!has_log(values)) return std::nullopt;
  const auto t = turning(m, values);
  if (t && t->clearness < least_clear) return std::nullopt;
  Matrix l = m.log();
  if (t) {
    l += 2 * std::numbers::pi * whole_turns(*t, log.rotation) * t->quarter_turn;
  } else if (norm(log.rotation) > std::numbers::pi) {
    return std::nullopt;
  }
  return l.allFinite() ? std::optional(l) : std::nullopt;
}

// 0 up to 0, 1 from 1 on, with a continuous slope.
double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

sym3::Mat3<double> by_rows(const Matrix& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

}  // namespace

sym3::Mat3<double> matrix_log(const sym3::Mat3<double>& linear, const MapLog& log) {
  const Matrix sum = sum_of_logs(log);
  const double size = std::sqrt((sum + sum.transpose()).squaredNorm() / 4) +
                      std::sqrt((sum - sum.transpose()).squaredNorm() / 4);
  if (size == 0) return {};
  const Matrix m = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(linear.data());
  const auto l = log_of_branch(m, log);
  if (!l) return by_rows(sum);
  const double left = smooth_step((l->norm() / size - kept_up_to) / (left_from - kept_up_to));
  return by_rows((1 - left) * *l + left * sum);
}

sym3::Mat3<double> matrix_exp(const sym3::Mat3<double>& log) {
  return by_rows(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(log.data()).exp());
}

}  // namespace viete::deform
