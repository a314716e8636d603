// Three shapes of the dragon: its own vertices elsewhere, carried by its bones.
#pragma once

#include <string>
#include <vector>

#include "dragon/mesh.h"

namespace viete::dragon {

struct Shape {
  std::string name;
  std::vector<Vec3> positions;  ///< of the model's vertices; it stands on y = 0
};

/// Wings folded, coiled, sitting.
std::vector<Shape> dragon_shapes(const Mesh& dragon);

}  // namespace viete::dragon
