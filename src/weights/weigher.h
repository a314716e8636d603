// Weights of several points at once, in vector code.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "pose/cage.h"
#include "weights/bind_kernel.h"
#include "weights/binding.h"
#include "weights/leaves.h"
#include "weights/space_weights.h"

namespace viete::weights {

/// Returns the weighting for this model: smooth weights are on its surface or, without faces, in space.
pose::Weighting weighting_for(const mesh::Surface& model, pose::Weighting weighting);

/// Computes weights for any points, as in Binding. For definitions, see BindKernel and mean_value_weights().
/// The error is 1e-13; near an element, rounding in the distance can add more. Weights along the surface
/// exist only at vertices and are not computed here; those in space are, see SpaceWeights. Keeps a reference
/// to the cage. Thread-safe.
class Weigher {
public:
  Weigher(const pose::Cage& cage, const pose::Weighting& weighting,
          const sym3::Kernel& kernel = sym3::kernel());

  const pose::Cage& cage() const { return cage_; }
  const pose::Weighting& weighting() const { return weighting_; }
  std::size_t handles() const { return handles_.size(); }
  /// The size of the scratch that weigh() needs.
  std::size_t scratch_size() const;
  using LaneShares = std::array<double, bind_lanes>;
  /// Writes the weights of eight points to the start of `scratch` as [handle][8]. The weights of a point sum
  /// to 1, or to 0 if all are 0. Writes each point's share of the motion to `shares`, see Binding::shares.
  /// Returns a bit mask of points without mean value coordinates.
  unsigned weigh(std::span<const mesh::Point, bind_lanes> points, std::span<double> scratch,
                 LaneShares& shares) const;
  /// Computes weights as floats, with errors up to 2e-6, for neighbouring points. Their number must be a
  /// multiple of 16. Writes weights to `rows` as [tile][handle][16], each point's sum of weight * handle
  /// position to `sums`, and each point's share to `shares`. Returns for each point whether mean value
  /// coordinates do not exist.
  std::vector<bool> weigh_tiles(std::span<const mesh::Point> points, float* rows, std::span<Vec3> sums,
                                std::span<float> shares) const;
  /// Rest positions of the handles relative to origin().
  std::span<const Vec3> handle_positions() const { return handles_; }
  const Vec3& origin() const { return origin_; }

private:
  const SpaceWeights& space() const;
  void add_triangles();
  void add_views();
  Vec3 scaled(const mesh::Point& p) const;
  WeightJob<double> job(const double* at) const;
  unsigned weigh_mean_values(std::span<const mesh::Point, bind_lanes> points, const double* at,
                             std::span<double> scratch) const;
  double squared_contact() const;
  double cut() const;
  bool weigh_in_float(std::span<const mesh::Point, tile_lanes<float>> points, const Vec3& middle,
                      std::span<const std::array<float, 3>> shifts, const RowJob& out) const;

  const pose::Cage& cage_;
  pose::Weighting weighting_;
  const BindKernel& kernel_;
  Vec3 origin_;
  double scale_;  // a power of two; scale_ times the cage's diagonal is near 1
  std::vector<Vec3> handles_;
  std::vector<Vec3> corners_;  // corners_ and all members below are relative to origin_ and scaled by scale_
  // For distances: the handles as triangles, and the origins of their axes.
  std::vector<DistanceTriangle<double>> triangles_;
  std::vector<DistanceTriangle<float>> float_triangles_;
  std::vector<Vec3> origins_, shifts_;
  // For mean values: the cage's edges, and its triangles by corners and edges.
  std::vector<mesh::Edge> edges_;
  std::vector<MeanValueTriangle> views_;
  std::vector<std::uint32_t> without_area_;  // the cage's triangles without area
  mutable std::once_flag solved_;
  mutable std::optional<SpaceWeights> space_;  // made when first used, because solving takes time
};

}  // namespace viete::weights
