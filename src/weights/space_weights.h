// Smooth weights as functions of points in space, for models without faces.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "pose/cage.h"
#include "pose/deformer.h"
#include "weights/bind_kernel.h"

namespace viete::weights {

using mesh::Vec3;

/// Weights that depend only on the cage and the place: each weight is the function w that minimises
///
///     E(w) + sum over handles i of s_i * (w(c_i) - t_i)^2,    t = 1 for its own handle, otherwise 0.
///
/// c_i are the centres of the handles. For `biharmonic` weights, E is the bending energy of space: minima are
/// sums of multiquadrics, w(x) = b + sum a_i * sqrt(|x - c_i|^2 + e^2) (R. L. Hardy, J. Geophys. Res. 76,
/// 1971). For `harmonic` weights, E is the Dirichlet energy and minima are sums of 1 / sqrt(|x - c_i|^2 +
/// e^2). The a_i sum to 0, so weights have limits far away. e is the mean spacing of the handles, which makes
/// all derivatives continuous. The springs s_i are soft, as those of SurfaceSystem: with stiff springs, the
/// model follows single handles, and its energy is a quarter higher.
///
/// Then, so that distant handles have no influence, weights w up to 0 become 0, weights up to 2 d become
/// w^2 / (4 d), and others w - d. The result is divided by the sum. d is a third of the mean weight. First
/// derivatives are continuous. Weights of points farther than 1000 diagonals are constant.
///
/// Handles without area have no weight. Thread-safe.
class SpaceWeights {
public:
  /// `centers` are those of the handles, scaled by `scale` so that the cage's diagonal is near 1. Throws
  /// base::Error if memory is insufficient.
  SpaceWeights(const pose::Cage& cage, const pose::Weighting& weighting, std::vector<Vec3> centers,
               double scale);

  /// The size of the buffers for weights and for scratch.
  std::size_t buffer_size() const { return constants_.size() * bind_lanes; }
  /// Returns a job for eight points [3][lane], scaled as the centers.
  SpaceJob job(const double* points, double* scratch) const;

private:
  std::vector<Vec3> centers_;
  std::vector<double> coefficients_, constants_;
  double width_, threshold_;
  bool inverse_;
};

}  // namespace viete::weights
