#include "deform/polar.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace viete::deform {

namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// Result for a matrix that is not finite, which Eigen does not process.
Polar not_a_number() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Polar result;
  result.rotation.fill(nan);
  result.axes.fill(nan);
  result.stretches.fill(nan);
  return result;
}

}  // namespace

Polar polar(const sym3::Mat3<double>& m) {
  const Eigen::Matrix3d matrix = Eigen::Map<const RowMajor>(m.data());
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success) return not_a_number();
  Eigen::Matrix3d u = svd.matrixU();
  if (u.determinant() * svd.matrixV().determinant() < 0) u.col(2) = -u.col(2);
  Polar result;
  Eigen::Map<RowMajor>(result.rotation.data()) = u * svd.matrixV().transpose();
  Eigen::Map<RowMajor>(result.axes.data()) = svd.matrixV();
  for (int i = 0; i < 3; ++i) result.stretches[i] = svd.singularValues()[i];
  return result;
}

sym3::Sym3<double> log_stretch(const Polar& polar) {
  const auto& v = polar.axes;
  const Vec3 l{std::log(polar.stretches[0]), std::log(polar.stretches[1]), std::log(polar.stretches[2])};
  const auto entry = [&](int r, int c) {
    return v[3 * r] * l[0] * v[3 * c] + v[3 * r + 1] * l[1] * v[3 * c + 1] +
           v[3 * r + 2] * l[2] * v[3 * c + 2];
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

}  // namespace viete::deform
