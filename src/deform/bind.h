// Binds a model to a cage.
#pragma once

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"

namespace viete::deform {

/// Binds for the staged engine. Cost O(n k), shared over the pool; the result does not depend on the number
/// of threads. Throws base::Cancelled; throws base::Error if free memory is insufficient, the model has no
/// vertices or, for weights along its surface, no triangles.
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, base::WorkerPool& pool,
             base::Progress* progress = nullptr);

/// Binds for this engine, sharing data of `known` (same model and cage, or null) if possible. As bind().
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, EngineKind engine,
             const Binding* known, base::WorkerPool& pool, base::Progress* progress = nullptr);

}  // namespace viete::deform
