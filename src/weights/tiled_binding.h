// The model bound to the cage for the fused frame: weights in the layout of vector code.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "weights/binding.h"
#include "weights/leaves.h"

namespace viete::weights {

/// The default error bound of compression: the Euclidean distance between the weights and the compressed
/// weights of a vertex. Positions change by 0.1 to 2 times this bound, relative to the cage's diagonal.
inline constexpr double usual_tolerance = 3e-5;

/// The number of vertices whose exact weights are compared with the approximation.
inline constexpr std::size_t error_sample = 512;
/// Returns at most `limit` of the indices 0 to `vertices` - 1, evenly spread.
std::vector<std::size_t> spread_vertices(std::size_t vertices, std::size_t limit);

enum class Storage {
  dense,    ///< weights of every handle at every vertex
  factors,  ///< compressed, see LeafFactors
  lists,    ///< weights of the handles with nonzero weights in the leaf; lossless
};

/// Factors are stored in portions of this number of leaves, because one array for all leaves would exist
/// twice during binding.
inline constexpr std::size_t portion_leaves = 512;

/// Compressed weights of a leaf: a matrix of factors times the weights of the pivots. Pivots are some
/// vertices of the leaf (row interpolative decomposition). A frame first blends only the logs of the pivots.
struct LeafFactors {
  std::size_t first = 0;  ///< index of the first factor in the leaf's portion, [tile][rank][lane]
  std::uint32_t rank = 0;
  std::uint32_t pivots = 0;  ///< index of the first pivot's row in TiledBinding::skeleton
  bool dense = false;        ///< true: factors are the weights, and rank is the number of handles
};

/// A binding for the fused frame. Arrays have one entry per slot of the leaves. Weights and offsets of
/// Binding are stored in float, which adds an error of about 1e-7 of the cage's diagonal to the sums.
struct TiledBinding {
  pose::Weighting weighting;
  std::size_t handles = 0;
  Leaves leaves;
  Rings rings;
  std::size_t failed = 0;  ///< vertices without mean value coordinates
  double unit = 1;         ///< a power of two near the cage's diagonal; the unit of stored lengths
  double tolerance = 0;    ///< tolerance of the compression; 0: not compressed
  /// Weights of error_sample vertices in double, see spread_vertices(); rows sum to 1. Empty unless weights
  /// are along the surface, because other weights can be recomputed at any point.
  std::vector<double> sample;
  base::AlignedVector<float> offsets;  ///< [tile][3][lane], as Binding::offsets, multiples of `unit`
  base::AlignedVector<float> shares;   ///< [slot]; empty unless weights are partial (see Weighting)
  /// [tile][handle][lane] or, if there are lists, [tile][place in the list][lane]; empty if compressed
  base::AlignedVector<float> weights;
  std::vector<std::size_t> list_starts;  ///< start of each leaf in `listed`, and the end; empty without lists
  std::vector<std::uint32_t> listed;     ///< handles with weight in a leaf, ascending, leaf by leaf
  std::vector<LeafFactors> factored;     ///< one per leaf; empty if not compressed
  std::vector<base::AlignedVector<float>> factors;  ///< one portion for each portion_leaves leaves
  base::AlignedVector<float> skeleton;  ///< pivots' weights [tile][handle][lane]; an even number of tiles

  bool compressed() const { return !factored.empty(); }
  bool has_lists() const { return !list_starts.empty(); }
  Storage storage() const {
    return compressed() ? Storage::factors : has_lists() ? Storage::lists : Storage::dense;
  }
  /// The handles in a leaf's list. There must be lists.
  std::span<const std::uint32_t> list(std::size_t leaf) const {
    return std::span(listed).subspan(list_starts[leaf], list_starts[leaf + 1] - list_starts[leaf]);
  }
  /// The index of the first weight of a leaf. The weights must not be compressed.
  std::size_t first_weight(std::size_t leaf) const {
    return has_lists() ? leaf_slots * list_starts[leaf] : leaves.begin(leaf) * handles;
  }
  /// The total number of weights. There must be lists.
  std::size_t listed_weights() const;
  std::size_t skeleton_slots() const { return handles ? skeleton.size() / handles : 0; }
  /// Copies the stored weights of the vertex in a slot, with compression errors. row.size() == handles.
  void kept_row(std::size_t slot, std::span<double> row) const;
  std::size_t bytes() const;  ///< size of weights (or factors) and offsets, which a frame reads once
  /// The factors of a leaf. The weights must be compressed.
  const float* factors_of(std::size_t leaf) const {
    return factors[leaf / portion_leaves].data() + factored[leaf].first;
  }
  std::size_t factor_count() const;
};

/// Returns the shares in the order of the model's vertices; empty unless weights are partial.
Shares shares_of(const TiledBinding& binding);

/// Returns a binding with all members except weights. Reports progress up to 0.15. Throws base::Error if
/// the model has no vertices.
TiledBinding lay_out(const mesh::Surface& model, const pose::Cage& cage, const pose::Weighting& weighting,
                     base::Progress* progress = nullptr);

/// The handles must be triangles. Returns true if compression may be worth its cost for these sizes.
bool compressible(std::size_t vertices, std::size_t handles);

/// Returns the number of free bytes that bind() or bind_tiles() needs, at most 2^63. For the fused engine,
/// the number is an upper bound if compressible weights shrink to about a quarter. For weights along the
/// surface, the number is the largest sum at one time: first solver and solved weights, then solved weights
/// and binding.
std::size_t binding_bytes(std::size_t vertices, std::size_t handles,
                          pose::EngineKind engine = pose::EngineKind::staged,
                          const pose::Weighting& weighting = {});

/// Computes weights leaf by leaf, in parallel, without a full matrix of doubles. Weights with a radius are
/// stored as lists. All other weights are compressed if `tolerance` is not 0 and tests on some leaves show
/// that this makes frames faster. `storage` overrides these choices. If `known` is not empty, it gives
/// weights along the surface, which are then not solved for; TiledBinding::sample stays empty. Results do not
/// depend on the number of threads. Throws base::Cancelled. Throws base::Error if free memory is insufficient
/// or the model has no vertices.
TiledBinding bind_tiles(const mesh::Surface& model, const pose::Cage& cage, const pose::Weighting& weighting,
                        base::WorkerPool& pool, double tolerance = usual_tolerance,
                        base::Progress* progress = nullptr, std::optional<Storage> storage = {},
                        const KnownRow& known = {});

}  // namespace viete::weights
