// The lazy way to a cage, to compare with.
#pragma once

#include <cstddef>

#include "base/worker_pool.h"
#include "mesh/surface.h"

namespace viete::bench {

/// The model's surface at an offset, decimated by OpenMesh's quadrics to so many triangles, at ever larger
/// offsets until it encloses the model; without triangles if none does. The model has an extent.
mesh::Surface lazy_cage(const mesh::Surface& model, std::size_t triangles, base::WorkerPool& pool);

}  // namespace viete::bench
