// Simple loops for weights and frames, as in published programs: the baseline of the benchmarks.
#pragma once

#include <span>
#include <vector>

#include "deform/binding.h"
#include "deform/cage.h"

namespace viete::bench {

/// Computes weights by loops over vertices and cage triangles, in double. The distance to a triangle is the
/// distance to its plane, if the nearest point of the plane is inside the triangle. Otherwise the distance to
/// the nearest edge is used. The weight is distance^-2, divided by the sum over all triangles. Both arrays
/// have one row for each vertex and one column for each triangle.
class PlainWeights {
public:
  PlainWeights(std::size_t vertices, std::size_t elements)
      : distances_(vertices * elements), weights_(vertices * elements) {}

  void compute(std::span<const mesh::Point> positions, const deform::Cage& cage);
  std::span<const double> weights() const { return weights_; }

private:
  std::vector<double> distances_, weights_;
};

/// For each element, computes the map, its polar decomposition by SVD, and the principal logarithms of
/// stretch and rotation. In a pose, each element must have an area and rotate by less than 180 degrees. For
/// each vertex, adds the 9 + 9 + 3 numbers of each cage triangle times the weight, in double. Then applies
/// improved SD, Rodrigues' formula and the affine product. Triangles add their normals to vertices.
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
