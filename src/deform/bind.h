// Binds a model to a cage.
#pragma once

#include <cstddef>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"

namespace viete::deform {

/// Bytes that bind() requires before it begins, for n vertices and k handles; at most 2^63. An upper bound
/// for the fused engine; it assumes a quarter of the weights' size if they can be compressed (affine maps
/// only). Weights along the surface are computed for all vertices before compression.
std::size_t binding_bytes(std::size_t vertices, std::size_t handles, EngineKind engine = EngineKind::staged,
                          const Weighting& weighting = {});

/// Binds for the staged engine. Cost O(n k), shared over the pool; the result does not depend on the number
/// of threads. Throws base::Cancelled; throws base::Error if free memory is insufficient, the model has no
/// vertices or, for weights along its surface, no triangles.
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, base::WorkerPool& pool,
             base::Progress* progress = nullptr);

/// Binds for this engine, sharing data of `known` (same model and cage, or null) if possible. As bind().
Binding bind(const mesh::Surface& model, const Cage& cage, const Weighting& weighting, EngineKind engine,
             const Binding* known, base::WorkerPool& pool, base::Progress* progress = nullptr);

}  // namespace viete::deform
