// Weights of several points at once, in vector code.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "deform/bind_kernel.h"
#include "deform/binding.h"
#include "deform/cage.h"
#include "deform/frame_kernel.h"

namespace viete::deform {

/// The weights of Binding for any points (for weights along the surface, only the data that does not depend
/// on the model): inverse_distance_weights() and mean_value_weights() to 1e-13, or to the accuracy of those
/// functions where that is lower. Keeps a reference to the cage. Thread-safe.
class Weigher {
public:
  Weigher(const Cage& cage, const Weighting& weighting, const sym3::Kernel& kernel = sym3::kernel());

  const Cage& cage() const { return cage_; }
  const Weighting& weighting() const { return weighting_; }
  std::size_t handles() const { return handles_.size(); }
  /// Size of the scratch of weigh().
  std::size_t scratch_size() const;
  using LaneShares = std::array<double, bind_lanes>;
  /// Writes the weights [handle][8] of eight points to the start of the scratch, each lane with sum 1 (or 0
  /// if no element reaches it), and each point's share of the motion, see Binding::shares. Returns a bit mask
  /// of points without mean value coordinates.
  unsigned weigh(std::span<const mesh::Point, bind_lanes> points, std::span<double> scratch,
                 LaneShares& shares) const;
  /// Weights as floats, with errors up to 2e-6: rows [tile][handle][16] for points near each other, a
  /// multiple of 16; sums of these float weights times handle positions, and shares, per point. Returns which
  /// points have no mean value coordinates.
  std::vector<bool> weigh_tiles(std::span<const mesh::Point> points, float* rows, std::span<Vec3> sums,
                                std::span<float> shares) const;
  /// Rest positions of the handles relative to origin().
  std::span<const Vec3> handle_positions() const { return handles_; }
  const Vec3& origin() const { return origin_; }

private:
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

  const Cage& cage_;
  Weighting weighting_;
  const BindKernel& kernel_;
  Vec3 origin_;
  double scale_;  // a power of two: the cage's diagonal times it is near 1
  std::vector<Vec3> handles_;
  std::vector<Vec3> corners_;  // the cage's corners, relative to the origin and scaled, as all members below
  // For distances: the handles as triangles, and the origins of their axes.
  std::vector<DistanceTriangle<double>> triangles_;
  std::vector<DistanceTriangle<float>> float_triangles_;
  std::vector<Vec3> origins_, shifts_;
  // For mean values: its edges, and its triangles by corners and edges.
  std::vector<mesh::Edge> edges_;
  std::vector<MeanValueTriangle> views_;
  std::vector<std::uint32_t> without_area_;  // the cage's triangles without area
};

}  // namespace viete::deform
