// The model bound to the cage for the fused frame: weights in the layout of vector code.
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

/// Error bound of compression: the largest Euclidean distance of a vertex's weights from their approximation.
/// Positions change by 0.1 to 2 times that, in diagonals of the cage.
inline constexpr double usual_tolerance = 3e-5;

/// Number of vertices whose exact weights are compared with the approximation.
inline constexpr std::size_t error_sample = 512;
/// At most `limit` of this many vertices, spread evenly.
std::vector<std::size_t> spread_vertices(std::size_t vertices, std::size_t limit);

/// Storage of weights.
enum class Storage {
  dense,    ///< every handle at every vertex
  factors,  ///< compressed, see LeafFactors
  lists,    ///< only handles with weight in the leaf; lossless
};

/// The weights of a leaf as factors of the weights of some of its vertices, its pivots: logs of the pivots
/// are blended first, and those of the other vertices from them. (Block low rank by row interpolative
/// decomposition.)
struct LeafFactors {
  std::size_t first = 0;  ///< index in TiledBinding::factors, [tile][rank][lane]
  std::uint32_t rank = 0;
  std::uint32_t pivots = 0;  ///< index of its first row in TiledBinding::skeleton
  bool dense = false;        ///< factors are the weights themselves; rank is the number of handles
};

/// Arrays are per slot of the leaves. Weights and offsets are those of Binding in float, which adds an error
/// of about 1e-7 of the cage's diagonal to the sums.
struct TiledBinding {
  Weighting weighting;
  std::size_t handles = 0;
  Leaves leaves;
  Rings rings;
  std::size_t failed = 0;  ///< vertices without mean value coordinates
  double unit = 1;         ///< a power of two near the cage's diagonal; the unit of stored lengths
  double tolerance = 0;    ///< tolerance of the compression; 0: not compressed
  /// Only for weights along the surface: weights of error_sample vertices in double, see spread_vertices(),
  /// rows sum to 1. (Other weights can be recomputed at any point.)
  std::vector<double> sample;
  base::AlignedVector<float> rest;     ///< [tile][3][lane], relative to the middle of the rest cage, in units
  base::AlignedVector<float> offsets;  ///< [tile][3][lane], as Binding::offsets, in units
  base::AlignedVector<float> shares;   ///< [slot]; empty unless weights are partial (see Weighting)
  /// [tile][handle][lane]; with lists [tile][place in the list][lane]; empty if compressed
  base::AlignedVector<float> weights;
  std::vector<std::size_t> list_starts;  ///< in `listed`, one more than leaves; empty without lists
  std::vector<std::uint32_t> listed;     ///< handles with weight in a leaf, ascending, leaf by leaf
  std::vector<LeafFactors> factored;     ///< one per leaf; empty if not compressed
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
  /// Offset of the weights of a leaf. Must not be compressed.
  std::size_t first_weight(std::size_t leaf) const {
    return has_lists() ? leaf_slots * list_starts[leaf] : leaves.begin(leaf) * handles;
  }
  /// Total number of weights with lists.
  std::size_t listed_weights() const;
  std::size_t skeleton_slots() const { return handles ? skeleton.size() / handles : 0; }
  /// The stored weights of the vertex in a slot, including compression errors. row.size() == handles.
  void kept_row(std::size_t slot, std::span<double> row) const;
  std::size_t bytes() const;        ///< size of weights or factors, read once per frame
  std::size_t dense_bytes() const;  ///< size without compression
  struct Sizes {
    std::size_t factors, skeleton;
  };
  /// Sets the offsets of factors and pivots from rank and dense of every leaf. Returns the required sizes.
  Sizes lay_out_factors();
};

/// In the order of the model; empty where weights are not partial.
Shares shares_of(const TiledBinding& binding);

/// All parts of a binding except its weights: leaves, rings, unit, rest, and space for offsets. Throws
/// base::Error if the model has no vertices.
TiledBinding lay_out(const mesh::Surface& model, const Cage& cage, const Weighting& weighting);

/// True if compression is worth trying for these sizes. (Never for handles that only translate.)
bool compressible(std::size_t vertices, std::size_t handles);

/// Bytes that bind() requires before it begins, for n vertices and k handles; at most 2^63. An upper bound
/// for the fused engine; it assumes a quarter of the weights' size if they can be compressed (affine maps
/// only). Weights along the surface are computed for all vertices before compression.
std::size_t binding_bytes(std::size_t vertices, std::size_t handles, EngineKind engine = EngineKind::staged,
                          const Weighting& weighting = {});

/// Computes weights leaf by leaf, in parallel; a full matrix of doubles never exists and, if compressed, no
/// full matrix of floats. Weights with a radius are stored as lists. Others are compressed by `tolerance` (0:
/// never) if a sample of leaves predicts cheaper frames. `storage` overrides both. The same bits for any
/// number of threads. Throws base::Cancelled; throws base::Error if free memory is insufficient or the model
/// has no vertices.
TiledBinding bind_tiles(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
                        base::WorkerPool& pool, double tolerance = usual_tolerance,
                        base::Progress* progress = nullptr, std::optional<Storage> storage = {});

}  // namespace viete::deform
