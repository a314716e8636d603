// A cage made around any model: closed, enclosing, of the size that is asked for.
#pragma once

#include <optional>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/subject.h"
#include "cages/wish.h"

namespace viete::cages {

/// Computes distances on a grid, extracts an offset surface by marching cubes, simplifies it by edge collapses
/// and draws it in against the model. With a mirror it makes one half and adds its image. Holes through the
/// model stay open where the size allows; a note names those a larger gap closes. Returns nothing if it finds
/// no valid cage of that size. See Maker::make() for errors.
std::optional<Made> make_automatic(const Subject& subject, const Wish& wish, base::WorkerPool& pool,
                                   base::Progress* progress);

}  // namespace viete::cages
