// Parts of a surface that lie close to each other and face each other, as an arm and the flank beside it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::lab {

inline constexpr std::uint32_t no_partner = ~0u;

/// Of each vertex the nearest one, at most so far away, that it sees before it, and that looks back: what
/// lies between the two is open. no_partner where there is none. Normals are of length 1. Some 50 ms for
/// 50,000 vertices and a distance of 3 % of their diagonal.
std::vector<std::uint32_t> facing_vertices(std::span<const mesh::Point> positions,
                                           std::span<const mesh::Vec3> normals, double distance);

}  // namespace viete::lab
