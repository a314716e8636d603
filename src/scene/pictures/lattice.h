// Surfaces of boxes side by side, as small examples are made of.
#pragma once

#include <functional>
#include <vector>

#include "mesh/surface.h"

namespace viete::scene {

/// Where a lattice is cut, along each axis, ascending: two places or more.
struct Lattice {
  std::vector<double> x, y, z;
};

/// True for a cell that is filled, by its place along each axis.
using Filled = std::function<bool(int x, int y, int z)>;

/// What encloses the cells that are filled: quads, outward, corners shared.
mesh::Surface lattice_surface(const Lattice& lattice, const Filled& filled);
/// All of them are.
mesh::Surface lattice_surface(const Lattice& lattice);

/// So many equal steps from low to high: steps + 1 places.
std::vector<double> even(double low, double high, int steps);

}  // namespace viete::scene
