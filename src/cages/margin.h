// The distance that a cage keeps from its model, exactly.
#pragma once

#include <cstddef>

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

/// Moves vertices of triangles that are nearer to the model than the margin outward, until none is, or as far
/// as the cage stays sound: the clearance is interpolated, this is exact. Returns how many are left. progress
/// may be null; throws base::Cancelled.
std::size_t keep_margin(WorkingCage& cage, double margin, base::Progress* progress);

}  // namespace viete::cages
