#include "shapes/anchors.h"

#include <Eigen/Dense>
#include <algorithm>

#include "base/worker_pool.h"

namespace viete::shapes {

namespace {

// A vertex gets the weight 1 / (m + stillness)^2, where m is its squared motion divided by the largest
// squared motion. So a resting vertex has 1e14 times the weight of the vertex that moves most.
constexpr double stillness = 1e-7;
// Smaller singular values of a fitted map are ignored: the fixed point would be too far away to matter.
constexpr double least_motion = 1e-4;
// Directions in which the vertices spread less than this factor times the largest spread are ignored.
constexpr double told_spread = 1e-9;

Eigen::Vector3d eigen(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

// An affine map that is fitted to the displacements of weighted vertices.
struct AffineFit {
  Vec3 center{0, 0, 0};
  Eigen::Matrix3d inverse_spread = Eigen::Matrix3d::Zero();  // inverse covariance of the positions
  Eigen::Vector3d to_fixed_point{0, 0, 0};  // vector from the centre; shorter if the map fits badly
};

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Returns the inverse of a symmetric matrix, but with 0 for the inverses of small eigenvalues.
Eigen::Matrix3d inverse_where_large(const Eigen::Matrix3d& m) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  Eigen::Vector3d inverse{0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const double value = solver.eigenvalues()[k];
    if (value > told_spread * solver.eigenvalues()[2]) inverse[k] = 1 / value;
  }
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

AffineFit fit_of(std::span<const std::uint32_t> vertices, std::span<const double> weights,
                 std::span<const Vec3> places, std::span<const Vec3> displacements) {
  AffineFit fit;
  Vec3 mean{0, 0, 0};
  for (const auto v : vertices) {
    fit.center = fit.center + weights[v] * places[v];
    mean = mean + weights[v] * displacements[v];
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(), across = Eigen::Matrix3d::Zero();
  double all = 0;
  for (const auto v : vertices) {
    const Eigen::Vector3d x = eigen(places[v] - fit.center), d = eigen(displacements[v] - mean);
    spread += weights[v] * x * x.transpose();
    across += weights[v] * d * x.transpose();
    all += weights[v] * d.squaredNorm();
  }
  fit.inverse_spread = inverse_where_large(spread);
  const Eigen::Matrix3d slope = across * fit.inverse_spread;
  const double explained = (slope * across.transpose()).trace();
  if (!(all > 0)) return fit;
  Eigen::JacobiSVD<Eigen::Matrix3d> svd(slope, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success) return fit;  // the input is infinite or NaN
  for (int k = 0; k < 3; ++k) {
    const double s = svd.singularValues()[k];
    if (s > least_motion)
      fit.to_fixed_point -= svd.matrixU().col(k).dot(eigen(mean)) / s * svd.matrixV().col(k);
  }
  fit.to_fixed_point *= smooth_step(0.9, 0.99, explained / all);
  return fit;
}

}  // namespace

// Multiplies the weights by a linear function of the positions, so that the weighted mean of the positions is
// the fixed point of the fitted affine map.
AnchorWeights anchor_weights(const AnchoredParts& parts, std::span<const Vec3> from,
                             std::span<const Vec3> displacements, std::span<const double> squares) {
  const double farthest = squares.empty() ? 0 : *std::max_element(squares.begin(), squares.end());
  AnchorWeights anchors(from.size());
  base::for_blocks(parts.count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) {
      const auto vertices = parts.vertices.of(part);
      double total = 0;
      for (const auto v : vertices) {
        const double moved = farthest > 0 ? squares[v] / farthest + stillness : 1;
        total += anchors[v] = parts.masses[v] / (moved * moved);
      }
      for (const auto v : vertices) anchors[v] /= total;
      const AffineFit fit = fit_of(vertices, anchors, from, displacements);
      const Eigen::Vector3d slope = fit.inverse_spread * fit.to_fixed_point;
      for (const auto v : vertices) anchors[v] *= 1 + slope.dot(eigen(from[v] - fit.center));
    }
  });
  return anchors;
}

void keep_anchors(const AnchoredParts& parts, const AnchorWeights& anchors, std::span<const Vec3> straight,
                  std::span<Vec3> displacements) {
  for (std::size_t part = 0; part < parts.count(); ++part) {
    Vec3 missing{0, 0, 0};
    for (const auto v : parts.vertices.of(part))
      missing = missing + anchors[v] * (straight[v] - displacements[v]);
    for (const auto v : parts.vertices.of(part)) displacements[v] = displacements[v] + missing;
  }
}

void center(const AnchoredParts& parts, std::span<Vec3> displacements) {
  for (std::size_t part = 0; part < parts.count(); ++part) {
    const auto vertices = parts.vertices.of(part);
    Vec3 mean{0, 0, 0};
    for (const auto v : vertices) mean = mean + displacements[v];
    mean = (1 / static_cast<double>(vertices.size())) * mean;
    for (const auto v : vertices) displacements[v] = displacements[v] - mean;
  }
}

}  // namespace viete::shapes
