// The effect of probes on a model after the cage has moved it, also in vector code.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/memory.h"
#include "base/worker_pool.h"
#include "deform/binding.h"
#include "deform/frame_kernel.h"
#include "deform/leaves.h"
#include "deform/probe.h"
#include "sym3/exp.h"

namespace viete::deform {

/// A layer upon whatever moves the model, or upon the model at rest. A vertex that this has brought to x goes
/// to
///
///     x' = x + (exp(sum a Y) exp(sum b X) - I) (x - p) + sum c t,    p = sum u q,
///
/// with the probes' turns Y, stretches X and moves t, their weights a, b, c and u at the vertex at rest (see
/// probe_weights()), and q where each probe's place has been brought to: as far as the vertex of the model
/// that was nearest to it. Probes ride on the cage, and one that has done nothing changes no bit. A mask
/// counts for a, b and c.
///
/// Results do not depend on the number of threads.
class ProbeLayer {
public:
  /// rest must outlive it, and not be empty.
  ProbeLayer(std::span<const mesh::Point> rest, base::WorkerPool& pool) : rest_(rest), pool_(pool) {}

  /// Of the next frames. O(n) where weights are others than before, or others of the probes are at rest, else
  /// O(1). A mask of one share a vertex, or null.
  void set(const Probes& probes, const Mask& mask);
  const Probes& probes() const { return probes_; }
  /// True if some probe is not at rest.
  bool moves() const { return moves_; }
  /// Grows when weights or the mask change.
  unsigned long revision() const { return revision_; }
  /// Of the probes that reach a vertex, in their order; none where all near it are at rest.
  struct Share {
    std::uint32_t probe;
    ProbeWeights weights;
  };
  std::span<const Share> shares(std::uint32_t vertex) const;
  /// What the mask leaves of turn, stretch and move at a vertex, 0 to 1.
  double follows(std::uint32_t vertex) const { return mask_ ? static_cast<double>((*mask_)[vertex]) : 1; }
  /// The vertex nearest to each probe at rest.
  std::span<const std::uint32_t> anchors() const { return anchors_; }

  /// Where these have been brought to, before any of them is moved by the layer. Positions are relative to
  /// that origin until the next call.
  void carry(std::span<const Vec3> anchors, const Vec3& origin);
  /// Thread-safe. positions.size() == vertices.size().
  void move(std::span<const std::uint32_t> vertices, std::span<Vec3> positions, sym3::Method method) const;
  /// Both, of all vertices, over the pool; positions are relative to nothing.
  void move_all(std::span<Vec3> positions, sym3::Method method);
  /// Where the probes' places are on the model as it is drawn, but for what each does itself: by the last
  /// carry(), and by the other probes. Relative to nothing.
  std::vector<mesh::Point> places() const;
  /// By the last carry() alone, relative to its origin.
  std::span<const Vec3> carried() const { return places_; }

private:
  struct Block {  // of vertices
    std::vector<std::uint32_t> starts;
    std::vector<Share> shares;
  };
  void weigh();
  void weigh(std::size_t begin, std::size_t end, Block& block) const;
  void find_anchors();

  std::span<const mesh::Point> rest_;
  base::WorkerPool& pool_;
  Probes probes_;
  Mask mask_;
  bool moves_ = false;
  unsigned long revision_ = 0;
  std::vector<bool> posed_;
  std::vector<Block> blocks_;
  std::vector<ProbeWeights> at_places_;  // [place][probe]
  std::vector<std::uint32_t> anchors_;
  std::vector<Vec3> from_anchors_, places_;
  Vec3 origin_{0, 0, 0};
};

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
