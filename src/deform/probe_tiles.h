// The layer of probes in vector code: their weights as the frame's kernel reads them. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "base/aligned.h"
#include "base/worker_pool.h"
#include "deform/frame_kernel.h"
#include "deform/leaves.h"
#include "deform/probe_layer.h"

namespace viete::deform {

/// What the layer does is a frame of rows of RowForm::logs: a probe has a row for each part of its motion,
/// with a weight of its own, and one with its place for the pivot,
///
///     x' = exp(sum a Y) exp(sum b X) (x - p) + (sum c t + p),    p = sum u q.
///
/// Only leaves that a probe reaches have any.
class ProbeTiles {
public:
  /// Weights anew where the layer's are others than before.
  void follow(const ProbeLayer& layer, const Leaves& leaves, base::WorkerPool& pool);
  /// True if a probe that is not at rest reaches the leaf.
  bool moves(const ProbeLayer& layer, std::size_t leaf) const;
  /// positions: of the slots of the leaf, x y z x, in units. Thread-safe.
  void move(const ProbeLayer& layer, std::size_t leaf, const TileKernel& logs, double unit,
            float* positions) const;

private:
  struct Leaf {
    std::vector<std::uint32_t> probes;
    std::size_t tiles = 0;
    base::AlignedVector<float> weights;  // [tile][row][lane]
  };
  static void weigh(const ProbeLayer& layer, std::span<const std::uint32_t> vertices, Leaf& leaf);

  std::vector<Leaf> leaves_;
  unsigned long revision_ = 0;
};

}  // namespace viete::deform
