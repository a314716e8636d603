#include "app/bound.h"

#include "base/memory.h"
#include "base/worker_pool.h"
#include "deform/bind.h"
#include "deform/scheme.h"
#include "deform/tiled_binding.h"

namespace viete::app {

namespace {

std::shared_ptr<const deform::Binding> bind_draft(const std::shared_ptr<const mesh::Draft>& draft,
                                                  const deform::Cage& cage, const deform::TiledBinding& whole,
                                                  base::WorkerPool& pool, base::Progress& progress) {
  const auto slots = deform::slots_of(whole.leaves);
  const auto row = [&](std::uint32_t v, std::span<double> weights) {
    whole.kept_row(slots[draft->vertices[v]], weights);
  };
  progress.section(progress.done(), 1);
  auto tiles = std::make_shared<const deform::TiledBinding>(deform::bind_tiles(
      draft->surface, cage, whole.weighting, pool, deform::usual_tolerance, &progress, {}, row));
  const std::shared_ptr<const mesh::Surface> surface(draft, &draft->surface);
  return std::make_shared<const deform::Binding>(deform::with_tiles(surface, cage, std::move(tiles)));
}

}  // namespace

Bound bind(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const deform::Cage> cage,
           const deform::Scheme& scheme, sym3::Method method, const Bound& known, base::Progress& progress,
           const std::shared_ptr<const mesh::Draft>& draft) {
  using deform::EngineKind;
  const deform::Weighting& weighting = scheme.weighting;
  base::WorkerPool pool;
  const bool same = known.binding && known.model == model && known.cage == cage;
  const bool shared = same && known.binding->weighting == weighting;
  Bound bound{model, cage, shared ? known.binding : nullptr, same ? known.stitching : nullptr,
              shared ? known.draft : nullptr};
  auto& binding = bound.binding;
  const bool staged = deform::engine_for(scheme, method) == EngineKind::staged;
  if (!binding || !binding->tiles) {
    if (staged) progress.section(0, 0.5);
    binding = std::make_shared<const deform::Binding>(
        deform::bind(model, *cage, weighting, EngineKind::fused, nullptr, pool, &progress));
  }
  if (staged && binding->weights.empty()) {
    progress.section(progress.done(), 1);
    binding = std::make_shared<const deform::Binding>(
        deform::bind(model, *cage, weighting, EngineKind::staged, binding.get(), pool, &progress));
  }
  if (draft && !bound.draft) bound.draft = bind_draft(draft, *cage, *binding->tiles, pool, progress);
  if (scheme.stitched() && !bound.stitches(scheme)) {
    progress.section(progress.done(), 1);
    bound.stitching =
        std::make_shared<const deform::Stitching>(deform::stitch(*model, *cage, pool, scheme, &progress));
  }
  base::release_freed_memory();
  return bound;
}

}  // namespace viete::app
