// Where a shape is held while it moves: what the logs of its triangles do not tell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "mesh/adjacency.h"

namespace viete::deform {

/// The vertices that hang together.
struct HangingParts {
  mesh::Adjacency vertices;  ///< of each connected part; without loose ones
  std::vector<bool> loose;   ///< vertices of no triangle

  std::size_t count() const { return vertices.starts.size() - 1; }
};

/// A point of each part goes its straight way: of each vertex its share of that point. It is the mean of the
/// vertices, those counting most that move least, so that what stands still, stands, and a limb turns about
/// where it hangs; or, as far as the part moves as an affine map does, the point that such a map moves least,
/// so that what turns as a whole turns about its axis.
using Held = std::vector<double>;

/// from: where the vertices are; ways: where they go; squares: how far that is, squared, or a sum of such.
Held held(const HangingParts& parts, std::span<const Vec3> from, std::span<const Vec3> ways,
          std::span<const double> squares);

/// Moves each part as a whole so that its held point goes its straight way.
void hold(const HangingParts& parts, const Held& held, std::span<const Vec3> straight, std::span<Vec3> ways);

/// Moves each part as a whole so that its vertices' mean is 0.
void center(const HangingParts& parts, std::span<Vec3> ways);

}  // namespace viete::deform
