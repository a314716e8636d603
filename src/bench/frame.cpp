#include "bench/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "base/median.h"
#include "base/text.h"
#include "base/worker_pool.h"
#include "bench/ensembles.h"
#include "bench/reference_frame.h"
#include "weights/bind.h"
#include "weights/surface_weights.h"
#include "weights/tiled_binding.h"
#include "weights/weigher.h"

namespace viete::bench {

const FrameTime* frame_of(std::span<const FrameTime> times, const std::string& name, std::size_t faces,
                          bool threaded) {
  const auto found = std::ranges::find_if(times, [&](const FrameTime& t) {
    return t.name == name && t.faces == faces && (t.threads > 1) == threaded;
  });
  return found == times.end() ? nullptr : &*found;
}

namespace {

using namespace frame_names;
using pose::Stage;
using sym3::Method;

/// A limit `bar` for the ratio: time of `over`, divided by the time of `under`.
struct RatioBar {
  const char* over;
  std::size_t over_faces;
  const char* under;
  std::size_t under_faces;
  double bar;
  bool at_least = true;   ///< true if the ratio must be at least `bar`, false if at most
  bool threaded = false;  ///< true if `under` runs on all threads
};

constexpr RatioBar ratio_bars[] = {{reference, 50, dense, 50, 16},
                                   {reference, 100, dense, 100, 14},
                                   {reference, 300, dense, 300, 12},
                                   {reference, 50, compressed, 50, 26},
                                   {reference, 100, compressed, 100, 32},
                                   {reference, 300, compressed, 300, 45},
                                   {reference, 50, dragged, 50, 35},
                                   {reference, 100, dragged, 100, 50},
                                   {reference, 300, dragged, 300, 110},
                                   {dragged, 600, dragged, 50, 1.5, false},
                                   {compressed, 300, compressed, 50, 2.5, false},
                                   {dense, 300, dense, 300, 1.8, true, true},
                                   {compressed, 300, compressed, 300, 1.5, true, true}};

std::string at(const char* name, std::size_t faces) {
  return std::string(name) + ", " + std::to_string(faces) + " faces";
}

struct Case {
  std::string name;
  base::WorkerPool* pool;
  std::function<void()> run;
  std::function<pose::StageTimes()> stages;  ///< times of the stages (pose::Stage) of `run`; may be empty
  std::function<double()> error;             ///< distance from the staged frame in diagonals; may be empty
  std::size_t bytes = 0;                     ///< number of bytes that one frame reads
  std::vector<double> cpu_ms{}, wall_ms{};
  std::vector<pose::StageTimes> stage_ms{};
};

// Fills the caches as in a drag. A long frame overwrites the caches, so a long frame runs only once.
void warm_up(const Case& c) {
  constexpr int frames = 8;
  constexpr double seconds = 0.02;
  const double end = base::wall_seconds() + seconds;
  for (int n = 0; n < frames && (n == 0 || base::wall_seconds() < end); ++n) c.run();
}

// With several threads, the processor time is the time of the slowest thread.
void time_once(Case& c) {
  const auto cost = c.pool->cost();
  const double wall = base::wall_seconds(), cpu = base::thread_seconds();
  c.run();
  const double seconds = base::thread_seconds() - cpu;
  c.wall_ms.push_back(1e3 * (base::wall_seconds() - wall));
  const auto now = c.pool->cost();
  c.cpu_ms.push_back(1e3 * (seconds - (now.caller - cost.caller) + (now.longest - cost.longest)));
  if (c.stages) c.stage_ms.push_back(c.stages());
}

pose::StageTimes stage_medians(const Case& c) {
  pose::StageTimes medians;
  for (std::size_t stage = 0; c.stages && stage < pose::stage_count; ++stage) {
    std::vector<double> values;
    for (const auto& t : c.stage_ms) values.push_back(t.ms[stage]);
    medians.ms[stage] = base::median(std::move(values));
  }
  return medians;
}

double distance(std::span<const mesh::Point> expected, std::span<const mesh::Point> positions) {
  double largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    largest = std::max(largest, mesh::norm(positions[i] - expected[i]));
  return largest;
}

class FrameRuns {
public:
  FrameRuns(const mesh::Surface& model, std::shared_ptr<const pose::Cage> cage)
      : cage_(std::move(cage)), pose_(moderate_pose(*cage_)) {
    bind_staged(model);
    dense_ = bind_fused(model, 0, weights::Storage::dense);
    compressed_ = bind_fused(model, weights::usual_tolerance, std::nullopt);
    if (staged_) add_staged();
    for (auto* pool : {&one_, &all_}) {
      if (pool == &all_ && all_.threads() == 1) continue;
      add_fused(frame_names::dense, dense_, *pool, false);
      if (compressed_->tiles->compressed()) add_fused(frame_names::compressed, compressed_, *pool, false);
      add_fused(frame_names::dragged, compressed_, *pool, true);
    }
  }

  void run(std::size_t rounds, base::Progress& progress) {
    const auto all = static_cast<double>(rounds * cases_.size());
    double done = 0;
    for (std::size_t round = 0; round < rounds; ++round)
      for (Case& c : cases_) {
        warm_up(c);
        time_once(c);
        progress.report(++done / all);
      }
  }

  std::vector<FrameTime> times() const {
    std::vector<FrameTime> times;
    for (const Case& c : cases_)
      times.push_back({dense_->vertices, cage_->element_count(), c.name, c.pool->threads(),
                       base::median(c.cpu_ms), base::median(c.wall_ms), c.error ? c.error() : std::nan(""),
                       c.bytes, stage_medians(c)});
    return times;
  }

private:
  // If memory is not sufficient, there is no staged frame, and errors have no reference.
  void bind_staged(const mesh::Surface& model) try {
    binding_ = std::make_shared<const weights::Binding>(weights::bind(model, *cage_, weighting_, all_));
    staged_ =
        std::make_unique<deform::FrameDeformer>(cage_, binding_, pose::Deformer{binding_->weighting}, one_);
    staged_->deform(pose_, Method::diag);  // Method::diag shares no code with `fast`
    expected_ = staged_->positions();
  } catch (const base::Error& error) {
    std::printf("  no staged frame: %s\n", error.what());
  }

  void add_staged() {
    reference_ = std::make_unique<ReferenceFrame>(*cage_, *binding_);
    const std::size_t bytes = binding_->weights.size() * sizeof(double);
    cases_.push_back({frame_names::reference, &one_, [this] { reference_->deform(pose_); }, {}, {}, bytes});
    for (const Method m : {Method::diag, Method::sd, Method::improved_sd, Method::fast}) {
      const auto run = [this, m] { staged_->deform(pose_, m); };
      const auto error = [this, run] {
        run();
        return distance(expected_, staged_->positions()) / cage_->diagonal;
      };
      cases_.push_back({"staged, " + std::string(sym3::name(m)), &one_, run,
                        [this] { return staged_->times(); }, error, bytes});
    }
  }

  std::shared_ptr<const weights::Binding> bind_fused(const mesh::Surface& model, double tolerance,
                                                     std::optional<weights::Storage> storage) {
    auto tiles = weights::bind_tiles(model, *cage_, weighting_, one_, tolerance, nullptr, storage);
    return std::make_shared<const weights::Binding>(weights::with_tiles(
        mesh::lent(model), *cage_, std::make_shared<const weights::TiledBinding>(std::move(tiles))));
  }

  void add_fused(const std::string& name, const std::shared_ptr<const weights::Binding>& binding,
                 base::WorkerPool& pool, bool drag) {
    frames_.push_back(
        std::make_unique<deform::FrameDeformer>(cage_, binding, pose::Deformer{weighting_}, pool));
    auto* frame = frames_.back().get();
    const auto run = [this, frame, drag] {
      if (!drag) return frame->deform(pose_, Method::fast);
      pose::Pose pose = pose_;
      pose.positions[0][0] += 1e-3 * cage_->diagonal * (++step_ % 16);
      frame->deform(pose, Method::fast);
    };
    if (drag) {
      frame->deform(pose_, Method::fast);
      frame->begin_drag(std::array{0u});
    }
    for (int warm = 0; warm < 3; ++warm) run();
    Case c{name, &pool, run, [frame] { return frame->times(); }, {}, frame->fused_bytes()};
    if (staged_) {
      c.error = [this, frame, drag] {
        if (drag) frame->deform(pose_, Method::fast);
        return distance(expected_, frame->positions()) / cage_->diagonal;
      };
    }
    cases_.push_back(std::move(c));
  }

  std::shared_ptr<const pose::Cage> cage_;
  pose::Pose pose_;
  pose::Weighting weighting_;
  base::WorkerPool one_{1}, all_{0};
  std::shared_ptr<const weights::Binding> binding_, dense_, compressed_;
  int step_ = 0;
  std::unique_ptr<deform::FrameDeformer> staged_;
  std::unique_ptr<ReferenceFrame> reference_;
  std::vector<std::unique_ptr<deform::FrameDeformer>> frames_;
  std::vector<mesh::Point> expected_;
  std::vector<Case> cases_;
};

void print(std::span<const FrameTime> times) {
  Table table{{"", "cpu", "wall", "faster", "error", "MB"}, {}};
  for (std::size_t l = 0; l < pose::stage_count; ++l) table.columns.emplace_back(pose::name(Stage(l)));
  const FrameTime* plain = frame_of(times, reference, times.front().faces);
  for (const FrameTime& t : times) {
    table.rows.push_back({t.threads > 1 ? t.name + ", " + std::to_string(t.threads) + " threads" : t.name,
                          base::few_digits(t.cpu_ms), base::few_digits(t.wall_ms),
                          plain ? base::few_digits(plain->cpu_ms / t.cpu_ms) : "",
                          std::isnan(t.error) ? "" : error_text(t.error),
                          base::few_digits(1e-6 * static_cast<double>(t.bytes))});
    for (const double ms : t.stages.ms) table.rows.back().push_back(ms > 0 ? base::few_digits(ms) : "");
  }
  print(
      std::to_string(times.front().vertices) + " vertices, " + std::to_string(times.front().faces) +
          " cage triangles; ms per frame: processor time of the slowest thread, wall time; stages: wall time",
      table);
}

nlohmann::json to_json(const FrameTime& t) {
  nlohmann::json json = {{"vertices", t.vertices}, {"faces", t.faces},   {"name", t.name},
                         {"threads", t.threads},   {"cpu_ms", t.cpu_ms}, {"wall_ms", t.wall_ms},
                         {"bytes", t.bytes}};
  if (!std::isnan(t.error)) json["error"] = t.error;
  for (std::size_t l = 0; l < pose::stage_count; ++l)
    json["stages_ms"][std::string(pose::name(Stage(l)))] = t.stages.ms[l];
  return json;
}

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

/// Frames of points, and of splats at these points, that are bound to one cage.
class SplatRuns {
public:
  SplatRuns(const mesh::Surface& surface, std::shared_ptr<const pose::Cage> cage, std::size_t count,
            const pose::Deformer& deformer)
      : cage_(std::move(cage)),
        pose_(moderate_pose(*cage_)),
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
    for (Case& c : cases_) c.run();
    for (std::size_t round = 0; round < rounds; ++round)
      for (Case& c : cases_) time_once(c);
  }

  Table table() const {
    Table table{{"", "slowest thread ms", "wall ms", "weights"}, {}, {"weights"}};
    for (std::size_t i = 0; i < cases_.size(); ++i)
      table.rows.push_back({cases_[i].name, base::few_digits(base::median(cases_[i].cpu_ms)),
                            base::few_digits(base::median(cases_[i].wall_ms)),
                            deformers_[i]->binding().tiles->compressed() ? "compressed" : "dense"});
    return table;
  }
  nlohmann::json json() const {
    nlohmann::json rows = nlohmann::json::array();
    for (const Case& c : cases_)
      rows.push_back(
          {{"name", c.name}, {"thread_ms", base::median(c.cpu_ms)}, {"wall_ms", base::median(c.wall_ms)}});
    return rows;
  }

private:
  void add(const std::string& name, mesh::Surface points, double step = 0,
           std::shared_ptr<const mesh::Splats> splats = nullptr) {
    auto binding = weights::bind(std::make_shared<const mesh::Surface>(std::move(points)), *cage_,
                                 deformer_.weighting, pose::EngineKind::fused, nullptr, pool_);
    binding.tip_step = step;
    deformers_.push_back(std::make_unique<deform::FrameDeformer>(
        cage_, std::make_shared<const weights::Binding>(std::move(binding)), deformer_, pool_));
    deformers_.back()->set_splats(std::move(splats));
    cases_.push_back(
        {name, &pool_, [this, d = deformers_.back().get()] { d->deform(pose_, Method::fast); }, {}, {}});
  }

  std::shared_ptr<const pose::Cage> cage_;
  pose::Pose pose_;
  pose::Deformer deformer_;
  Capture capture_, colored_;
  base::WorkerPool pool_;
  std::vector<std::unique_ptr<deform::FrameDeformer>> deformers_;
  std::vector<Case> cases_;
};

}  // namespace

std::vector<FrameTime> measure_frames(const ModelOptions& options, base::Progress& progress) {
  const BenchModel opened(options);
  std::vector<FrameTime> all;
  const std::size_t fewer = std::max<std::size_t>(1, opened.model.positions.size() / 50'000);
  for (std::size_t i = 0; i < opened.cages.size(); ++i) {
    const auto total = static_cast<double>(opened.cages.size());
    progress.section(static_cast<double>(i) / total, static_cast<double>(i + 1) / total);
    FrameRuns runs(opened.model, opened.cages[i]);
    runs.run(std::max<std::size_t>(3, options.rounds / fewer), progress);
    const auto times = runs.times();
    all.insert(all.end(), times.begin(), times.end());
  }
  return all;
}

void check_frame(std::span<const FrameTime> times, Bars& bars) {
  for (const RatioBar& r : ratio_bars) {
    const auto *over = frame_of(times, r.over, r.over_faces),
               *under = frame_of(times, r.under, r.under_faces, r.threaded);
    if (over && under)
      bars.check(
          at(r.over, r.over_faces) + " / " + at(r.under, r.under_faces) + (r.threaded ? ", all threads" : ""),
          over->cpu_ms / under->cpu_ms, r.bar, r.at_least);
  }
  for (const auto& [name, bar] :
       {std::pair{dense, 1e-6}, {dragged, 2e-5}, {staged_fast, 1e-13}, {compressed, 2e-5}}) {
    double error = -1;
    for (const FrameTime& t : times)
      if (t.name == name) error = std::fmax(error, t.error);
    if (error >= 0) bars.check(std::string(name) + ": error in diagonals", error, bar, false);
  }
  const auto *full = frame_of(times, dense, 300), *small = frame_of(times, compressed, 300);
  if (full && small)
    bars.check("bytes, compressed / dense, 300 faces",
               static_cast<double>(small->bytes) / static_cast<double>(full->bytes), 0.25, false);
}

nlohmann::json to_json(std::span<const FrameTime> times) {
  nlohmann::json results = nlohmann::json::array();
  for (const FrameTime& t : times) results.push_back(to_json(t));
  return results;
}

void bench_frame(const ModelOptions& options) {
  std::printf("frame: kernel %s, %s\n", std::string(sym3::kernel_name()).c_str(),
              base::os::processor_name().c_str());
  base::Progress progress;
  const std::vector<FrameTime> all = measure_frames(options, progress);
  for (std::span<const FrameTime> rest = all; !rest.empty();) {
    const auto faces = rest.front().faces;
    const auto end = std::ranges::find_if(rest, [&](const FrameTime& t) { return t.faces != faces; });
    const auto count = static_cast<std::size_t>(end - rest.begin());
    print(rest.first(count));
    rest = rest.subspan(count);
  }
  Bars bars;
  if (options.cage.empty()) check_frame(all, bars);
  write_json(options.json, {{"figure", "frame"}, {"results", to_json(all)}, {"bars", bars.rows}});
}

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
