// Bases of triangles, at rest and posed.
#pragma once

#include <span>

#include "mesh/surface.h"

namespace viete::deform {

using mesh::cross, mesh::dot, mesh::largest_abs, mesh::norm, mesh::relative_to, mesh::squared_norm;
using mesh::Vec3;

/// Two edges u and v of a triangle from one of its corners, and n = N / sqrt|N|, N = u x v; 0 without area.
struct TriangleBasis {
  Vec3 u, v, n;
};
TriangleBasis triangle_basis(std::span<const mesh::Point> positions, const mesh::Triangle& triangle,
                             int corner);

/// A basis of an element at rest, as its map needs it: edges u and v from one of its corners, n = N / sqrt|N|
/// with N = u x v; and the dual basis, the rows of [u v n]^-1.
struct RestBasis {
  int corner = 0;
  Vec3 u{}, v{}, n{}, dual_u{}, dual_v{}, dual_n{};
};

/// x / sqrt|x| of an area x: as long as its side. Any length scale; 0 for 0.
Vec3 side_along(const Vec3& area);

/// Of a triangle of these positions.
RestBasis rest_basis(std::span<const mesh::Point> positions, const mesh::Triangle& triangle);

}  // namespace viete::deform
