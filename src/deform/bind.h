// Binds a model to a cage.
#pragma once

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"

namespace viete::deform {

/// Binds a model for the staged engine. The time is proportional to vertices times handles. The result does
/// not depend on the number of threads. Throws base::Cancelled. Throws base::Error if free memory is
/// insufficient, if the model has no vertices, or if the weights are along the surface and the model has no
/// triangles.
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, base::WorkerPool& pool,
             base::Progress* progress = nullptr);

/// Binds a model for any engine. `known` is null, or a binding of this model and cage to share data with.
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, EngineKind engine,
             const Binding* known, base::WorkerPool& pool, base::Progress* progress = nullptr);

}  // namespace viete::deform
