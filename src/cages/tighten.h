// Tightens a cage around its model and evens out its triangles.
#pragma once

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

/// In each round, flips edges, evens out the triangles and moves each vertex inward, as far as the cage stays
/// sound. Throws base::Cancelled.
void tighten(WorkingCage& cage, int rounds, base::Progress* progress);

/// Splits the edges that reduce the volume most, up to this many triangles. Throws base::Cancelled.
void refine_to(WorkingCage& cage, std::size_t triangles, base::Progress* progress);

/// Moves each neighbour of the vertex inward.
void tighten_around(WorkingCage& cage, VertexId v);

}  // namespace viete::cages
