// The model bound to the cage for the fused frame: weights as vector code reads them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"
#include "deform/leaves.h"

namespace viete::deform {

/// What compression may change: largest distance of a vertex's weights from what stands for them, root of the
/// sum of squares. Positions then move by a tenth to twice as many diagonals.
inline constexpr double usual_tolerance = 3e-5;

/// Vertices of which exact weights are compared with what stands for them.
inline constexpr std::size_t error_sample = 512;
/// At most `limit` of so many, spread evenly.
std::vector<std::size_t> spread_vertices(std::size_t vertices, std::size_t limit);

/// How weights are kept.
enum class Storage {
  dense,    ///< of every handle at every vertex
  factors,  ///< compressed, see LeafFactors
  lists,    ///< of the handles that have any in a leaf: nothing is lost
};

/// The weights of a leaf as factors of those of some of its vertices, its pivots: the logs of the pivots are
/// blended first, and those of the others are blended of them. (Block low rank by row interpolative
/// decomposition.)
struct LeafFactors {
  std::size_t first = 0;  ///< in TiledBinding::factors, [tile][rank][lane]
  std::uint32_t rank = 0;
  std::uint32_t pivots = 0;  ///< first of its rows in TiledBinding::skeleton
  bool dense = false;        ///< its factors are the weights themselves, rank the number of handles
};

/// Everything per slot of the leaves. Weights and offsets are those of Binding, in float: the sums lose about
/// 1e-7 of the cage's diagonal by it.
struct TiledBinding {
  Weighting weighting;
  std::size_t handles = 0;
  Leaves leaves;
  Rings rings;
  std::size_t failed = 0;  ///< vertices that have no mean value coordinates
  double unit = 1;         ///< a power of two near the cage's diagonal: lengths are stored as multiples of it
  double tolerance = 0;    ///< of the compression; 0: none
  /// Weights along the surface only: those of error_sample vertices in double, see spread_vertices(), rows
  /// that sum to
  /// 1. (Others are made anew of any point.)
  std::vector<double> sample;
  base::AlignedVector<float> rest;     ///< [tile][3][lane], relative to the middle of the rest cage, in units
  base::AlignedVector<float> offsets;  ///< [tile][3][lane], as Binding::offsets, in units
  base::AlignedVector<float> shares;   ///< [slot]; empty unless weights are partial (see Weighting)
  /// [tile][handle][lane], with lists [tile][place in the list][lane]; empty if compressed
  base::AlignedVector<float> weights;
  std::vector<std::size_t> list_starts;  ///< in `listed`, one more than leaves; empty without lists
  std::vector<std::uint32_t> listed;     ///< the handles that have weight in a leaf, ascending, leaf by leaf
  std::vector<LeafFactors> factored;     ///< one a leaf; empty if not compressed
  base::AlignedVector<float> factors;
  base::AlignedVector<float>
      skeleton;  ///< the pivots' weights, [tile][handle][lane], an even number of tiles

  bool compressed() const { return !factored.empty(); }
  bool has_lists() const { return !list_starts.empty(); }
  Storage storage() const {
    return compressed() ? Storage::factors : has_lists() ? Storage::lists : Storage::dense;
  }
  /// Requires lists.
  std::span<const std::uint32_t> list(std::size_t leaf) const {
    return std::span(listed).subspan(list_starts[leaf], list_starts[leaf + 1] - list_starts[leaf]);
  }
  /// Where the weights of a leaf begin. Requires that they are not compressed.
  std::size_t first_weight(std::size_t leaf) const {
    return has_lists() ? leaf_slots * list_starts[leaf] : leaves.begin(leaf) * handles;
  }
  /// How many weights the lists ask for.
  std::size_t listed_weights() const;
  /// Handles that a vertex blends on average: handles, or the length of its leaf's list.
  double mean_rows() const;
  std::size_t skeleton_slots() const { return handles ? skeleton.size() / handles : 0; }
  /// The weights of the vertex in a slot as they are kept, with what compression changes. row.size() ==
  /// handles.
  void kept_row(std::size_t slot, std::span<double> row) const;
  std::size_t bytes() const;        ///< of weights and what stands for them: read once a frame
  std::size_t dense_bytes() const;  ///< what they would take without compression
  struct Sizes {
    std::size_t factors, skeleton;
  };
  /// From rank and dense of every leaf: where its factors and pivots begin. Returns what sizes that asks for.
  Sizes lay_out_factors();
};

/// In the order of the model; empty where weights are not partial.
Shares shares_of(const TiledBinding& binding);

/// All of a binding that does not take its weights: leaves, rings, unit, rest, and room for offsets. Throws
/// base::Error when the model has no vertices.
TiledBinding lay_out(const mesh::Surface& model, const Cage& cage, const Weighting& weighting);

/// True if so many are worth a try. (Handles that only move never are.)
bool compressible(std::size_t vertices, std::size_t handles);

/// Weights leaf by leaf, in parallel; the full matrix of doubles never exists, nor, compressed, that of
/// floats. What a radius leaves out is kept as lists, and weights are compressed by `tolerance` (0: never),
/// where a sample of leaves says that frames become cheaper by it, or as `storage` says. The same bits for
/// any number of threads. Throws base::Cancelled; throws base::Error when the memory that is free now would
/// not suffice, or when the model has no vertices.
TiledBinding bind_tiles(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
                        base::WorkerPool& pool, double tolerance = usual_tolerance,
                        base::Progress* progress = nullptr, std::optional<Storage> storage = {});

}  // namespace viete::deform
