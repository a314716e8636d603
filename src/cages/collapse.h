// Simplifies a cage and keeps it sound.
#pragma once

#include <cstddef>

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

/// The cost of a collapse. `quadrics` is the squared distance to the planes of the triangles (Garland and
/// Heckbert 1997, Surface simplification using quadric error metrics). `volume` is the added volume after
/// tightening; it is about a hundred times slower.
enum class Accuracy { quadrics, volume };

/// Collapses edges in the order of their cost, until at most `triangles` are left. Each collapse keeps the
/// cage sound. If no edge can be collapsed, permits worse triangle shapes. Returns false if more triangles
/// are left. `progress` may be null. Throws base::Cancelled.
bool collapse_to(WorkingCage& cage, std::size_t triangles, Accuracy accuracy, base::Progress* progress);

}  // namespace viete::cages
