#include "weights/tiled_binding.h"

#include <atomic>
#include <cmath>

#include "base/error.h"
#include "pose/cage_state.h"
#include "weights/bind_kernel.h"
#include "weights/factoring.h"
#include "weights/leaves.h"
#include "weights/surface_proxy.h"
#include "weights/surface_weights.h"
#include "weights/weigher.h"

namespace viete::weights {

namespace {

constexpr double laid_out_part = 0.15;      // fraction of the time that lay_out() takes
constexpr std::size_t fewest_handles = 32;  // with fewer handles, weights are not compressed
constexpr double worth_factoring = 0.7;  // factors must reduce the multiply-adds to less than this fraction

std::vector<std::uint32_t> triangle_counts(const mesh::Surface& model) {
  std::vector<std::uint32_t> counts(model.positions.size());
  for (const auto& t : model.triangles) {
    for (const auto v : t) ++counts[v];
  }
  return counts;
}

// Sets negative weights [handle][lane] to 0, and scales the weights of each lane to sum 1.
void normalise_lanes(std::span<double> weights) {
  std::array<double, bind_lanes> sums{};
  for (std::size_t j = 0; j < weights.size(); j += bind_lanes) {
    for (std::size_t l = 0; l < bind_lanes; ++l) sums[l] += weights[j + l] = std::max(weights[j + l], 0.0);
  }
  for (std::size_t j = 0; j < weights.size(); j += bind_lanes) {
    for (std::size_t l = 0; l < bind_lanes; ++l) weights[j + l] /= sums[l];
  }
}

/// Scratch of one thread for one leaf at a time.
struct LeafWeights {
  base::AlignedVector<float> rows, left;  // [tile][handle][lane]; left: a copy for factor_rows()
  std::vector<Vec3> sums;                 // per slot: sum of weight * handle position
  std::vector<float> shares;              // per slot
  std::vector<std::uint32_t> places;      // per cluster of a proxy: place in LeafClusters::clusters, or none
};

/// The clusters from which a leaf's weights are interpolated.
struct LeafClusters {
  std::vector<std::uint32_t> clusters;
  std::vector<SurfaceProxy::Term> terms;  // slot after slot; Term::cluster is an index of `clusters`
  std::vector<std::size_t> starts;        // start of each slot's terms, and the end
  double largest_sum = 1;                 // largest sum of |factor| over the terms of a slot
};

struct LeafResult {
  Factors factors;
  std::vector<float> pivot_rows;  // [pivot][handle]
  std::vector<Vec3> pivot_sums;   // per pivot: sum of weight * handle position
};

/// The handles with weight in one leaf, and their weights.
struct LeafList {
  std::vector<std::uint32_t> handles;
  base::AlignedVector<float> rows;  // [tile][place in the list][lane]
};

/// The multiply-adds of a frame with factors or lists, relative to a frame with dense weights.
struct Costs {
  double factors = 1, lists = 1;
};

class Binder {
public:
  Binder(const mesh::Surface& model, const pose::Cage& cage, const pose::Weighting& weighting,
         base::WorkerPool& pool, base::Progress* progress, const KnownRow& known)
      : model_(model),
        row_(weighting.on_surface() ? known : KnownRow()),
        weigher_(cage, weighting),
        pool_(pool),
        progress_(progress),
        b_(lay_out(model, cage, weighting, progress)) {}

  TiledBinding bind(double tolerance, std::optional<Storage> wanted) {
    if (b_.weighting.on_surface() && !row_) solve_surface_weights();
    const bool local = b_.weighting.partial(), sample = worth_sampling(tolerance) || local;
    require(local ? 0 : sample ? 0.25 : 1);  // the size of lists is unknown before the sample
    const Costs shares = sample ? sampled_shares(tolerance) : Costs();
    const double lossless = std::min(shares.lists, 1.0);
    const bool compress = shares.factors < worth_factoring * lossless;
    const base::ProgressPart leaves(progress_, solved_, 1);
    // During binding, the pivots' rows exist twice.
    const double pivot_rows = static_cast<double>(b_.handles) / static_cast<double>(b_.handles + leaf_slots);
    switch (wanted.value_or(compress           ? Storage::factors
                            : shares.lists < 1 ? Storage::lists
                                               : Storage::dense)) {
      case Storage::factors:
        require((1 + pivot_rows) * shares.factors);
        b_.tolerance = tolerance;
        bind_factors(tolerance);
        break;
      case Storage::lists:
        require(2 * shares.lists);
        bind_lists();
        break;
      case Storage::dense: require(1); bind_dense();
    }
    drop_whole(b_.shares);
    return std::move(b_);
  }

private:
  std::size_t slots(std::size_t leaf) const { return b_.leaves.end(leaf) - b_.leaves.begin(leaf); }
  std::size_t vertices(std::size_t leaf) const {
    return std::min(slots(leaf), b_.leaves.vertices - b_.leaves.begin(leaf));
  }

  void require(double share) const {
    const double dense = 4.0 * static_cast<double>(b_.leaves.slot_count()) * static_cast<double>(b_.handles);
    const double bytes = share * dense + 100.0 * static_cast<double>(b_.leaves.slot_count());
    base::require_memory(binding_memory(bytes, b_.leaves.vertices, b_.handles));
  }

  template <class Body>
  void for_leaves(std::size_t begin, std::size_t end, const Body& body) {
    std::atomic<std::size_t> next{begin}, done{begin};
    const auto count = static_cast<double>(b_.leaves.count());
    pool_.for_blocks(static_cast<std::size_t>(pool_.threads()), 1, [&](std::size_t, std::size_t) {
      LeafWeights w;
      for (std::size_t leaf; (leaf = next++) < end;) {
        body(leaf, w);
        if (progress_) progress_->report(static_cast<double>(++done) / count);
      }
    });
  }

  // Computes the weights of all vertices: [group of sixteen handles][vertex][handle of the group].
  void solve_surface_weights() {
    const std::size_t n = b_.leaves.vertices, k = b_.handles;
    const base::ProgressPart part(progress_, solved_, 0.7);
    solved_ = 0.7;
    if (n > most_solved_vertices) return solve_on_proxy();
    const auto sampled = spread_vertices(n, error_sample);
    b_.sample.resize(sampled.size() * k);
    surface_weights_.resize((k + sparse::solved_columns - 1) / sparse::solved_columns *
                            sparse::solved_columns * n);
    const SurfaceSystem system(model_, weigher_.cage(), b_.weighting, pool_, progress_);
    const auto store = [&](const SurfaceSystem::Solved& solved) {
      float* to = surface_weights_.data() + solved.first * n;
      for (std::size_t v = 0; v < n; ++v) to = std::copy_n(solved.of(v), sparse::solved_columns, to);
      for (std::size_t s = 0; s < sampled.size(); ++s)
        std::copy_n(solved.of(sampled[s]), solved.count, b_.sample.data() + s * k + solved.first);
    };
    system.solve(store, pool_, progress_);
    for (std::size_t s = 0; s < sampled.size(); ++s)
      normalise(std::span(b_.sample).subspan(s * k, k), b_.weighting.clamped());
  }

  void solve_on_proxy() {
    proxy_.emplace(model_, weigher_.cage(), b_.weighting, pool_, progress_);
    row_ = [this](std::uint32_t vertex, std::span<double> row) { proxy_->row(vertex, row); };
    const auto sampled = spread_vertices(b_.leaves.vertices, error_sample);
    b_.sample.resize(sampled.size() * b_.handles);
    for (std::size_t s = 0; s < sampled.size(); ++s)
      row_(static_cast<std::uint32_t>(sampled[s]), std::span(b_.sample).subspan(s * b_.handles, b_.handles));
  }

  // Does the same as Weigher::weigh_tiles() for the vertices of a leaf, with weights that are already solved.
  void gather(std::size_t leaf, float* rows, std::span<Vec3> sums) const {
    const auto& kernel = bind_kernel(sym3::kernel());
    const auto handles = weigher_.handle_positions();
    const std::size_t n = b_.leaves.vertices, begin = b_.leaves.begin(leaf);
    std::vector<double> weights(b_.handles * bind_lanes), row(b_.handles);
    for (std::size_t s = 0; s < slots(leaf); s += bind_lanes) {
      for (std::size_t l = 0; l < bind_lanes; ++l) {
        const auto vertex = b_.leaves.order[begin + s + l];
        if (row_) row_(vertex, row);
        for (std::size_t j = 0; j < b_.handles && !row_; j += sparse::solved_columns)
          std::copy_n(surface_weights_.data() + j * n + vertex * sparse::solved_columns,
                      std::min(sparse::solved_columns, b_.handles - j), row.data() + j);
        for (std::size_t j = 0; j < b_.handles; ++j) weights[j * bind_lanes + l] = row[j];
      }
      if (!row_ && b_.weighting.clamped()) normalise_lanes(weights);
      double sum[3][lanes];
      kernel.to_rows(weights.data(), {reinterpret_cast<const double(*)[3]>(handles.data()), b_.handles,
                                      rows + s / lanes * lanes * b_.handles + s % lanes, sum[0]});
      for (std::size_t l = 0; l < bind_lanes; ++l) sums[s + l] = {sum[0][l], sum[1][l], sum[2][l]};
    }
  }

  // Writes the weights of a leaf to `rows`, which must be large enough. Writes the sums and shares to `w`.
  // Returns the number of vertices without mean value coordinates.
  std::size_t weigh(std::size_t leaf, float* rows, LeafWeights& w) const {
    w.sums.resize(slots(leaf));
    w.shares.resize(slots(leaf));
    if (row_ || !surface_weights_.empty()) {
      gather(leaf, rows, w.sums);
      return 0;
    }
    std::vector<mesh::Point> points;
    for (std::size_t s = b_.leaves.begin(leaf); s < b_.leaves.end(leaf); ++s) {
      points.push_back(model_.positions[b_.leaves.order[s]]);
    }
    const auto failed = weigher_.weigh_tiles(points, rows, w.sums, w.shares);
    const auto end = failed.begin() + static_cast<std::ptrdiff_t>(vertices(leaf));
    return static_cast<std::size_t>(std::count(failed.begin(), end, true));
  }

  void set_offset(std::size_t slot, const Vec3& sum) {
    const Vec3 offset = (model_.positions[b_.leaves.order[slot]] - weigher_.origin()) - sum;
    const TileLines<float> lines{b_.offsets.data(), 3};
    for (std::size_t i = 0; i < 3; ++i) lines.at(slot, i) = static_cast<float>(offset[i] / b_.unit);
  }

  void keep_shares(std::size_t leaf, const LeafWeights& w) {
    if (!b_.shares.empty())
      std::ranges::copy(w.shares, b_.shares.begin() + std::ptrdiff_t(b_.leaves.begin(leaf)));
  }

  void bind_dense() {
    b_.weights.resize(b_.leaves.slot_count() * b_.handles);
    std::atomic<std::size_t> failed{0};
    for_leaves(0, b_.leaves.count(), [&](std::size_t leaf, LeafWeights& w) {
      const std::size_t begin = b_.leaves.begin(leaf);
      failed += weigh(leaf, b_.weights.data() + begin * b_.handles, w);
      for (std::size_t s = 0; s < slots(leaf); ++s) set_offset(begin + s, w.sums[s]);
      keep_shares(leaf, w);
    });
    b_.failed = failed;
  }

  // Handles that only translate have a quarter of the numbers to blend, so factors are not worth their cost.
  bool worth_sampling(double tolerance) const {
    return tolerance > 0 && b_.weighting.elements == pose::Elements::face &&
           compressible(b_.leaves.vertices, b_.handles);
  }

  LeafResult factor(std::size_t leaf, double tolerance, LeafWeights& w) const {
    if (proxy_) return factor_on_proxy(leaf, tolerance, w);
    const auto& kernel = bind_kernel(sym3::kernel());
    w.rows.resize(slots(leaf) * b_.handles);
    weigh(leaf, w.rows.data(), w);
    w.left = w.rows;
    LeafResult result;
    const std::size_t most = std::min(b_.handles, slots(leaf)) / 2;
    result.factors = factor_rows({w.left.data(), slots(leaf) / lanes, b_.handles}, vertices(leaf), tolerance,
                                 most, kernel);
    const TileLines<const float> rows{w.rows.data(), b_.handles};
    for (const auto p : result.factors.pivots) {
      for (std::size_t j = 0; j < b_.handles; ++j) result.pivot_rows.push_back(rows.at(p, j));
      result.pivot_sums.push_back(w.sums[p]);
    }
    return result;
  }

  LeafClusters clusters_of(std::size_t leaf, LeafWeights& w) const {
    constexpr auto none = mesh::none;
    LeafClusters result;
    w.places.resize(proxy_->proxy().surface().positions.size(), none);
    std::vector<SurfaceProxy::Term> terms;
    for (std::size_t s = b_.leaves.begin(leaf); s < b_.leaves.end(leaf); ++s) {
      result.starts.push_back(result.terms.size());
      proxy_->proxy().terms(b_.leaves.order[s], terms);
      double sum = 0;
      for (const auto& [cluster, factor] : terms) {
        auto& place = w.places[cluster];
        if (place == none) {
          place = static_cast<std::uint32_t>(result.clusters.size());
          result.clusters.push_back(cluster);
        }
        result.terms.push_back({place, factor});
        sum += std::abs(factor);
      }
      result.largest_sum = std::max(result.largest_sum, sum);
    }
    result.starts.push_back(result.terms.size());
    for (const auto cluster : result.clusters) w.places[cluster] = none;
    return result;
  }

  // Does the same with a proxy. First finds a basis of the weights of the clusters near the leaf. There are
  // fewer clusters than vertices, and the coefficients of the vertices in this basis are short rows.
  LeafResult factor_on_proxy(std::size_t leaf, double tolerance, LeafWeights& w) const {
    constexpr double share = 0.1;  // share of the basis in the tolerance; factors can multiply its residuals
    const auto& kernel = bind_kernel(sym3::kernel());
    const LeafClusters near = clusters_of(leaf, w);
    const std::size_t count = near.clusters.size(), tiles = (count + lanes - 1) / lanes;
    w.left.assign(tiles * lanes * b_.handles, 0.0f);
    const TileLines<float> rows{w.left.data(), b_.handles};
    for (std::size_t c = 0; c < count; ++c) {
      const auto weights = proxy_->of_cluster(near.clusters[c]);
      for (std::size_t j = 0; j < b_.handles; ++j) rows.at(c, j) = weights[j];
    }
    const Basis basis = find_basis({w.left.data(), tiles, b_.handles}, count,
                                   share * tolerance / near.largest_sum, count, kernel);
    interpolate(basis, near, w.left);
    const std::size_t most = std::min(b_.handles, slots(leaf)) / 2;
    LeafResult result;
    result.factors = factor_rows({w.left.data(), slots(leaf) / lanes, basis.pivots.size()}, vertices(leaf),
                                 (1 - share) * tolerance, most, kernel);
    std::vector<double> row(b_.handles);
    for (const auto p : result.factors.pivots) {
      proxy_->row(b_.leaves.order[b_.leaves.begin(leaf) + p], row);
      Vec3 sum{0, 0, 0};
      for (std::size_t j = 0; j < row.size(); ++j) sum = sum + row[j] * weigher_.handle_positions()[j];
      result.pivot_sums.push_back(sum);
      for (const double weight : row) result.pivot_rows.push_back(static_cast<float>(weight));
    }
    if (result.factors.pivots.empty()) {  // the leaf stays dense
      w.rows.resize(slots(leaf) * b_.handles);
      weigh(leaf, w.rows.data(), w);
    }
    return result;
  }

  // Writes the coefficients of a leaf's vertices: [tile][pivot of the basis][lane].
  static void interpolate(const Basis& basis, const LeafClusters& near, base::AlignedVector<float>& out) {
    const std::size_t rank = basis.pivots.size(), slots = near.starts.size() - 1;
    std::vector<float> rows;  // [cluster][pivot]
    for (std::size_t c = 0; c < near.clusters.size(); ++c)
      for (const auto& coefficients : basis.coefficients) rows.push_back(coefficients[c]);
    out.resize(slots * rank);
    std::vector<float> sums(rank);
    for (std::size_t s = 0; s < slots; ++s) {
      std::ranges::fill(sums, 0.0f);
      for (std::size_t i = near.starts[s]; i < near.starts[s + 1]; ++i) {
        const float* row = rows.data() + near.terms[i].cluster * rank;
        const auto factor = static_cast<float>(near.terms[i].factor);
        for (std::size_t t = 0; t < rank; ++t) sums[t] += factor * row[t];
      }
      for (std::size_t t = 0; t < rank; ++t) TileLines<float>{out.data(), rank}.at(s, t) = sums[t];
    }
  }

  // Estimates the costs from up to eight leaves.
  Costs sampled_shares(double tolerance) const {
    const std::size_t count = std::min<std::size_t>(8, b_.leaves.count());
    std::atomic<std::size_t> factors{0}, lists{0}, dense{0};
    pool_.for_blocks(count, 1, [&](std::size_t n, std::size_t) {
      const std::size_t leaf = n * b_.leaves.count() / count;
      LeafWeights w;
      std::size_t rank = 0;
      if (worth_sampling(tolerance)) rank = factor(leaf, tolerance, w).factors.pivots.size();
      if (!worth_sampling(tolerance) || proxy_) {
        w.rows.resize(slots(leaf) * b_.handles);
        weigh(leaf, w.rows.data(), w);
      }
      factors += rank ? rank * (slots(leaf) + b_.handles) : slots(leaf) * b_.handles;
      lists += slots(leaf) * handles_in(leaf, w.rows).size();
      dense += slots(leaf) * b_.handles;
    });
    const auto all = static_cast<double>(dense);
    return {static_cast<double>(factors) / all, static_cast<double>(lists) / all};
  }

  std::vector<std::uint32_t> handles_in(std::size_t leaf, const base::AlignedVector<float>& rows) const {
    std::vector<std::uint32_t> handles;
    for (std::uint32_t j = 0; j < b_.handles; ++j) {
      bool any = false;
      for (std::size_t t = 0; t < slots(leaf) / lanes && !any; ++t) {
        const float* line = rows.data() + (t * b_.handles + j) * lanes;
        any = std::any_of(line, line + lanes, [](float w) { return w != 0; });
      }
      if (any) handles.push_back(j);
    }
    return handles;
  }

  LeafList list_leaf(std::size_t leaf, LeafWeights& w) const {
    w.rows.resize(slots(leaf) * b_.handles);
    weigh(leaf, w.rows.data(), w);
    LeafList list{handles_in(leaf, w.rows), {}};
    const std::size_t count = list.handles.size();
    list.rows.resize(slots(leaf) * count);
    for (std::size_t t = 0; t < slots(leaf) / lanes; ++t)
      for (std::size_t r = 0; r < count; ++r) {
        std::copy_n(w.rows.data() + (t * b_.handles + list.handles[r]) * lanes, lanes,
                    list.rows.data() + (t * count + r) * lanes);
      }
    return list;
  }

  void bind_lists() {
    std::vector<LeafList> lists(b_.leaves.count());
    for_leaves(0, b_.leaves.count(), [&](std::size_t leaf, LeafWeights& w) {
      lists[leaf] = list_leaf(leaf, w);
      for (std::size_t s = 0; s < slots(leaf); ++s) set_offset(b_.leaves.begin(leaf) + s, w.sums[s]);
      keep_shares(leaf, w);
    });
    b_.list_starts = {0};
    for (const auto& list : lists) b_.list_starts.push_back(b_.list_starts.back() + list.handles.size());
    b_.weights.resize(b_.listed_weights());
    for (std::size_t leaf = 0; leaf < lists.size(); ++leaf) {
      b_.listed.insert(b_.listed.end(), lists[leaf].handles.begin(), lists[leaf].handles.end());
      std::copy(lists[leaf].rows.begin(), lists[leaf].rows.end(),
                b_.weights.begin() + static_cast<std::ptrdiff_t>(b_.first_weight(leaf)));
      lists[leaf] = {};
    }
  }

  void bind_factors(double tolerance) {
    std::vector<LeafResult> results(b_.leaves.count());
    for (std::size_t begin = 0; begin < results.size(); begin += portion_leaves) {
      const std::size_t end = std::min(begin + portion_leaves, results.size());
      for_leaves(begin, end, [&](std::size_t leaf, LeafWeights& w) {
        results[leaf] = factor(leaf, tolerance, w);
        if (results[leaf].factors.pivots.empty()) results[leaf].factors.factors = w.rows;
        set_factored_offsets(leaf, results[leaf], w);
        keep_shares(leaf, w);
      });
      store_factors(std::span(results).subspan(begin, end - begin));
    }
    store_pivots(results);
  }

  // Sets the offsets for factored weights, so that a cage at rest reproduces the model at rest.
  void set_factored_offsets(std::size_t leaf, const LeafResult& r, const LeafWeights& w) {
    const std::size_t begin = b_.leaves.begin(leaf), rank = r.factors.pivots.size();
    const TileLines<const float> factors{r.factors.factors.data(), rank};
    for (std::size_t s = 0; s < slots(leaf); ++s) {
      Vec3 sum = rank > 0 ? Vec3{0, 0, 0} : w.sums[s];
      for (std::size_t t = 0; t < rank; ++t) sum = sum + factors.at(s, t) * r.pivot_sums[t];
      set_offset(begin + s, sum);
    }
  }

  // Moves the factors of the next leaves to a new portion.
  void store_factors(std::span<LeafResult> results) {
    base::AlignedVector<float> portion;
    std::size_t size = 0;
    for (const LeafResult& r : results) size += r.factors.factors.size();
    portion.reserve(size);
    for (LeafResult& r : results) {
      LeafFactors f{.first = portion.size(), .dense = r.factors.pivots.empty()};
      f.rank = static_cast<std::uint32_t>(f.dense ? b_.handles : r.factors.pivots.size());
      b_.factored.push_back(f);
      portion.insert(portion.end(), r.factors.factors.begin(), r.factors.factors.end());
      r.factors.factors = {};
    }
    b_.factors.push_back(std::move(portion));
  }

  void store_pivots(std::span<LeafResult> results) {
    std::size_t count = 0;
    for (std::size_t leaf = 0; leaf < results.size(); ++leaf) {
      b_.factored[leaf].pivots = static_cast<std::uint32_t>(count);
      count += results[leaf].factors.pivots.size();
    }
    b_.skeleton.assign((count + slot_block - 1) / slot_block * slot_block * b_.handles, 0.0f);
    const TileLines<float> skeleton{b_.skeleton.data(), b_.handles};
    std::size_t slot = 0;
    for (LeafResult& r : results) {
      for (std::size_t t = 0; t < r.factors.pivots.size(); ++t, ++slot) {
        for (std::size_t j = 0; j < b_.handles; ++j) skeleton.at(slot, j) = r.pivot_rows[t * b_.handles + j];
      }
      r.pivot_rows = {};
    }
  }

  const mesh::Surface& model_;
  KnownRow row_;  // weights along the surface, if they are known or interpolated from a proxy
  Weigher weigher_;
  base::WorkerPool& pool_;
  base::Progress* progress_;
  TiledBinding b_;
  base::AlignedVector<float> surface_weights_;  // for weights along the surface: all vertices
  std::optional<ProxyWeights> proxy_;           // replaces surface_weights_ for large models
  double solved_ = laid_out_part;               // progress after solving weights along the surface
};

}  // namespace

bool compressible(std::size_t vertices, std::size_t handles) {
  return vertices >= leaf_slots && handles >= fewest_handles;
}

void TiledBinding::kept_row(std::size_t slot, std::span<double> row) const {
  const std::size_t leaf = slot / leaf_slots, in_leaf = slot - leaves.begin(leaf);
  using Lines = TileLines<const float>;
  std::fill(row.begin(), row.end(), 0.0);
  if (has_lists()) {
    const auto listed_here = list(leaf);
    for (std::size_t r = 0; r < listed_here.size(); ++r)
      row[listed_here[r]] = Lines{weights.data() + first_weight(leaf), listed_here.size()}.at(in_leaf, r);
  } else if (!compressed() || factored[leaf].dense) {
    const float* values = compressed() ? factors_of(leaf) : weights.data() + first_weight(leaf);
    for (std::size_t j = 0; j < handles; ++j) row[j] = Lines{values, handles}.at(in_leaf, j);
  } else {
    const LeafFactors& f = factored[leaf];
    for (std::size_t t = 0; t < f.rank; ++t) {
      const double factor = Lines{factors_of(leaf), f.rank}.at(in_leaf, t);
      for (std::size_t j = 0; j < handles; ++j)
        row[j] += factor * Lines{skeleton.data(), handles}.at(f.pivots + t, j);
    }
  }
}

std::vector<std::size_t> spread_vertices(std::size_t vertices, std::size_t limit) {
  std::vector<std::size_t> some(std::min(vertices, limit));
  for (std::size_t s = 0; s < some.size(); ++s) some[s] = s * vertices / some.size();
  return some;
}

std::size_t TiledBinding::bytes() const {
  return sizeof(float) * (weights.size() + offsets.size() + factor_count() + skeleton.size()) +
         sizeof(std::uint32_t) * listed.size();
}

std::size_t TiledBinding::listed_weights() const {
  std::size_t sum = 0;
  for (std::size_t leaf = 0; leaf < leaves.count(); ++leaf) {
    sum += (leaves.end(leaf) - leaves.begin(leaf)) * list(leaf).size();
  }
  return sum;
}

std::size_t TiledBinding::factor_count() const {
  std::size_t count = 0;
  for (const auto& portion : factors) count += portion.size();
  return count;
}

Shares shares_of(const TiledBinding& b) {
  Shares shares(b.shares.empty() ? 0 : b.leaves.vertices);
  for (std::size_t slot = 0; slot < shares.size(); ++slot)
    shares[b.leaves.order[slot]] = static_cast<double>(b.shares[slot]);
  return shares;
}

TiledBinding lay_out(const mesh::Surface& model, const pose::Cage& cage, const pose::Weighting& weighting,
                     base::Progress* progress) {
  if (model.positions.empty()) throw base::Error("", "the model has no vertices", "choose another file");
  TiledBinding b;
  b.weighting = weighting;
  b.handles = handle_count(cage, weighting.elements);
  b.leaves = make_leaves(model.positions, triangle_counts(model));
  if (progress) progress->report(laid_out_part / 2);
  b.rings = make_rings(b.leaves, model.triangles);
  if (progress) progress->report(laid_out_part);
  b.unit = std::exp2(std::round(std::log2(cage.diagonal)));
  b.offsets.resize(b.leaves.slot_count() * 3);
  if (weighting.partial()) b.shares.resize(b.leaves.slot_count());
  return b;
}

std::size_t binding_bytes(std::size_t vertices, std::size_t handles, pose::EngineKind engine,
                          const pose::Weighting& weighting) {
  const auto n = static_cast<double>(vertices), k = static_cast<double>(handles);
  const double slots = n + slot_block - 1;
  const bool compressed = weighting.elements == pose::Elements::face && compressible(vertices, handles);
  // The terms are bytes per vertex: weights, rest position, offset, a frame's results, triangles, adjacency.
  const double staged = 8 * k + 48 + 48 + 48 + 24 + 24 + 24 + 24 + 28;
  // The terms are bytes of weights, offset (with rest position, if shares need it), position, vertex,
  // neighbours.
  const double fused = (compressed ? 1.1 * k : 4 * k) + (weighting.partial() ? 24 : 12) + 20 + 32 + 20;
  double bytes = engine == pose::EngineKind::staged ? n * staged : slots * fused;
  if (weighting.on_surface()) {
    const double system = surface_system_bytes(vertices);
    // For the fused engine, solved weights stay until they are compressed, but the solver does not.
    const double solved = 4 * static_cast<double>(solved_vertices(vertices)) * k;
    bytes = engine == pose::EngineKind::staged ? bytes + system : solved + std::max(system, bytes);
  }
  return static_cast<std::size_t>(std::min(0x1p63, bytes));
}

TiledBinding bind_tiles(const mesh::Surface& model, const pose::Cage& cage, const pose::Weighting& asked,
                        base::WorkerPool& pool, double tolerance, base::Progress* progress,
                        std::optional<Storage> storage, const KnownRow& known) {
  const pose::Weighting weighting = known ? asked : weighting_for(model, asked);
  const std::size_t n = model.positions.size(), k = handle_count(cage, weighting.elements);
  if (weighting.on_surface() && !known) {
    const auto bytes = static_cast<double>(binding_bytes(n, k, pose::EngineKind::fused, weighting));
    base::require_memory(binding_memory(bytes, n, k));
  }
  return Binder(model, cage, weighting, pool, progress, known).bind(tolerance, storage);
}

}  // namespace viete::weights
