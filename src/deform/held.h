// The anchor of each part of a moving shape, since the logs of triangles do not determine translations.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "mesh/adjacency.h"

namespace viete::deform {

/// Connected parts of a mesh.
struct HangingParts {
  mesh::Adjacency vertices;  ///< vertices of each connected part, without loose ones
  std::vector<bool> loose;   ///< vertices of no triangle

  std::size_t count() const { return vertices.starts.size() - 1; }
};

/// Shares of each vertex in the anchor of its part, the point that moves on a straight line. The anchor is a
/// mean of vertices that favours those that move least: a resting region stays, and a limb rotates about its
/// joint. If the part moves by an affine map, the anchor is the point that this map moves least: a part that
/// rotates as a whole rotates about its axis.
using Held = std::vector<double>;

/// from: positions; ways: displacements; squares: squared lengths of displacements, or sums of such.
Held held(const HangingParts& parts, std::span<const Vec3> from, std::span<const Vec3> ways,
          std::span<const double> squares);

/// Translates each part so that its anchor follows its straight line.
void hold(const HangingParts& parts, const Held& held, std::span<const Vec3> straight, std::span<Vec3> ways);

/// Translates each part so that the mean of its displacements is 0.
void center(const HangingParts& parts, std::span<Vec3> ways);

}  // namespace viete::deform
