// Fewer triangles, edge by edge, that still enclose the model.
#pragma once

#include <cstddef>

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

enum class Accuracy { quadrics, volume };

/// Collapses edges until no more than `triangles` are left, those first whose end changes the surface least.
/// Quadrics: by the squared distances to its planes (Garland and Heckbert 1997, Surface simplification using
/// quadric error metrics). What is left of an edge is put where these are least, or outward of that as far as
/// the cage needs to stay sound (see WorkingCage). Volume: by what it adds to the cage's volume once it is
/// drawn in, and its neighbours are drawn in each time: some hundred times as slow. Where nothing more can
/// go, triangles of a worse shape are let through, in two steps. Returns whether it got there. progress may
/// be null; throws base::Cancelled.
bool collapse_to(WorkingCage& cage, std::size_t triangles, Accuracy accuracy, base::Progress* progress);

}  // namespace viete::cages
