// Evaluates the deformation in quad precision from its formulas. Uses no code of src/deform.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "deform/maps.h"
#include "deform/scheme.h"
#include "mesh/surface.h"

namespace viete::test {

struct IndependentPose {
  std::vector<mesh::Point> positions;
  std::array<double, 3> turn{0, 0, 0};  ///< the rotation vector to which all logs are near
  double moment_length = 0;             ///< the radius of the point clouds for fitted maps
  // The next two members are inputs, because they have their own tests.
  std::span<const double> weights{};             ///< along the surface, one row per point
  std::span<const deform::AffineMap> patches{};  ///< one per vertex of the cage
};

struct IndependentFrame {
  std::vector<mesh::Point> positions;  ///< the points' positions, rounded to double at the end
  double largest_step = 0;             ///< the largest angle between neighbouring maps, in radians
};

/// Moves points by a posed cage, with the formulas of the papers. The maps belong to triangles whose normals
/// have the length sqrt|N|. Weights are d^-2, (1 - d/r)^2, or mean value coordinates by spherical triangles
/// (Ju, Schaefer, Warren, SIGGRAPH 2005, figure 4). The identity about the point completes the weights to sum
/// 1. Blends are exp(Y) exp(X) (x - sum w c) + sum w c', or the sum of maps. Moving least squares fits a
/// general map, a similarity or a rotation to points about their means. The sum of weights scales
/// displacements. The cage must be one closed part. Its triangles must have area at rest and posed, and no
/// point may be on the cage. A log continues from its neighbours, so the result is unique if largest_step is
/// below a quarter turn. Ignores the amounts and iterations of the scheme.
IndependentFrame deform_independently(std::span<const mesh::Point> points, const mesh::Surface& cage,
                                      const IndependentPose& pose, const deform::Scheme& scheme);

}  // namespace viete::test
