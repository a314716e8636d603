// How closely a cage follows its model.
#pragma once

#include "base/worker_pool.h"
#include "mesh/surface.h"

namespace viete::cages {

struct Closeness {
  double least = 0, mean = 0, most = 0;  ///< distances of the model's vertices to the cage, of its diagonal
  double volume = 0;  ///< of the cage, by that of the model; 0 where the model is not closed and has none
};

/// Of the vertices that triangles use, or of all points. Both are not empty. Same bits for any pool.
Closeness closeness(const mesh::Surface& cage, const mesh::Surface& model, base::WorkerPool& pool);

}  // namespace viete::cages
