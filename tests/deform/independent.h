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
  std::array<double, 3> turn{0, 0, 0};  ///< the logs are the branches near this rotation vector
  double moment_length = 0;             ///< the radius of the point clouds for fitted maps
  // The next two members are inputs, because they have their own tests.
  std::span<const double> weights{};             ///< weights along the surface, one row per point
  std::span<const deform::AffineMap> patches{};  ///< maps of patches, one per vertex of the cage
};

struct IndependentFrame {
  std::vector<mesh::Point> positions;  ///< the points' positions, rounded to double at the end
  double largest_step = 0;             ///< the largest angle between neighbouring maps, in radians
};

/// Moves points by a posed cage, with the formulas of the papers. Maps of triangles use normals with the
/// length sqrt|N|. Weights are d^-2, (1 - d/r)^2, or mean value coordinates by spherical triangles (Ju,
/// Schaefer, Warren, SIGGRAPH 2005, figure 4). If the weights sum to less than 1, the identity gets the rest.
/// Blends are exp(Y) * exp(X) * (x - sum w * c) + sum w * c', or the sum of maps. Moving least squares fits a
/// general map, a similarity or a rotation to the cage's points. The cage must be one closed part. Its
/// triangles must have area at rest and posed, and no point may be on the cage. Each log is the branch
/// nearest to a neighbour's log, so the result is unique if largest_step is below a quarter turn. Ignores the
/// scheme's amounts and iterations.
IndependentFrame deform_independently(std::span<const mesh::Point> points, const mesh::Surface& cage,
                                      const IndependentPose& pose, const deform::Scheme& scheme);

}  // namespace viete::test
