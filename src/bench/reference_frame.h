// Plain loops for weights and frames as in published tools: the baseline of the benchmarks.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "deform/binding.h"
#include "deform/cage.h"

namespace viete::bench {

/// Loops over vertices and cage triangles, in double: distance to the triangle's plane by barycentric
/// coordinates, and to its three edges; the smallest of them to the power of -exponent; then each row divided
/// by its sum. Two arrays, distances and weights, of n rows of k each.
class PlainWeights {
public:
  PlainWeights(std::size_t vertices, std::size_t elements)
      : distances_(vertices * elements), weights_(vertices * elements) {}

  void compute(std::span<const mesh::Point> positions, const deform::Cage& cage, double exponent = 2);
  std::span<const double> weights() const { return weights_; }

private:
  std::vector<double> distances_, weights_;
};

/// Per element: map, polar decomposition by SVD, logs of stretch and rotation (principal, so poses must
/// rotate elements by less than 180 degrees and keep their area). Per vertex: full matrices summed with
/// weights in double (9 + 9 + 3 numbers per cage triangle), improved SD, Rodrigues' formula, the affine
/// product; normals scattered from triangles. Buffers are allocated once.
class ReferenceFrame {
public:
  /// Keeps references to cage and binding; the binding must have weights.
  ReferenceFrame(const deform::Cage& cage, const deform::Binding& binding);

  void deform(const deform::Pose& pose);

  std::span<const mesh::Point> positions() const { return positions_; }
  std::span<const mesh::Point> normals() const { return normals_; }

private:
  using Matrix = std::array<std::array<double, 3>, 3>;
  struct Handle {
    Matrix stretch, rotation;  ///< logs
    std::array<double, 3> center;
  };
  void log_cage(const deform::Pose& pose);
  mesh::Point place(std::size_t vertex) const;
  void scatter_normals();

  const deform::Cage& cage_;
  const deform::Binding& binding_;
  std::vector<Handle> handles_;
  std::vector<mesh::Point> positions_, normals_;
};

}  // namespace viete::bench
