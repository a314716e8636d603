#include "deform/moments.h"

#include <Eigen/Dense>
#include <algorithm>

#include "pose/maps.h"
#include "sym3/polar.h"
#include "sym3/small_matrices.h"

namespace viete::deform {

namespace {

using MomentMatrix = sym3::Mat3<double>;

Vec3 vector_at(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

Vec3 solve(const MomentMatrix& k, const Vec3& x) {
  const Eigen::Matrix3d matrix = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(k.data());
  const Eigen::Vector3d y = matrix.partialPivLu().solve(Eigen::Vector3d(x[0], x[1], x[2]));
  return {y[0], y[1], y[2]};
}

void add_moment(double v, const Vec3& a, const Vec3& b, MomentMatrix& m) {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[3 * r + c] += v * a[r] * b[c];
  }
}

// Sums and means for one vertex, see moments.h. Rest positions are multiples of l.
struct Means {
  double weight = 0;                   // sum of v
  Vec3 rest{0, 0, 0}, posed{0, 0, 0};  // m and m'
  Vec3 center{0, 0, 0};                // sum w * p'
};

Means means(std::span<const double> weights, const double* table) {
  Means m;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const double* row = table + j * pose::moment_shape.columns;
    const double v = std::max(weights[j], 0.0);
    m.weight += v;
    m.rest = m.rest + v * vector_at(row);
    m.posed = m.posed + v * vector_at(row + 12);
    m.center = m.center + weights[j] * vector_at(row + 12);
  }
  m.rest = (1 / m.weight) * m.rest;
  m.posed = (1 / m.weight) * m.posed;
  return m;
}

// `posed` is B / l, and `rest` is K / l^2, see moments.h.
struct Moments {
  MomentMatrix posed{}, rest{};
};

Moments moments(std::span<const double> weights, const double* table, const Means& means) {
  Moments sum;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    const double* row = table + j * pose::moment_shape.columns;
    const double v = std::max(weights[j], 0.0);
    const Vec3 p = vector_at(row) - means.rest;
    add_moment(v, vector_at(row + 12) - means.posed, p, sum.posed);
    add_moment(v, p, p, sum.rest);
    for (int i = 0; i < 9; ++i) sum.posed[i] += v * row[3 + i];
  }
  for (const int i : {0, 4, 8}) sum.rest[i] += means.weight;
  return sum;
}

// Returns M * o for the offset o.
Vec3 fitted(pose::RowForm form, const Moments& moments, const Vec3& o, double length) {
  if (form == pose::RowForm::affine_moments)
    return pose::times(moments.posed, solve(moments.rest, (1 / length) * o));
  const auto [rotation, stretch] = sym3::polar(moments.posed);
  const Vec3 turned = pose::times(rotation, o);
  if (form == pose::RowForm::rigid_moments) return turned;
  return (stretch.xx + stretch.yy + stretch.zz) / (length * sym3::trace(moments.rest)) * turned;
}

}  // namespace

void apply_moments(const weights::VertexBlock& block, const pose::Rows& rows, std::size_t begin,
                   std::size_t end, std::span<mesh::Point> positions) {
  const weights::Binding& binding = block.binding;
  for (std::size_t i = begin; i < end; ++i) {
    positions[i] = block.rest(i);
    const double share = block.share(i);
    if (share == 0) continue;
    const auto weights = std::span(binding.weights).subspan(i * binding.handles, binding.handles);
    const Means mean = means(weights, rows.values.data());
    const Moments sums = moments(weights, rows.values.data(), mean);
    const Vec3 moved = fitted(rows.form, sums, block.offset(i), rows.moment_length) + mean.center;
    const Vec3 rest = block.rest(i) - binding.rest_origin;
    positions[i] = rows.origin + (share == 1 ? moved : rest + share * (moved - rest));
  }
}

RestMoment rest_moment(const MomentMatrix& moments, const Vec3& sum, double weight, const Vec3& shift,
                       const Vec3& offset, double unit) {
  if (!(weight > 0)) return {{0, 0, 0}, 0};
  MomentMatrix k = moments;
  const Vec3 off = shift + (1 / weight) * sum;  // m - p0
  add_moment(-1, off, sum, k);
  return {solve(k, offset), unit / sym3::trace(k)};
}

}  // namespace viete::deform
