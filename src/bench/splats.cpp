// viete bench splats: the time of a frame of Gaussian splats, compared with plain points.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "base/clock.h"
#include "base/text.h"
#include "bench/ensembles.h"
#include "bench/frame.h"
#include "deform/frame_deformer.h"
#include "weights/bind.h"
#include "weights/tiled_binding.h"

namespace viete::bench {

namespace {

using ensembles::Random;
using ensembles::uniform;

/// Splats of random sizes and directions at random places on the surface.
struct Capture {
  mesh::Surface centres;
  std::shared_ptr<mesh::Splats> splats = std::make_shared<mesh::Splats>();

  Capture(const mesh::Surface& surface, std::size_t count, int degree) {
    Random random(31);
    splats->degree = degree;
    splats->resize(count);
    const float size = static_cast<float>(std::log(1e-3 * mesh::bounds(surface.positions).diagonal()));
    for (std::size_t i = 0; i < count; ++i) {
      const mesh::Triangle& t = surface.triangles[random() % surface.triangles.size()];
      const double u = std::sqrt(uniform(random, 0, 1)), v = uniform(random, 0, 1);
      const auto& p = surface.positions;
      centres.positions.push_back((1 - u) * p[t[0]] + u * (1 - v) * p[t[1]] + u * v * p[t[2]]);
      for (float& s : splats->log_scales[i]) s = size + static_cast<float>(uniform(random, -2, 0.5));
      for (float& q : splats->rotations[i]) q = static_cast<float>(uniform(random, -1, 1));
    }
  }
};

/// Points that are bound to a cage, and their times.
struct Run {
  std::string name;
  std::unique_ptr<deform::FrameDeformer> deformer;
  std::vector<double> wall_ms{}, thread_ms{};
};

class SplatRuns {
public:
  SplatRuns(const mesh::Surface& surface, std::shared_ptr<const pose::Cage> cage, std::size_t count,
            const pose::Deformer& deformer)
      : cage_(std::move(cage)),
        deformer_(deformer),
        capture_(surface, count, 0),
        colored_(surface, count, 3) {
    const double step = deform::tip_step(capture_.centres, *cage_, deform::tip_in_float);
    add("points", capture_.centres);
    add("splats", deform::with_tips(capture_.centres, step), step, capture_.splats);
    add("splats, turning colours", deform::with_tips(capture_.centres, step), step, colored_.splats);
    mesh::Surface seven = deform::with_tips(capture_.centres, step);
    const auto more = deform::with_tips(capture_.centres, -step).positions;
    seven.positions.insert(seven.positions.end(), more.begin() + static_cast<std::ptrdiff_t>(count),
                           more.end());
    add("seven points per splat", seven);
  }

  void run(std::size_t rounds) {
    const pose::Pose pose = moderate_pose(*cage_);
    for (std::size_t round = 0; round <= rounds; ++round)
      for (Run& run : runs_) {
        const auto cost = pool_.cost();
        base::Stopwatch watch;
        run.deformer->deform(pose, sym3::Method::fast);
        if (round == 0) continue;
        run.wall_ms.push_back(watch.lap_ms());
        run.thread_ms.push_back(1e3 * (pool_.cost() - cost).longest);
      }
  }

  Table table() {
    Table table{{"", "slowest thread ms", "wall ms", "weights"}, {}, {"weights"}};
    for (Run& run : runs_)
      table.rows.push_back({run.name, base::few_digits(median(run.thread_ms)),
                            base::few_digits(median(run.wall_ms)),
                            run.deformer->binding().tiles->compressed() ? "compressed" : "dense"});
    return table;
  }
  nlohmann::json json() {
    nlohmann::json rows = nlohmann::json::array();
    for (Run& run : runs_)
      rows.push_back(
          {{"name", run.name}, {"thread_ms", median(run.thread_ms)}, {"wall_ms", median(run.wall_ms)}});
    return rows;
  }

private:
  static double median(std::vector<double>& values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  }

  void add(const std::string& name, mesh::Surface points, double step = 0,
           std::shared_ptr<const mesh::Splats> splats = nullptr) {
    auto binding = weights::bind(std::make_shared<const mesh::Surface>(std::move(points)), *cage_,
                                 deformer_.weighting, pose::EngineKind::fused, nullptr, pool_);
    binding.tip_step = step;
    auto deformer = std::make_unique<deform::FrameDeformer>(
        cage_, std::make_shared<const weights::Binding>(std::move(binding)), deformer_, pool_);
    deformer->set_splats(std::move(splats));
    runs_.push_back({name, std::move(deformer)});
  }

  std::shared_ptr<const pose::Cage> cage_;
  pose::Deformer deformer_;
  Capture capture_, colored_;
  base::WorkerPool pool_;
  std::vector<Run> runs_;
};

}  // namespace

void bench_splats(const ModelOptions& options) {
  ModelOptions whole = options;
  whole.count = 0;
  const BenchModel opened(whole);
  nlohmann::json json = {
      {"figure", "splats"}, {"splats", options.count}, {"results", nlohmann::json::array()}};
  for (const auto& cage : opened.cages)
    for (const pose::Preset preset : {pose::Preset::paper, pose::Preset::mean_value, pose::Preset::smooth}) {
      SplatRuns runs(opened.model, cage, options.count, pose::deformer_of(preset));
      runs.run(options.rounds);
      print(base::with_thousands(options.count) + " splats, " + std::to_string(cage->element_count()) +
                " cage triangles, deformer " + std::string(base::entry_of(preset).word),
            runs.table());
      json["results"].push_back({{"faces", cage->element_count()},
                                 {"deformer", base::entry_of(preset).word},
                                 {"times", runs.json()}});
    }
  write_json(options.json, json);
}

}  // namespace viete::bench
