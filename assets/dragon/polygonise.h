// Turns the zero level of a field into a closed triangle mesh.
#pragma once

#include "dragon/field.h"
#include "dragon/mesh.h"

namespace viete::dragon {

/// Marching tetrahedra on a lattice of the given spacing, six tetrahedra a cell about its main diagonal
/// (Kuhn's subdivision): closed and manifold by construction, whatever the field.
Mesh polygonise(const Field& field, double spacing);

}  // namespace viete::dragon
