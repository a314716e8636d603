// A cage brought to its model: fitted to its box, and moved outward where the model sticks out.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/surface.h"

namespace viete::cages {

/// Moved, and scaled by the same factor along all axes, so that its box is the model's and `margin` of the
/// model's diagonal more on each side, as far as their proportions allow: it is nowhere smaller. Requires
/// that both have an extent.
std::vector<mesh::Point> fitted_to_box(const mesh::Surface& cage, const mesh::Surface& model, double margin);

struct Enclosing {
  std::vector<mesh::Point> positions;  ///< of the cage's vertices
  std::size_t left = 0;                ///< vertices of the model that are still outside
};

/// Moves triangles of the cage outward by what model vertices are beyond them, and `margin` of the model's
/// diagonal more, in some rounds; those that are near the model without cutting it stay. Requires a closed
/// cage.
Enclosing enclose(const mesh::Surface& cage, const mesh::Surface& model, double margin);

}  // namespace viete::cages
