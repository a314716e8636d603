#include "app/bound.h"

#include "base/memory.h"
#include "base/worker_pool.h"
#include "pose/deformer.h"
#include "weights/bind.h"
#include "weights/tiled_binding.h"

namespace viete::app {

namespace {

std::shared_ptr<const weights::Binding> bind_draft(const std::shared_ptr<const mesh::Draft>& draft,
                                                   const pose::Cage& cage, const weights::TiledBinding& whole,
                                                   base::WorkerPool& pool, base::Progress& progress) {
  const auto slots = weights::slots_of(whole.leaves);
  const auto row = [&](std::uint32_t v, std::span<double> weights) {
    whole.kept_row(slots[draft->vertices[v]], weights);
  };
  progress.section(progress.done(), 1);
  auto tiles = std::make_shared<const weights::TiledBinding>(weights::bind_tiles(
      draft->surface, cage, whole.weighting, pool, weights::usual_tolerance, &progress, {}, row));
  const std::shared_ptr<const mesh::Surface> surface(draft, &draft->surface);
  return std::make_shared<const weights::Binding>(weights::with_tiles(surface, cage, std::move(tiles)));
}

}  // namespace

Bound bind(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const pose::Cage> cage,
           const pose::Deformer& deformer, sym3::Method method, const Bound& known, base::Progress& progress,
           const std::shared_ptr<const mesh::Draft>& draft) {
  using pose::EngineKind;
  const pose::Weighting& weighting = deformer.weighting;
  base::WorkerPool pool;
  const bool same = known.binding && known.model == model && known.cage == cage;
  const bool shared = same && known.binding->weighting == weighting;
  Bound bound{model, cage, shared ? known.binding : nullptr, same ? known.stitching : nullptr,
              shared ? known.draft : nullptr};
  auto& binding = bound.binding;
  const bool staged = pose::engine_for(deformer, method) == EngineKind::staged;
  if (!binding || !binding->tiles) {
    if (staged) progress.section(0, 0.5);
    binding = std::make_shared<const weights::Binding>(
        weights::bind(model, *cage, weighting, EngineKind::fused, nullptr, pool, &progress));
  }
  if (staged && binding->weights.empty()) {
    progress.section(progress.done(), 1);
    binding = std::make_shared<const weights::Binding>(
        weights::bind(model, *cage, weighting, EngineKind::staged, binding.get(), pool, &progress));
  }
  if (draft && !bound.draft) bound.draft = bind_draft(draft, *cage, *binding->tiles, pool, progress);
  if (deformer.stitched() && !bound.stitches(deformer)) {
    progress.section(progress.done(), 1);
    bound.stitching =
        std::make_shared<const deform::Stitching>(deform::stitch(*model, *cage, pool, deformer, &progress));
  }
  base::release_freed_memory();
  return bound;
}

}  // namespace viete::app
