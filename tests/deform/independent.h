// Evaluates the deformation in quad precision from its formulas. Uses no code of src/deform.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/surface.h"
#include "pose/deformer.h"
#include "pose/maps.h"

namespace viete::test {

struct IndependentPose {
  std::vector<mesh::Point> positions;
  std::array<double, 3> turn{0, 0, 0};  ///< the logs are the branches near this rotation vector
  double moment_length = 0;             ///< the radius of the point clouds for fitted maps
  // The next two members are not computed again here, because other tests check them.
  std::span<const double> weights{};           ///< weights along the surface, one row per point
  std::span<const pose::AffineMap> patches{};  ///< maps of patches, one per vertex of the cage
};

struct IndependentFrame {
  std::vector<mesh::Point> positions;  ///< the points' positions, rounded to double at the end
  double largest_step = 0;             ///< the largest angle between neighbouring maps, in radians
};

/// Moves points by a posed cage, with the formulas of the papers:
///   - The map of a triangle maps two sides and the vector N / sqrt|N|. N is the cross product of the sides.
///   - Weights are d^-2, (1 - d / r)^2, or mean value coordinates by spherical triangles (Ju, Schaefer,
///     Warren, SIGGRAPH 2005, figure 4). The identity gets the remaining weight.
///   - Blends are exp(Y) * exp(X) * (x - sum w * c) + sum w * c', the sum of maps, or moving least squares.
///   - Each log is the branch nearest to a neighbour's log. This is unique if largest_step < a quarter turn.
/// The cage must be one closed part. Its triangles must have area at rest and posed. No point may be on the
/// cage. Ignores the deformer's amounts and iterations.
IndependentFrame deform_independently(std::span<const mesh::Point> points, const mesh::Surface& cage,
                                      const IndependentPose& pose, const pose::Deformer& deformer);

}  // namespace viete::test
