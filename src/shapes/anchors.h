// The anchors of a moving shape's parts. Anchors determine translations, which logs do not contain.
#pragma once

#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "pose/cage.h"

namespace viete::shapes {

using mesh::Vec3;

struct AnchoredParts {
  mesh::Adjacency vertices;    ///< vertices of each connected part
  std::vector<bool> loose;     ///< true: the vertex has no triangles and belongs to no part
  std::vector<double> masses;  ///< area around each vertex: factor of its weight in its part's anchor

  std::size_t count() const { return vertices.starts.size() - 1; }
};

/// The weight of each vertex in the anchor of its part. The anchor is a weighted mean of the part's vertices,
/// and moves on a straight line. Vertices that move little have large weights. Therefore a resting region
/// stays, and a limb rotates about its joint. If a part moves by an affine map, the anchor is the point that
/// moves least: for a rotation, a point on the axis.
using AnchorWeights = std::vector<double>;

/// Returns the weights of the anchors of a motion from the positions `from` by `displacements`.
/// `squares` tells how far each vertex moves: usually the squared lengths of `displacements`.
AnchorWeights anchor_weights(const AnchoredParts& parts, std::span<const Vec3> from,
                             std::span<const Vec3> displacements, std::span<const double> squares);

/// Translates each part in `displacements` so that its anchor has equal displacements in `displacements` and
/// `straight`.
void keep_anchors(const AnchoredParts& parts, const AnchorWeights& anchors, std::span<const Vec3> straight,
                  std::span<Vec3> displacements);

/// Translates each part in `displacements` so that the mean displacement of the part is 0.
void center(const AnchoredParts& parts, std::span<Vec3> displacements);

}  // namespace viete::shapes
