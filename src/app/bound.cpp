#include "app/bound.h"

#include <utility>

#include "base/worker_pool.h"

namespace viete::app {

Bound bind(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const deform::Cage> cage,
           deform::Coordinates coordinates, sym3::Method method, const Bound& known, base::Progress& progress) {
  using deform::Path;
  base::WorkerPool pool;
  const bool shared = known.binding && known.model == model && known.cage == cage && known.binding->coordinates == coordinates;
  auto binding = shared ? known.binding : nullptr;
  const bool staged = coordinates == deform::Coordinates::face && method != sym3::Method::fast;
  if (!binding || !binding->tiles) {
    if (staged) progress.section(0, 0.5);
    binding = std::make_shared<const deform::Binding>(
        deform::bind(*model, *cage, coordinates, Path::fused, nullptr, pool, &progress));
  }
  if (staged && binding->weights.empty()) {
    progress.section(progress.done(), 1);
    binding = std::make_shared<const deform::Binding>(
        deform::bind(*model, *cage, coordinates, Path::staged, binding.get(), pool, &progress));
  }
  return {std::move(model), std::move(cage), std::move(binding)};
}

}  // namespace viete::app
