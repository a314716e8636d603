// Fits a cage to its model by size and place, and moves it outward where the model sticks out.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/surface.h"

namespace viete::cages {

/// A cage fitted to its model.
struct Fitted {
  std::vector<mesh::Point> positions;  ///< the cage's vertices, fitted
  double scale = 1;
};

/// Translates and scales uniformly so that the cage's box contains the model's box plus `margin` of the
/// model's diagonal on each side, as tightly as possible. Both must have an extent.
Fitted fitted_to_box(const mesh::Surface& cage, const mesh::Surface& model, double margin);

struct Enclosing {
  std::vector<mesh::Point> positions;  ///< the cage's vertices, moved
  std::size_t left = 0;                ///< model vertices that are still outside
};

/// Iteratively moves cage triangles outward to the model vertices beyond them, and by `margin` of the model's
/// diagonal more. Triangles that do not cut the model stay, however near. Requires a closed cage.
Enclosing enclose(const mesh::Surface& cage, const mesh::Surface& model, double margin);

}  // namespace viete::cages
