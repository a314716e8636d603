// Automatic cages: closed, enclosing the model, of the requested size.
#pragma once

#include <optional>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/subject.h"
#include "cages/wish.h"

namespace viete::cages {

/// Computes distances on a grid, extracts an offset surface by marching cubes, simplifies it by edge
/// collapses and tightens it. With a mirror it makes one half and adds its image. Holes through the model
/// stay open if the size allows; notes report those closed by a larger gap. Empty if no valid cage of that
/// size was found. See Maker::make() for errors.
std::optional<Made> make_automatic(const Subject& subject, const Wish& wish, base::WorkerPool& pool,
                                   base::Progress* progress);

}  // namespace viete::cages
