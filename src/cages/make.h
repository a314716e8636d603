// A cage around a model, of any kind: the door of this room.
#pragma once

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/wish.h"
#include "mesh/surface.h"

namespace viete::cages {

/// A closed, oriented manifold without self-intersection that encloses every triangle of the model, or every
/// point where it has none, at about the wished distance. Same bits for any pool. Any length scale from 1e-60
/// to 1e60. progress may be null. Throws base::Error if the model is a single point or has none; throws
/// base::Cancelled.
Made make(const mesh::Surface& model, const Wish& wish, base::WorkerPool& pool,
          base::Progress* progress = nullptr);

}  // namespace viete::cages
