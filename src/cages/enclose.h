// Fits a cage to the size and position of its model, and moves it outward around model vertices outside it.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/surface.h"

namespace viete::cages {

struct Fitted {
  std::vector<mesh::Point> positions;  ///< the new positions of the cage
  double scale = 1;
};

/// Translates and uniformly scales the cage to enclose the model's bounding box, with a margin on each side.
/// `margin` is relative to the model's diagonal. Neither surface may be a single point.
Fitted fitted_to_box(const mesh::Surface& cage, const mesh::Surface& model, double margin);

struct Enclosing {
  std::vector<mesh::Point> positions;  ///< the new positions of the cage
  std::size_t left = 0;                ///< the number of model vertices that are still outside
};

/// Moves cage triangles outward past the model vertices outside the cage, in several rounds. The added
/// distance is `margin` times the model's diagonal. Requires a closed cage.
Enclosing enclose(const mesh::Surface& cage, const mesh::Surface& model, double margin);

}  // namespace viete::cages
