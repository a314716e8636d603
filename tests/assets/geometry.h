// Distance, inside and self-intersection of closed surfaces, for the tests of the bundled cage.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "mesh/surface.h"

namespace viete::test {

/// The distance of a point from the nearest triangle.
double distance(const mesh::Point& p, const mesh::Surface& surface);

/// How often the closed surface winds about the point: 1 inside, 0 outside, when it is oriented outwards.
double winding_number(const mesh::Point& p, const mesh::Surface& surface);

/// Two triangles, an edge of the first passing through the second and sharing no corner with it; empty if
/// none.
std::optional<std::pair<std::size_t, std::size_t>> self_intersection(const mesh::Surface& surface);

}  // namespace viete::test
