#include "app/bound.h"

#include <utility>

#include "base/worker_pool.h"

namespace viete::app {

Bound bind(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const deform::Cage> cage,
           deform::Coordinates coordinates, base::Progress& progress) {
  base::WorkerPool pool;
  auto binding =
      std::make_shared<const deform::Binding>(deform::bind(*model, *cage, coordinates, pool, &progress));
  return {std::move(model), std::move(cage), std::move(binding)};
}

}  // namespace viete::app
