// Binds a model to a cage.
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "weights/binding.h"
#include "weights/weigher.h"

namespace viete::weights {

/// Binds a copy of a model for the staged engine, in time proportional to vertices * handles. The result does
/// not depend on the number of threads. Throws base::Cancelled. Throws base::Error if memory is insufficient,
/// if the model has no vertices, or if mean value weights find no consistently oriented cage triangles.
Binding bind(const mesh::Surface& model, const pose::Cage& cage, const pose::Weighting& weighting,
             base::WorkerPool& pool, base::Progress* progress = nullptr);

/// Binds a model for this engine; the binding shares the model. If `known` is not null, reuses known->tiles.
/// `known` must be a binding of the same model, cage and weighting.
Binding bind(std::shared_ptr<const mesh::Surface> model, const pose::Cage& cage,
             const pose::Weighting& weighting, pose::EngineKind engine, const Binding* known,
             base::WorkerPool& pool, base::Progress* progress = nullptr);

/// A binding of points for apply_to_vertices().
struct BoundPart {
  Binding binding;
  std::size_t failed = 0;  ///< vertices without mean value coordinates
};
/// Binds points. If `weights` is empty, computes them; otherwise they are [point][handle], normalised.
BoundPart bind_part(const Weigher& weigher, std::span<const mesh::Point> points,
                    std::vector<double> weights = {});

/// Returns the smooth weights in a binding: those of the staged engine or, if these are missing, of the
/// tiles. Empty for other weights. The binding must outlive the result.
KnownRow known_row(const Binding& binding);
/// Binds some of the vertices whose positions at rest are `rest`, with shares multiplied by the mask. If
/// `row` is empty, computes the weights. `mask` may be null.
BoundPart bind_vertices(const Weigher& weigher, std::span<const mesh::Point> rest, const KnownRow& row,
                        const Mask& mask, std::span<const std::size_t> vertices);

/// Makes a binding for the fused engine from tiles of this model and cage.
Binding with_tiles(std::shared_ptr<const mesh::Surface> model, const pose::Cage& cage,
                   std::shared_ptr<const TiledBinding> tiles);

}  // namespace viete::weights
