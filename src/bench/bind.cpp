#include <algorithm>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/text.h"
#include "base/worker_pool.h"
#include "bench/frame.h"
#include "bench/models.h"
#include "bench/reference_frame.h"
#include "bench/table.h"
#include "weights/bind.h"
#include "weights/binding.h"
#include "weights/surface_weights.h"
#include "weights/tiled_binding.h"
#include "weights/weigher.h"

namespace viete::bench {

namespace {

constexpr pose::Weighting faces{}, mean_values{pose::Elements::point, pose::Weights::mean_value},
    harmonics{pose::Elements::face, pose::Weights::harmonic},
    biharmonics{pose::Elements::face, pose::Weights::biharmonic};

class BindRuns {
public:
  /// If `with_plain_loops` is true, also measures PlainWeights, which needs much memory.
  BindRuns(const mesh::Surface& model, const pose::Cage& cage, bool with_plain_loops)
      : model_(model), cage_(cage) {
    if (with_plain_loops)
      plain_ = std::make_unique<PlainWeights>(model_.positions.size(), cage_.element_count());
    for (const auto v : weights::lay_out(model_, cage_, faces).leaves.order)
      leaf_points_.push_back(model_.positions[v]);
    leaf_rows_.resize(weights::leaf_slots * cage_.element_count());
  }

  std::vector<BenchResult> run(std::size_t rounds) {
    std::vector<RoundCase> cases;
    const auto add = [&](const char* name, auto what) {
      cases.push_back({name, size(), [what](std::size_t) { what(); }});
    };
    if (plain_) add("plain loops", [this] { plain_->compute(model_.positions, cage_); });
    add("vectors", [this] { weigh(faces); });
    add("leaves and rings", [this] { weights::lay_out(model_, cage_, faces); });
    add("bound, dense", [this] { dense_ = bind(faces, 0); });
    add("bound, compressed", [this] { compressed_ = bind(faces, weights::usual_tolerance); });
    add("harmonic, bound, compressed", [this] { bind(harmonics, weights::usual_tolerance); });
    add("biharmonic, bound, compressed", [this] { bind(biharmonics, weights::usual_tolerance); });
    add("mean values, vectors", [this] { weigh(mean_values); });
    add("mean values, bound", [this] { bind(mean_values, 0); });
    base::Progress progress;
    return measure_rounds(cases, rounds, progress);
  }

  std::size_t size() const { return model_.positions.size(); }
  std::size_t elements() const { return cage_.element_count(); }
  const weights::TiledBinding& dense() const { return dense_; }
  const weights::TiledBinding& compressed() const { return compressed_; }

private:
  // Computes weights leaf by leaf, as compression does, so that the full matrix is never in memory.
  void weigh(const pose::Weighting& weighting) {
    const weights::Weigher weigher(cage_, weighting);
    std::vector<mesh::Vec3> sums(weights::leaf_slots);
    std::vector<float> shares(weights::leaf_slots);
    for (std::size_t begin = 0; begin < leaf_points_.size(); begin += weights::leaf_slots) {
      const std::size_t count = std::min(weights::leaf_slots, leaf_points_.size() - begin);
      weigher.weigh_tiles(std::span(leaf_points_).subspan(begin, count), leaf_rows_.data(), sums, shares);
    }
  }

  weights::TiledBinding bind(const pose::Weighting& weighting, double tolerance) {
    return weights::bind_tiles(model_, cage_, weighting, pool_, tolerance);
  }

  const mesh::Surface& model_;
  const pose::Cage& cage_;
  base::WorkerPool pool_{1};
  std::unique_ptr<PlainWeights> plain_;
  std::vector<mesh::Point> leaf_points_;
  base::AlignedVector<float> leaf_rows_;
  weights::TiledBinding dense_, compressed_;
};

void print(const BindRuns& runs, const std::vector<BenchResult>& results) {
  const auto size = static_cast<double>(runs.size()), elements = static_cast<double>(runs.elements());
  Table table{{"", "ms", "ns per pair"}, {}};
  for (const auto& r : results)
    table.rows.push_back(
        {r.name, base::few_digits(r.ns_per_item * size * 1e-6), base::few_digits(r.ns_per_item / elements)});
  print("bind: " + base::with_thousands(runs.size()) + " vertices, " + std::to_string(runs.elements()) +
            " cage triangles, kernel " + std::string(sym3::kernel_name()) +
            "; processor time of one thread, medians of interleaved runs",
        table);
}

void check(const BindRuns& runs, const std::vector<BenchResult>& results, Bars& bars) {
  if (const double plain = time_of(results, "plain loops"); plain > 0) {
    bars.check("weights: plain loops / vectors", plain / time_of(results, "vectors"), 45, true);
    bars.check("bound, compressed: plain loops /", plain / time_of(results, "bound, compressed"), 5, true);
  }
  bars.check("memory: dense / compressed",
             static_cast<double>(runs.dense().bytes()) / static_cast<double>(runs.compressed().bytes()),
             runs.size() < 400'000 ? 4 : 9, true);
}

}  // namespace

void bench_bind(const ModelOptions& options) {
  const BenchModel opened(options);
  nlohmann::json json = {{"figure", "bind"}, {"results", nlohmann::json::array()}};
  Bars bars;
  for (const auto& cage : opened.cages) {
    BindRuns runs(opened.model, *cage, options.count == 0);
    const auto results = runs.run(options.rounds);
    print(runs, results);
    std::printf("  memory: %.1f MB dense, %.1f MB compressed with tolerance %g\n",
                static_cast<double>(runs.dense().bytes()) * 1e-6,
                static_cast<double>(runs.compressed().bytes()) * 1e-6, runs.compressed().tolerance);
    if (options.cage.empty()) check(runs, results, bars);
    json["results"].push_back({{"faces", runs.elements()}, {"times", to_json(results)}});
  }
  json["bars"] = bars.rows;
  write_json(options.json, json);
}

}  // namespace viete::bench
