// Weights of eight points at a time, in vector code.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "deform/aligned.h"
#include "deform/bind_kernel.h"
#include "deform/binding.h"
#include "deform/cage.h"

namespace viete::deform {

/// The weights of Binding for any points: inverse_distance_weights() to 1e-13, mean_value_weights() exactly. Keeps a
/// reference to the cage. Thread-safe.
class Weigher {
public:
  Weigher(const Cage& cage, Coordinates coordinates, const sym3::Kernel& kernel = sym3::kernel());

  std::size_t handles() const { return handles_.size(); }
  /// weights [handle][8] of eight points, each lane summing to 1. Returns a bit for each that has no mean value
  /// coordinates.
  unsigned weigh(const std::array<mesh::Point, bind_lanes>& points, std::span<double> weights) const;
  /// weigh() as floats into rows [handle][16], eight lanes of them; sums [3][8] of weight times handle position.
  unsigned weigh_rows(const std::array<mesh::Point, bind_lanes>& points, std::span<double> scratch, float* rows,
                      double* sums) const;
  /// Rest positions of the handles relative to origin().
  std::span<const Vec3> handle_positions() const { return handles_; }
  const Vec3& origin() const { return origin_; }

private:
  const Cage& cage_;
  Coordinates coordinates_;
  const BindKernel& kernel_;
  Vec3 origin_;
  std::vector<Vec3> handles_;
  std::vector<DistanceTriangle> triangles_;
};

}  // namespace viete::deform
