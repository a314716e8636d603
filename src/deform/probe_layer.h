// The effect of probes on a model after the cage deformation, also in vector code.
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

/// A layer after another deformation, or on the model at rest. It moves a vertex at deformed position x to
///
///     x' = x + (exp(sum a Y) exp(sum b X) - I) (x - p) + sum c t,    p = sum u q,
///
/// Each probe has a rotation vector Y, log stretch X and translation t; weights a, b, c and u at the vertex
/// at rest (see probe_weights()); and a position q, which moves along with the model's vertex nearest to it
/// at rest. Probes therefore follow the cage. A probe at rest leaves all bits of x unchanged. A mask scales
/// a, b and c.
///
/// Results do not depend on the number of threads.
class ProbeLayer {
public:
  /// rest must outlive it, and not be empty.
  ProbeLayer(std::span<const mesh::Point> rest, base::WorkerPool& pool) : rest_(rest), pool_(pool) {}

  /// Applies to the next frames. O(n) if weights, or the set of probes at rest, change; otherwise O(1). The
  /// mask has one share per vertex, or is null.
  void set(const Probes& probes, const Mask& mask);
  const Probes& probes() const { return probes_; }
  /// True if some probe is not at rest.
  bool moves() const { return moves_; }
  /// Grows when weights or the mask change.
  unsigned long revision() const { return revision_; }
  /// One probe that reaches a vertex; shares() lists them in probe order, empty if all near probes are at
  /// rest.
  struct Share {
    std::uint32_t probe;
    ProbeWeights weights;
  };
  std::span<const Share> shares(std::uint32_t vertex) const;
  /// The mask's factor of turn, stretch and move at a vertex, 0 to 1.
  double follows(std::uint32_t vertex) const { return mask_ ? static_cast<double>((*mask_)[vertex]) : 1; }
  /// The vertex nearest to each probe at rest.
  std::span<const std::uint32_t> anchors() const { return anchors_; }

  /// Sets the deformed positions of the anchors, before the layer moves them. move() takes positions relative
  /// to this origin until the next call.
  void carry(std::span<const Vec3> anchors, const Vec3& origin);
  /// Thread-safe. positions.size() == vertices.size().
  void move(std::span<const std::uint32_t> vertices, std::span<Vec3> positions, sym3::Method method) const;
  /// carry() and move() for all vertices, over the pool; positions are absolute.
  void move_all(std::span<Vec3> positions, sym3::Method method);
  /// Places of the probes on the displayed model without their own motion: moved by the last carry() and by
  /// the other probes. Absolute.
  std::vector<mesh::Point> places() const;
  /// Places after the last carry() alone, relative to its origin.
  std::span<const Vec3> carried() const { return places_; }

private:
  struct Block {  // a range of vertices
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

/// The layer as a frame of rows of RowForm::logs: a probe has a row with a weight of its own for each part of
/// its motion, and one with its place for the pivot,
///
///     x' = exp(sum a Y) exp(sum b X) (x - p) + (sum c t + p),    p = sum u q.
///
/// Only leaves within reach of a probe have rows.
class ProbeTiles {
public:
  /// Updates the weights if those of the layer changed.
  void follow(const ProbeLayer& layer, const Leaves& leaves, base::WorkerPool& pool);
  /// True if a probe that is not at rest reaches the leaf.
  bool moves(const ProbeLayer& layer, std::size_t leaf) const;
  /// positions: those of the leaf's slots, x y z x, in units. Thread-safe.
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
