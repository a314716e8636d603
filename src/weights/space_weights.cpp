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

// The handles with a share, and their shares.
struct Weighing {
  Weighing(const pose::Cage& cage, pose::Elements elements, std::size_t all) {
    for (std::size_t h = 0; h < all; ++h) {
      const double share = handle_shape(cage, elements, h).share;
      if (share == 0) continue;
      handles.push_back(h);
      shares.push_back(share);
    }
  }

  std::vector<std::size_t> handles;
  std::vector<double> shares;
};

// The coefficients and constants for the target of each handle, a column each. The matrix, of which only the
// lower triangle is read, is overwritten.
struct Solution {
  explicit Solution(Eigen::MatrixXd& matrix) {
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factored(matrix);
    if (factored.info() != Eigen::Success) sparse::refuse_system();
    coefficients = factored.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
    const Eigen::VectorXd sums = coefficients.rowwise().sum();
    constants = sums / sums.sum();
    coefficients -= sums * constants.transpose();
  }

  Eigen::MatrixXd coefficients;
  Eigen::VectorXd constants;
};

void require_memory(std::size_t handles) {
  const auto k = static_cast<double>(handles);
  base::require_memory({4 * sizeof(double) * k * k,
                        "smooth weights of " + std::to_string(handles) + " cage elements take",
                        "use a coarser cage, or other weights", ""});
}

}  // namespace

SpaceWeights::SpaceWeights(const pose::Cage& cage, const pose::Weighting& weighting,
                           std::vector<Vec3> centers, double scale)
    : centers_(std::move(centers)), inverse_(weighting.weights == pose::Weights::harmonic) {
  const auto [handles, shares] = Weighing(cage, weighting.elements, centers_.size());
  const double count = std::accumulate(shares.begin(), shares.end(), 0.0);
  const double spacing = std::sqrt(scaled_area(cage, scale) / count);
  width_ = width * spacing;
  threshold_ = threshold / count;
  centers_.resize((centers_.size() + space_group - 1) / space_group * space_group);
  require_memory(centers_.size());
  const double unit = inverse_ ? spacing * spacing : -1;
  const double compliance = spacing * (inverse_ ? soft_harmonic : soft_biharmonic);
  Eigen::MatrixXd matrix(handles.size(), handles.size());
  for (std::size_t i = 0; i < handles.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double distance = std::hypot(norm(centers_[handles[i]] - centers_[handles[j]]), width_);
      matrix(Eigen::Index(i), Eigen::Index(j)) =
          inverse_ ? unit / distance : above_distances + unit * distance;
    }
    matrix(Eigen::Index(i), Eigen::Index(i)) += compliance / shares[i];
  }
  const Solution solution(matrix);
  const std::size_t padded = centers_.size();
  constants_.assign(padded, 0);
  coefficients_.assign(padded * padded, 0);
  for (std::size_t j = 0; j < handles.size(); ++j) {
    const std::size_t h = handles[j];
    constants_[h] = solution.constants[Eigen::Index(j)];
    double* column = coefficients_.data() + h / space_group * padded * space_group + h % space_group;
    for (std::size_t i = 0; i < handles.size(); ++i)
      column[handles[i] * space_group] = unit * solution.coefficients(Eigen::Index(i), Eigen::Index(j));
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
