// Boxes around a model: the cage that everyone understands.
#pragma once

#include "cages/wish.h"
#include "mesh/surface.h"

namespace viete::cages {

/// The sides of a box as quads, cells[0] x cells[1] x cells[2], wish.margin away from the model's own box,
/// which is along the file's axes or, with own_axes, along those of its inertia. The model has an extent.
Made make_box(const mesh::Surface& model, const Wish& wish);

}  // namespace viete::cages
