// Simple loops for weights and frames, as in published programs: the baseline of the benchmarks.
#pragma once

#include <span>
#include <vector>

#include "deform/binding.h"
#include "deform/cage.h"

namespace viete::bench {

/// Computes weights by loops over vertices and cage triangles, in double. The distance to a triangle is the
/// smallest of the distances to its plane, by barycentric coordinates, and to its three edges. The weight is
/// the distance to the power of -2, divided by the sum of its row. Both arrays have n rows of k numbers.
class PlainWeights {
public:
  PlainWeights(std::size_t vertices, std::size_t elements)
      : distances_(vertices * elements), weights_(vertices * elements) {}

  void compute(std::span<const mesh::Point> positions, const deform::Cage& cage);
  std::span<const double> weights() const { return weights_; }

private:
  std::vector<double> distances_, weights_;
};

/// Computes for each element the map, the polar decomposition by SVD, and the logarithms of stretch and
/// rotation. The logarithms are principal, so poses must keep the elements' area and rotate them by less than
/// 180 degrees. For each vertex, adds full matrices times weights in double: 9 + 9 + 3 numbers per cage
/// triangle. Then applies improved SD, Rodrigues' formula and the affine product. Triangles add their normals
/// to vertices.
class ReferenceFrame {
public:
  /// Keeps references to the arguments. The binding must have weights.
  ReferenceFrame(const deform::Cage& cage, const deform::Binding& binding);
  ~ReferenceFrame();

  void deform(const deform::Pose& pose);

  std::span<const mesh::Point> positions() const { return positions_; }
  std::span<const mesh::Point> normals() const { return normals_; }

private:
  struct Handle;
  void log_cage(const deform::Pose& pose);
  mesh::Point place(std::size_t vertex) const;
  void scatter_normals();

  const deform::Cage& cage_;
  const deform::Binding& binding_;
  std::vector<Handle> handles_;
  std::vector<mesh::Point> positions_, normals_;
};

}  // namespace viete::bench
