// The deformation evaluated independently from its formulas, in quad precision; shares only the tables of
// choices with src/deform.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "deform/scheme.h"
#include "mesh/surface.h"

namespace viete::test {

struct IndependentPose {
  std::vector<mesh::Point> positions;
  std::array<double, 3> turn{0, 0, 0};  ///< reference rotation vector of all logs
  double moment_length = 0;             ///< radius of the clouds around points of fitted maps
  /// Weights along the surface, one row per point; given as input, since they have tests of their own.
  std::span<const double> weights{};
};

struct IndependentFrame {
  std::vector<mesh::Point> positions;  ///< positions of the points, rounded to double at the end
  double largest_step = 0;             ///< largest angle in radians between rotations of neighbouring maps
};

/// Points moved by a posed cage, from the papers. Maps: of triangles with a normal of length sqrt|N|; of
/// patches, by the normal equations of patch_maps.h. Weights: d^-2, (1 - d/r)^2, or mean value coordinates by
/// spherical triangles (Ju, Schaefer, Warren, SIGGRAPH 2005, figure 4), completed to sum 1 by the identity
/// about the point. Blends: exp(Y) exp(X) (x - sum w c) + sum w c', or the sum of maps. Moving least squares:
/// the least-squares map of points to posed points, means removed, among all maps, similarities, or
/// rotations; displacements are scaled by the sum of weights.
///
/// The cage must be one closed part of triangles with area at rest and posed, its patches not flat, and
/// points not on it. Logs follow their neighbours breadth-first, so the result is unique if largest_step is
/// below a quarter turn. Ignores amounts and iterations of the scheme.
IndependentFrame deform_independently(std::span<const mesh::Point> points, const mesh::Surface& cage,
                                      const IndependentPose& pose, const deform::Scheme& scheme);

}  // namespace viete::test
