// A cage drawn in against its model, and made even.
#pragma once

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

/// Moves each vertex inward as far as the cage stays sound (see WorkingCage), and along the surface towards
/// the middle of its neighbours; turns edges where that makes better triangles or a smaller cage. So many
/// rounds; more of them change less. Throws base::Cancelled.
void tighten(WorkingCage& cage, int rounds, base::Progress* progress = nullptr);

/// Moves vertices of triangles that are nearer to the model than the margin outward, until none is, or as far
/// as the cage stays sound: the clearance is interpolated, this is exact. Returns how many are left.
std::size_t keep_margin(WorkingCage& cage, double margin);

/// Splits the edges from which most volume can be drawn in, until there are so many triangles.
void refine_to(WorkingCage& cage, std::size_t triangles);

/// Moves the neighbours of a vertex inward, once.
void tighten_around(WorkingCage& cage, VertexId v);

}  // namespace viete::cages
