// Makes closed cages with a requested number of triangles that enclose the model.
#pragma once

#include <optional>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/subject.h"
#include "cages/wish.h"

namespace viete::cages {

/// Extracts an offset surface from a distance grid by marching cubes. Simplifies the surface by edge
/// collapses, and tightens it. If there is a mirror plane, makes one half of the cage and mirrors it. If the
/// cage would need too many triangles, closes holes and gaps of the model, and adds a message. If no sound
/// cage is found, returns nullopt. Throws errors of Maker::make().
std::optional<Made> make_automatic(const Subject& subject, const Wish& wish, base::WorkerPool& pool,
                                   base::Progress* progress);

}  // namespace viete::cages
