// Makes closed cages of a requested size that enclose the model.
#pragma once

#include <optional>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/subject.h"
#include "cages/wish.h"

namespace viete::cages {

/// Extracts an offset surface from a distance grid by marching cubes, simplifies it by edge collapses and
/// tightens it. With a mirror plane, makes one half of the cage and mirrors it. If the cage needs too many
/// triangles, closes holes and gaps of the model and adds a message. Returns nullopt if no sound cage was
/// found. Throws like Maker::make().
std::optional<Made> make_automatic(const Subject& subject, const Wish& wish, base::WorkerPool& pool,
                                   base::Progress* progress);

}  // namespace viete::cages
