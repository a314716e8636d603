// Fits a cage to the model's box, and moves the cage outward to enclose model vertices.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/surface.h"

namespace viete::cages {

struct Fitted {
  std::vector<mesh::Point> positions;  ///< the new positions of the cage
  double scale = 1;
};

/// Moves and uniformly scales the cage so that it encloses the model's bounding box. `margin` is the distance
/// on each side, relative to the model's diagonal. Neither surface may be a single point.
Fitted fitted_to_box(const mesh::Surface& cage, const mesh::Surface& model, double margin);

struct Enclosing {
  std::vector<mesh::Point> positions;  ///< the new positions of the cage
  std::size_t left = 0;                ///< the number of model vertices that are still outside
};

/// Moves cage faces, split as in mesh::CenterSplit, outward past the model vertices that are outside, and
/// then farther by `margin` * the model's diagonal. Stops after several rounds, even if vertices are left.
/// Requires a closed cage.
Enclosing enclose(const mesh::Surface& cage, const mesh::Surface& model, double margin);

}  // namespace viete::cages
