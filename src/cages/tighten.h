// Tightens a cage around its model, and makes its triangles more even.
#pragma once

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

/// In each round, flips edges, makes triangles more even, and moves each vertex inward while the cage stays
/// sound. Throws base::Cancelled.
void tighten(WorkingCage& cage, int rounds, base::Progress* progress);

/// Splits the edges that reduce the volume most, until the cage has `triangles`. Throws base::Cancelled.
void refine_to(WorkingCage& cage, std::size_t triangles, base::Progress* progress);

/// Moves each neighbour of the vertex inward.
void tighten_around(WorkingCage& cage, VertexId v);

}  // namespace viete::cages
