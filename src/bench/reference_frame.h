// Simple loops for weights and frames, as in published programs: the baseline of the benchmarks.
#pragma once

#include <span>
#include <vector>

#include "pose/cage.h"
#include "weights/binding.h"

namespace viete::bench {

/// Computes weights by loops over vertices and cage triangles. The distance to a triangle is the
/// distance to its plane, if the nearest point of the plane is inside the triangle. Otherwise the distance to
/// the nearest edge is used. The weight is distance^-2, divided by the sum over all triangles. Distances
/// and weights have one row for each vertex and one column for each triangle.
class PlainWeights {
public:
  PlainWeights(std::size_t vertices, std::size_t elements)
      : distances_(vertices * elements), weights_(vertices * elements) {}

  void compute(std::span<const mesh::Point> positions, const pose::Cage& cage);
  std::span<const double> weights() const { return weights_; }

private:
  std::vector<double> distances_, weights_;
};

/// Computes frames in double precision, in three steps:
///   - for each cage triangle, the logarithms of stretch and rotation, by SVD
///   - for each vertex, the weighted sums of logarithms and centres, then improved SD and Rodrigues' formula
///   - vertex normals
/// In a pose, each cage triangle must have an area and rotate by less than 180 degrees.
class ReferenceFrame {
public:
  /// Keeps references to the arguments. The binding must have weights.
  ReferenceFrame(const pose::Cage& cage, const weights::Binding& binding);
  ~ReferenceFrame();

  void deform(const pose::Pose& pose);

  std::span<const mesh::Point> positions() const { return positions_; }
  std::span<const mesh::Point> normals() const { return normals_; }

private:
  struct Handle;
  void log_cage(const pose::Pose& pose);
  mesh::Point place(std::size_t vertex) const;
  void scatter_normals();

  const pose::Cage& cage_;
  const weights::Binding& binding_;
  std::vector<Handle> handles_;
  std::vector<mesh::Point> positions_, normals_;
};

}  // namespace viete::bench
