// The model bound to the cage for the fused frame: weights as vector code reads them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/aligned.h"
#include "deform/binding.h"
#include "deform/leaves.h"
#include "deform/rings.h"

namespace viete::deform {

/// Everything per slot of the leaves. Weights and offsets are those of Binding, in float: the sums lose about
/// 1e-7 of the cage's diagonal by it.
struct TiledBinding {
  Coordinates coordinates = Coordinates::face;
  std::size_t handles = 0;
  Leaves leaves;
  Rings rings;
  double unit = 1;  ///< a power of two near the cage's diagonal: lengths are stored as multiples of it
  AlignedVector<float> weights;  ///< [tile][handle][lane]
  AlignedVector<float> offsets;  ///< [tile][3][lane], in units

  std::size_t bytes() const;  ///< of weights and what stands for them
};

/// Weights leaf by leaf, in parallel; the full matrix of doubles never exists. The same bits for any number of
/// threads. Throws base::Cancelled.
TiledBinding bind_tiles(const mesh::Surface& model, const Cage& cage, Coordinates coordinates,
                        base::WorkerPool& pool, base::Progress* progress = nullptr);

}  // namespace viete::deform
