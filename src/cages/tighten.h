// A cage drawn in against its model, and made even.
#pragma once

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

/// Moves each vertex inward as far as the cage stays sound (see WorkingCage), and along the surface towards
/// the middle of its neighbours; turns edges where that makes better triangles or a smaller cage. So many
/// rounds; more of them change less. Throws base::Cancelled.
void tighten(WorkingCage& cage, int rounds, base::Progress* progress);

/// Splits the edges from which most volume can be drawn in, until there are so many triangles. Throws
/// base::Cancelled.
void refine_to(WorkingCage& cage, std::size_t triangles, base::Progress* progress);

/// Moves the neighbours of a vertex inward, once.
void tighten_around(WorkingCage& cage, VertexId v);

}  // namespace viete::cages
