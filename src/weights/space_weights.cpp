#include "weights/space_weights.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numeric>
#include <string>

#include "base/memory.h"
#include "mesh/triangle.h"
#include "sparse/sparse_cholesky.h"
#include "weights/point_weights.h"

namespace viete::weights {

namespace {

// Chosen by energy, leak and distance from the cage over the poses of six models.
constexpr double width = 1;                               // e, in spacings
constexpr double soft_biharmonic = 6, soft_harmonic = 1;  // 1 / s, in spacings
constexpr double threshold = 0.3;                         // d, in mean weights
// Added to the matrix. Changes no solution, because the coefficients sum to 0, but makes the matrix positive
// definite: it is larger than all distances between scaled centers.
constexpr double above_distances = 4;

double scaled_area(const pose::Cage& cage, double scale) {
  std::vector<mesh::Point> scaled;
  for (const mesh::Point& p : cage.elements.positions) scaled.push_back(scale * p);
  double sum = 0;
  for (const auto& t : cage.elements.triangles) sum += mesh::area(scaled, t);
  return sum;
}

}  // namespace

SpaceWeights::SpaceWeights(const pose::Cage& cage, const pose::Weighting& weighting,
                           std::vector<Vec3> centers, double scale)
    : centers_(std::move(centers)), inverse_(weighting.weights == pose::Weights::harmonic) {
  std::vector<std::size_t> weighing;
  std::vector<double> shares;
  for (std::size_t h = 0; h < centers_.size(); ++h) {
    const double share = handle_shape(cage, weighting.elements, h).share;
    if (share == 0) continue;
    weighing.push_back(h);
    shares.push_back(share);
  }
  const double count = std::accumulate(shares.begin(), shares.end(), 0.0);
  const double spacing = std::sqrt(scaled_area(cage, scale) / count);
  width_ = width * spacing;
  threshold_ = threshold / count;
  const std::size_t padded = (centers_.size() + space_group - 1) / space_group * space_group;
  centers_.resize(padded);
  base::require_memory({4.0 * sizeof(double) * static_cast<double>(padded * padded),
                        "smooth weights of " + std::to_string(padded) + " cage elements take",
                        "use a coarser cage, or other weights", ""});
  const double compliance = spacing * (inverse_ ? soft_harmonic : soft_biharmonic);
  const auto n = static_cast<Eigen::Index>(weighing.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const double distance = std::hypot(norm(centers_[weighing[a]] - centers_[weighing[b]]), width_);
      matrix(i, j) = inverse_ ? spacing * spacing / distance : above_distances - distance;
      if (i == j) matrix(i, i) += compliance / shares[a];
    }
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factored(matrix);
  if (factored.info() != Eigen::Success) sparse::refuse_system();
  Eigen::MatrixXd inverse = factored.solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd sums = inverse.rowwise().sum();
  inverse -= sums * (sums.transpose() / sums.sum());
  constants_.assign(padded, 0);
  coefficients_.assign(padded * padded, 0);
  const double unit = inverse_ ? spacing * spacing : -1;
  for (Eigen::Index j = 0; j < n; ++j) {
    const std::size_t h = weighing[static_cast<std::size_t>(j)];
    constants_[h] = sums[j] / sums.sum();
    double* column = coefficients_.data() + h / space_group * padded * space_group + h % space_group;
    for (Eigen::Index i = 0; i < n; ++i)
      column[weighing[static_cast<std::size_t>(i)] * space_group] = unit * inverse(i, j);
  }
}

SpaceJob SpaceWeights::job(const double* points, double* scratch) const {
  return {reinterpret_cast<const double(*)[3]>(centers_.data()),
          centers_.size(),
          coefficients_.data(),
          constants_.data(),
          width_,
          threshold_,
          inverse_,
          points,
          scratch};
}

}  // namespace viete::weights
