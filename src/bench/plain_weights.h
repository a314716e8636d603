// Weights as published tools compute them, rebuilt plainly: what binding is compared with.
#pragma once

#include <span>
#include <vector>

#include "deform/cage.h"

namespace viete::bench {

/// Loops over vertices and cage triangles, in double: distance to the triangle's plane, by barycentric
/// coordinates, and to its three edges; the least of them to the power of -exponent; then each row divided by
/// its sum. Two arrays, distances and weights, of n rows of k each.
class PlainWeights {
public:
  PlainWeights(std::size_t vertices, std::size_t elements)
      : distances_(vertices * elements), weights_(vertices * elements) {}

  void compute(std::span<const mesh::Point> positions, const deform::Cage& cage, double exponent = 2);
  std::span<const double> weights() const { return weights_; }

private:
  std::vector<double> distances_, weights_;
};

}  // namespace viete::bench
