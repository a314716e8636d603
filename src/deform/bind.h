// Binds a model to a cage.
#pragma once

#include <cstddef>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"

namespace viete::deform {

/// Bytes that bind() asks for before it begins, for n vertices and k handles; at most 2^63. For the fused
/// engine: at most, or where weights can be compressed (those of affine maps), a quarter of that, of which
/// less is left by the compression. Weights along the surface are of all vertices before they are compressed.
std::size_t binding_bytes(std::size_t vertices, std::size_t handles, EngineKind engine = EngineKind::staged,
                          const Weighting& weighting = {});

/// For the staged engine. Cost O(n k), shared over the pool; the result does not depend on the number of
/// threads. Throws base::Cancelled; throws base::Error when the memory that is free now would not suffice,
/// when the model has no vertices, or, for weights along its surface, no triangles.
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, base::WorkerPool& pool,
             base::Progress* progress = nullptr);

/// For the engine; of `known`, a binding of the same model and cage or null, what fits is shared. As bind().
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, EngineKind engine,
             const Binding* known, base::WorkerPool& pool, base::Progress* progress = nullptr);

}  // namespace viete::deform
