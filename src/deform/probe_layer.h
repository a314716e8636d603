// Moves a model by probes after the cage deformation. ProbeTiles does this in vector code.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/memory.h"
#include "base/worker_pool.h"
#include "deform/frame_kernel.h"
#include "pose/probe.h"
#include "sym3/exp.h"
#include "weights/binding.h"
#include "weights/leaves.h"

namespace viete::deform {

using mesh::Vec3;

/// Applies probes to a deformed model or to the model at rest. Moves a vertex at the position x to
///
///     x' = x + (exp(sum a * Y) * exp(sum b * X) - I) * (x - p) + sum c * t,    p = sum u * q.
///
/// Each probe has a rotation vector Y, a log stretch X, a translation t and a position q. q follows the
/// model's vertex that is nearest to the probe at rest, so probes follow the cage. The factors a, b, c and u
/// are the probe's turn, stretch, move and pivot in probe_weights(). A mask scales a, b and c. A probe at
/// rest leaves all bits of x unchanged. Results do not depend on the number of threads.
class ProbeLayer {
public:
  /// rest must outlive this object and must not be empty.
  ProbeLayer(std::span<const mesh::Point> rest, base::WorkerPool& pool) : rest_(rest), pool_(pool) {}

  /// Changes the probes and the mask of the next frames. The mask has one share per vertex, or is null. Takes
  /// O(n) time if weights or the set of probes at rest change, otherwise O(1).
  void set(const pose::Probes& probes, const weights::Mask& mask);
  const pose::Probes& probes() const { return probes_; }
  /// Returns true if some probe is not at rest.
  bool moves() const { return moves_; }
  /// Increases each time the weights or the mask change.
  unsigned long revision() const { return revision_; }
  struct Share {
    std::uint32_t probe;
    pose::ProbeWeights weights;
  };
  /// Returns the weights at a vertex, sorted by probe. Empty if all probes near the vertex's block of
  /// vertices are at rest.
  std::span<const Share> shares(std::uint32_t vertex) const;
  /// The factor from 0 to 1 by which the mask scales turn, stretch and move at a vertex.
  double follows(std::uint32_t vertex) const { return mask_ ? static_cast<double>((*mask_)[vertex]) : 1; }
  /// For each probe, the model's vertex that is nearest at rest.
  std::span<const std::uint32_t> anchors() const { return anchors_; }

  /// Sets the anchors' positions after the cage deformation, before probes move them. Until the next call,
  /// positions passed to move() are relative to `origin`.
  void carry(std::span<const Vec3> anchors, const Vec3& origin);
  /// Moves the positions of these vertices. positions.size() == vertices.size(). Thread-safe.
  void move(std::span<const std::uint32_t> vertices, std::span<Vec3> positions, sym3::Method method) const;
  /// Calls carry() and move() for all vertices, with the worker pool. positions are absolute.
  void move_all(std::span<Vec3> positions, sym3::Method method);
  /// Returns the absolute places of probes on the displayed model: after the cage and all other probes.
  std::vector<mesh::Point> places() const;
  /// The places after the last carry(), relative to the `origin` passed to it, without the probes' motions.
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
  pose::Probes probes_;
  weights::Mask mask_;
  bool moves_ = false;
  unsigned long revision_ = 0;
  std::vector<bool> posed_;
  std::vector<Block> blocks_;
  std::vector<pose::ProbeWeights> at_places_;  // [place][probe]
  std::vector<std::uint32_t> anchors_;
  std::vector<Vec3> from_anchors_, places_;
  Vec3 origin_{0, 0, 0};
};

/// Applies a ProbeLayer in vector code: blends rows of RowForm::logs. Each probe has four rows: three for the
/// parts of the motion (each with a separate weight), and one with the probe's place for the pivot p. With
/// the symbols of ProbeLayer:
///
///     x' = exp(sum a * Y) * exp(sum b * X) * (x - p) + (sum c * t + p),    p = sum u * q.
class ProbeTiles {
public:
  /// Updates the weights if the layer's weights changed.
  void follow(const ProbeLayer& layer, const weights::Leaves& leaves, base::WorkerPool& pool);
  /// Returns true if a probe that is not at rest affects the leaf.
  bool moves(const ProbeLayer& layer, std::size_t leaf) const;
  /// Moves the positions of a leaf's slots. A position is x y z x, in multiples of `unit`. Thread-safe.
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
