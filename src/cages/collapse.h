// Simplifies a cage, tightens it around its model, and keeps it sound.
#pragma once

#include <cstddef>

#include "base/progress.h"
#include "cages/working_cage.h"

namespace viete::cages {

/// The cost of a collapse. `quadrics` is the sum of squared distances to the planes of the triangles (Garland
/// and Heckbert 1997, Surface simplification using quadric error metrics). `volume` is the volume that the
/// collapse adds after tightening. Computing the volume takes about a hundred times as long.
enum class Accuracy { quadrics, volume };

/// Collapses edges in the order of their cost until at most `triangles` are left. The cage stays sound. If no
/// edge can be collapsed, permits worse triangle shapes. If more triangles are left at the end, returns
/// false. `progress` may be null. Throws base::Cancelled.
bool collapse_to(WorkingCage& cage, std::size_t triangles, Accuracy accuracy, base::Progress* progress);

/// In each round, flips edges, evens out the triangles and moves each vertex inward, as far as the cage stays
/// sound. Throws base::Cancelled.
void tighten(WorkingCage& cage, int rounds, base::Progress* progress);

/// Splits the edges whose split reduces the volume most, up to `triangles` triangles. Throws base::Cancelled.
void refine_to(WorkingCage& cage, std::size_t triangles, base::Progress* progress);

/// Moves each neighbour of the vertex inward.
void tighten_around(WorkingCage& cage, VertexId v);

}  // namespace viete::cages
