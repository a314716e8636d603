#include "bench/bind.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/text.h"
#include "base/worker_pool.h"
#include "bench/models.h"
#include "bench/reference_frame.h"
#include "bench/table.h"
#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/point_weights.h"
#include "deform/surface_weights.h"
#include "deform/tiled_binding.h"
#include "deform/weigher.h"

namespace viete::bench {

namespace {

constexpr deform::Weighting faces{}, mean_values{deform::Elements::point, deform::Weights::mean_value},
    harmonics{deform::Elements::face, deform::Weights::harmonic},
    biharmonics{deform::Elements::face, deform::Weights::biharmonic};

/// One model in one cage, and every method of binding.
class BindRuns {
public:
  explicit BindRuns(const BindOptions& options) {
    const scene::Document opened = open_model(options.model, options.cage);
    model_ = *opened.model.surface;
    while (model_.positions.size() < options.count) model_ = subdivided(model_);
    cage_ = opened.has_cage() ? *opened.cage : deform::make_cage(star_cage(model_, options.faces));
    if (options.count == 0)
      plain_ = std::make_unique<PlainWeights>(model_.positions.size(), cage_.element_count());
    for (const auto v : lay_out(model_, cage_, faces).leaves.order)
      leaf_points_.push_back(model_.positions[v]);
    leaf_rows_.resize(deform::leaf_slots * cage_.element_count());
  }

  std::vector<BenchResult> run(std::size_t rounds) {
    std::vector<RoundCase> cases;
    const auto add = [&](const char* name, auto what) {
      cases.push_back({name, size(), [what](std::size_t) { what(); }});
    };
    if (plain_) add("plain loops", [this] { plain_->compute(model_.positions, cage_); });
    add("one vertex at a time", [this] {
      weigh_one_by_one([](const auto& cage, const auto& p,
                          std::span<double> row) { deform::inverse_distance_weights(cage, p, row); },
                       elements());
    });
    add("vectors", [this] { weigh(faces); });
    add("leaves and rings", [this] { lay_out(model_, cage_, faces); });
    add("bound, dense", [this] { dense_ = bind(faces, 0); });
    add("bound, compressed", [this] { compressed_ = bind(faces, deform::usual_tolerance); });
    add("harmonic, bound, compressed", [this] { bind(harmonics, deform::usual_tolerance); });
    add("biharmonic, bound, compressed", [this] { bind(biharmonics, deform::usual_tolerance); });
    if (plain_)
      add("mean values, one at a time",
          [this] { weigh_one_by_one(deform::mean_value_weights, cage_.surface.positions.size()); });
    add("mean values, vectors", [this] { weigh(mean_values); });
    add("mean values, bound", [this] { bind(mean_values, 0); });
    base::Progress progress;
    return measure_rounds(cases, rounds, progress);
  }

  std::size_t size() const { return model_.positions.size(); }
  std::size_t elements() const { return cage_.element_count(); }
  const deform::TiledBinding& dense() const { return dense_; }
  const deform::TiledBinding& compressed() const { return compressed_; }

private:
  template <class Weights>
  void weigh_one_by_one(const Weights& weights, std::size_t handles) {
    std::vector<double> row(handles);
    for (const auto& p : model_.positions) weights(cage_, p, row);
  }

  // Leaf by leaf, as for compression: the full matrix never exists.
  void weigh(const deform::Weighting& weighting) {
    const deform::Weigher weigher(cage_, weighting);
    std::vector<deform::Vec3> sums(deform::leaf_slots);
    std::vector<float> shares(deform::leaf_slots);
    for (std::size_t begin = 0; begin < leaf_points_.size(); begin += deform::leaf_slots) {
      const std::size_t count = std::min(deform::leaf_slots, leaf_points_.size() - begin);
      weigher.weigh_tiles(std::span(leaf_points_).subspan(begin, count), leaf_rows_.data(), sums, shares);
    }
  }

  deform::TiledBinding bind(const deform::Weighting& weighting, double tolerance) {
    return deform::bind_tiles(model_, cage_, weighting, pool_, tolerance);
  }

  mesh::Surface model_;
  deform::Cage cage_;
  base::WorkerPool pool_{1};
  std::unique_ptr<PlainWeights> plain_;
  std::vector<mesh::Point> leaf_points_;
  base::AlignedVector<float> leaf_rows_;
  deform::TiledBinding dense_, compressed_;
};

void print(const BindRuns& runs, const std::vector<BenchResult>& results) {
  std::printf(
      "bind: %s vertices, %zu cage triangles, kernel %s; one thread, its processor time, medians of "
      "interleaved runs\n",
      base::with_thousands(runs.size()).c_str(), runs.elements(), std::string(sym3::kernel_name()).c_str());
  for (const auto& r : results) {
    const double ms = r.ns_per_item * static_cast<double>(runs.size()) * 1e-6;
    std::printf("  %-30s %10.1f ms %8.2f ns a pair\n", r.name.c_str(), ms,
                r.ns_per_item / static_cast<double>(runs.elements()));
  }
}

}  // namespace

void bench_bind(const BindOptions& options) {
  BindRuns runs(options);
  const auto results = runs.run(options.rounds);
  print(runs, results);
  Bars bars;
  const auto faster = [&](const char* slow, const char* fast) {
    return time_of(results, slow) / time_of(results, fast);
  };
  const bool promised = options.cage.empty();  // limits apply to generated cages
  if (promised && time_of(results, "plain loops") > 0) {
    bars.check("weights: plain loops / vectors", faster("plain loops", "vectors"), 45, true);
    bars.check("bound, compressed: plain loops /", faster("plain loops", "bound, compressed"), 5, true);
  }
  const double memory =
      static_cast<double>(runs.dense().bytes()) / static_cast<double>(runs.compressed().bytes());
  std::printf("  memory: %.1f MB dense, %.1f MB compressed to %g\n",
              static_cast<double>(runs.dense().bytes()) * 1e-6,
              static_cast<double>(runs.compressed().bytes()) * 1e-6, runs.compressed().tolerance);
  if (promised) bars.check("memory: dense / compressed", memory, runs.size() < 400'000 ? 4 : 9, true);
  write_json(options.json, {{"figure", "bind"}, {"results", to_json(results)}, {"bars", bars.rows}});
}

}  // namespace viete::bench
