// Tightens a cage around its model and evens out its triangles.
#pragma once

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

/// For each round: moves each vertex inward as far as the cage stays sound (see WorkingCage) and along the
/// surface towards the mean of its neighbours; flips edges for better triangles or a smaller cage. Later
/// rounds change less. Throws base::Cancelled.
void tighten(WorkingCage& cage, int rounds, base::Progress* progress);

/// Splits the edges that allow the largest decrease in volume, until there are that many triangles. Throws
/// base::Cancelled.
void refine_to(WorkingCage& cage, std::size_t triangles, base::Progress* progress);

/// Moves the neighbours of a vertex inward, once.
void tighten_around(WorkingCage& cage, VertexId v);

}  // namespace viete::cages
