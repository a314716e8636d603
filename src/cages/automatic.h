// A cage made around any model: closed, enclosing, of the size that is asked for.
#pragma once

#include <optional>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/subject.h"
#include "cages/wish.h"

namespace viete::cages {

/// Clearances on a grid, the surface at an offset of them by marching cubes, fewer triangles edge by edge,
/// drawn in against the model. With a mirror half of it is made, and its image added. Handles of the model
/// are kept where the size allows, closed by a larger gap where it does not, and a note says so. Where no
/// sound cage of that size is found: nothing. See Maker::make() for the rest.
std::optional<Made> make_automatic(const Subject& subject, const Wish& wish, base::WorkerPool& pool,
                                   base::Progress* progress);

}  // namespace viete::cages
