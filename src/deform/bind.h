// Binds a model to a cage.
#pragma once

#include <cstddef>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"

namespace viete::deform {

/// Binds for the staged engine, in time proportional to vertices times handles. The result does not depend on
/// the number of threads. Throws base::Cancelled. Throws base::Error if free memory is insufficient, if the
/// model has no vertices, or if weights along the surface are wanted and the model has no triangles.
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, base::WorkerPool& pool,
             base::Progress* progress = nullptr);

/// As above, for any engine. Shares data with `known` if possible: null, or a binding of this model and cage.
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, EngineKind engine,
             const Binding* known, base::WorkerPool& pool, base::Progress* progress = nullptr);

}  // namespace viete::deform
