// The deformation once more, from its formulas alone: in quad precision, sharing the tables of choices
// and no more with src/deform.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "deform/scheme.h"
#include "mesh/surface.h"

namespace viete::test {

struct IndependentPose {
  std::vector<mesh::Point> positions;
  std::array<double, 3> turn{0, 0, 0};  ///< rotation vector that all logs together are nearest to
  double moment_length = 0;             ///< of the clouds about points that maps are fitted to
  /// Of weights along the surface, a row a point: they are given, as they have tests of their own.
  std::span<const double> weights{};
};

struct IndependentFrame {
  std::vector<mesh::Point> positions;  ///< of the points, rounded to double at the very end
  double largest_step = 0;             ///< radians between rotations of neighbouring maps, the largest
};

/// Points moved by a posed cage, from the papers. Maps: of triangles with a normal of length sqrt|N|; of
/// patches, by the normal equations of patch_maps.h. Weights: d^-2, (1 - d/r)^2, or mean value coordinates by
/// spherical triangles (Ju, Schaefer, Warren, SIGGRAPH 2005, figure 4); what they miss to 1 the identity
/// about the point has. Blends: exp(Y) exp(X) (x - sum w c) + sum w c', or the sum of maps. Moving least
/// squares: the map that takes points to where they are posed, means aside, with the least sum of squares,
/// among all, similarities, or rotations, and of the way there the share that weights sum to.
///
/// The cage is one closed part of triangles that have area at rest and posed, its patches are not flat, and
/// points do not lie on it. Logs follow their neighbours breadth first, so the answer is the only sensible
/// one where largest_step is below a quarter turn. Amounts and iterations of the scheme are not looked at.
IndependentFrame deform_independently(std::span<const mesh::Point> points, const mesh::Surface& cage,
                                      const IndependentPose& pose, const deform::Scheme& scheme);

}  // namespace viete::test
