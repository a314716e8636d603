// Simplification of a cage that keeps it around the model.
#pragma once

#include <cstddef>

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

enum class Accuracy { quadrics, volume };

/// Collapses edges, cheapest first, until at most `triangles` are left. Quadrics: cost is the squared
/// distance to the planes (Garland and Heckbert 1997, Surface simplification using quadric error metrics);
/// the new vertex is placed at the minimum, or farther outward if the cage needs it to stay sound (see
/// WorkingCage). Volume: cost is the added volume after tightening, and neighbours are tightened after each
/// collapse; about a hundred times slower. If no edge can be collapsed, permits worse triangle shapes in two
/// steps. Returns whether it reached the number. progress may be null; throws base::Cancelled.
bool collapse_to(WorkingCage& cage, std::size_t triangles, Accuracy accuracy, base::Progress* progress);

}  // namespace viete::cages
