// The deformation once more, from its formulas alone: in quad precision, sharing no code with src/deform.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::test {

/// What the model's vertices follow.
enum class IndependentScheme {
  faces_srl,
  faces_slrl,
  faces_sql,
  faces_log3,
  faces_sse,
  faces_log4,
  faces_linear,
  face_integrals_srl,
  points_mean_value,
  points_affine,
  points_similar,
  points_rigid
};

/// What each vertex of the cage has about it where maps are fitted to vertices: given, as it has tests of its
/// own.
struct IndependentClouds {
  double radius = 0;
  std::vector<std::array<double, 9>> maps;  ///< of each, by rows
};

struct IndependentPose {
  std::vector<mesh::Point> positions;
  std::array<double, 3> turn{0, 0, 0};  ///< rotation vector that all logs together are nearest to
  IndependentClouds clouds{};
};

struct IndependentFrame {
  std::vector<mesh::Point> positions;  ///< of the points, rounded to double at the very end
  double largest_step = 0;             ///< radians between rotations of neighbouring triangles, the largest
};

/// Points moved by a posed cage, from the papers: affine maps of triangles with a normal of length sqrt|N|,
/// weights d^-2 (within `reach`, see inverse_distance.h; infinity: everywhere), integrals of r^-4 or mean
/// value coordinates by spherical triangles (Ju, Schaefer, Warren, SIGGRAPH 2005, figure 4), and exp(Y)
/// exp(X) (x - sum w c) + sum w c', or the sums of RowForm for other blends; logs of whole matrices are
/// principal ones. Moving least squares: the map that takes points to where they are posed, means aside, with
/// the least sum of squares, among all, similarities, or rotations. The cage is one closed part whose
/// triangles have area at rest and posed, points do not lie on it. Logs follow their neighbours breadth
/// first, so the answer is the only sensible one where largest_step is below a quarter turn.
IndependentFrame deform_independently(std::span<const mesh::Point> points, const mesh::Surface& cage,
                                      const IndependentPose& pose, IndependentScheme scheme, double reach);

}  // namespace viete::test
