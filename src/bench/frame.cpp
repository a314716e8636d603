#include "bench/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/error.h"
#include "base/median.h"
#include "base/worker_pool.h"
#include "bench/floors.h"
#include "bench/models.h"
#include "bench/reference_frame.h"
#include "bench/table.h"
#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/deformer.h"

namespace viete::bench {

namespace {

using namespace frame_names;

/// Times for one number of vertices; null if not measured.
class Times {
public:
  Times(std::span<const FrameTime> all, std::size_t vertices) : all_(all), vertices_(vertices) {}

  std::size_t vertices() const { return vertices_; }

  const FrameTime* of(const std::string& name, std::size_t faces, bool threaded = false) const {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const FrameTime& t) {
      return t.vertices == vertices_ && t.name == name && t.faces == faces && (t.threads > 1) == threaded;
    });
    return found == all_.end() ? nullptr : &*found;
  }

  double worst_error(const std::string& name) const {
    double worst = -1;
    for (const auto& t : all_) {
      if (t.vertices == vertices_ && t.name == name) worst = std::fmax(worst, t.error);
    }
    return worst;
  }

private:
  std::span<const FrameTime> all_;
  std::size_t vertices_;
};

std::string at(std::size_t faces) {
  return ", " + std::to_string(faces) + " faces";
}

void check_ratio(const std::string& what, const FrameTime* over, const FrameTime* under, double bar,
                 bool at_least, Bars& bars) {
  if (over && under) bars.check(what, over->cpu_ms / under->cpu_ms, bar, at_least);
}

void check_speed(const Times& times, Bars& bars) {
  const struct {
    const char* name;
    std::array<double, 3> bars;
  } paths[] = {{dense, {16, 14, 12}}, {compressed, {26, 32, 45}}, {dragged, {35, 50, 110}}};
  constexpr std::array<std::size_t, 3> faces = {50, 100, 300};
  for (const auto& path : paths) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      check_ratio(std::string("reference / ") + path.name + at(faces[i]), times.of(reference, faces[i]),
                  times.of(path.name, faces[i]), path.bars[i], true, bars);
    }
  }
  check_ratio("one vertex dragged: 600 / 50 faces", times.of(dragged, 600), times.of(dragged, 50), 1.5, false,
              bars);
  check_ratio("compressed: 300 / 50 faces", times.of(compressed, 300), times.of(compressed, 50), 2.5, false,
              bars);
  check_ratio("exponentials alone / compressed" + at(300), times.of(exponential, 300),
              times.of(compressed, 300), 0.1, false, bars);
  for (const auto& [name, bar] : {std::pair{dense, 1.8}, {compressed, 1.5}}) {
    const auto* threaded = times.of(name, 300, true);
    if (!threaded) continue;
    check_ratio(std::string(name) + at(300) + ": one thread / " + std::to_string(threaded->threads),
                times.of(name, 300), threaded, bar, true, bars);
  }
}

// The larger of memory and arithmetic time, the lower bound of a frame.
void check_floor(const Times& times, Bars& bars) {
  const auto *frame = times.of(dense, 300), *read = times.of(read_floor, 300),
             *sums = times.of(multiply_add_floor, 300);
  if (!frame || !read || !sums) return;
  const double fused = frame->links[deform::Link::fused], floor = std::max(read->cpu_ms, sums->cpu_ms);
  bars.check("fused pass, dense / the larger floor" + at(300), fused / floor, 1.6, false);
}

void check_errors(const Times& times, Bars& bars) {
  for (const auto& [name, bar] :
       {std::pair{dense, 1e-6}, {dragged, 2e-5}, {staged_fast, 1e-13}, {compressed, 2e-5}}) {
    const double error = times.worst_error(name);
    if (error >= 0) bars.check(std::string(name) + ": error in diagonals", error, bar, false);
  }
}

void check_memory(const Times& times, double bar, Bars& bars) {
  const auto *full = times.of(dense, 300), *small = times.of(compressed, 300);
  if (!full || !small) return;
  bars.check("bytes, compressed / dense, " + std::to_string(times.vertices()) + " vertices" + at(300),
             static_cast<double>(small->bytes) / static_cast<double>(full->bytes), bar, false);
}

}  // namespace

void check_frame(std::span<const FrameTime> times, Bars& bars) {
  if (times.empty()) return;
  const auto [least, most] = std::minmax_element(
      times.begin(), times.end(), [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
  const Times small(times, least->vertices), large(times, most->vertices);
  check_speed(small, bars);
  check_floor(small, bars);
  check_errors(small, bars);
  check_memory(small, 1.0 / 4, bars);
  if (large.vertices() < 8 * small.vertices()) return;
  check_memory(large, 1.0 / 9, bars);
  const auto *a = small.of(compressed, 300), *b = large.of(compressed, 300);
  if (!a || !b) return;
  const double growth = static_cast<double>(large.vertices()) / static_cast<double>(small.vertices());
  bars.check("compressed, time a vertex: " + std::to_string(large.vertices()) + " / " +
                 std::to_string(small.vertices()) + " vertices",
             b->cpu_ms / a->cpu_ms / growth, 1.0, false);
}

namespace {

using deform::Link;
using sym3::Method;

constexpr std::size_t exp_portion = 4096;  // matrices that fit the cache

// The model, truncated or subdivided to about this number of vertices.
mesh::Surface of_size(mesh::Surface model, std::size_t count) {
  while (count > 2 * model.positions.size()) model = subdivided(model);
  if (count == 0 || 2 * count > model.positions.size()) return model;
  std::vector<mesh::Triangle> kept;
  for (const auto& t : model.triangles) {
    if (t[0] < count && t[1] < count && t[2] < count) kept.push_back(t);
  }
  model.positions.resize(std::max<std::size_t>(count, 3));
  return mesh::from_triangles(std::move(model.positions), kept);
}

/// A timed case with its results.
struct Case {
  std::string name;
  base::WorkerPool* pool;
  std::function<void()> run;
  std::function<deform::LinkTimes()> links;  ///< times of each link of `run`; may be empty
  std::function<double()> error;             ///< distance from the staged frame in diagonals; may be empty
  std::size_t bytes = 0;                     ///< read once per frame
  int repeats = 1;                           ///< repetitions, for short cases
  std::vector<double> cpu_ms{}, wall_ms{};
  std::vector<deform::LinkTimes> link_ms{};
};

// In a drag each frame finds the caches as the previous one left them. Short frames need a few repetitions to
// reach that state; long ones flush the caches anyway.
void warm_up(const Case& c) {
  constexpr int frames = 8;
  constexpr double seconds = 0.02;
  const double end = base::wall_seconds() + seconds;
  for (int n = 0; n < frames && (n == 0 || base::wall_seconds() < end); ++n) c.run();
}

// Processor time; with several threads that of the slowest.
void time_once(Case& c) {
  const auto cost = c.pool->cost();
  const double wall = base::wall_seconds(), cpu = base::thread_seconds();
  for (int n = 0; n < c.repeats; ++n) c.run();
  const double seconds = base::thread_seconds() - cpu, ms = 1e3 / c.repeats;
  c.wall_ms.push_back(ms * (base::wall_seconds() - wall));
  const auto now = c.pool->cost();
  c.cpu_ms.push_back(ms * (seconds - (now.caller - cost.caller) + (now.longest - cost.longest)));
  if (c.links) c.link_ms.push_back(c.links());
}

deform::LinkTimes link_medians(const Case& c) {
  deform::LinkTimes medians;
  for (std::size_t link = 0; c.links && link < deform::link_count; ++link) {
    std::vector<double> values;
    for (const auto& t : c.link_ms) values.push_back(t.ms[link]);
    medians.ms[link] = base::median(std::move(values));
  }
  return medians;
}

double distance(std::span<const mesh::Point> expected, std::span<const mesh::Point> positions) {
  double largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    largest = std::max(largest, mesh::norm(positions[i] - expected[i]));
  }
  return largest;
}

/// The fused engine alone, with tiles that need no other binding.
struct FusedFrame {
  FusedFrame(std::shared_ptr<const deform::Cage> cage,
             const std::shared_ptr<const deform::TiledBinding>& tiles, base::WorkerPool& pool)
      : state(std::move(cage), tiles->weighting.elements, deform::Blend::srl),
        engine(tiles, state.rows().form, pool) {}

  void deform(const deform::Pose& pose) {
    state.set_pose(pose);
    engine.run(state);
  }
  deform::LinkTimes times() const {
    deform::LinkTimes all = state.times();
    return all += engine.times();
  }

  deform::CageState state;
  deform::FusedEngine engine;
};

/// One model in one cage, with all compared paths bound.
class FrameRuns {
public:
  FrameRuns(const mesh::Surface& model, std::shared_ptr<const deform::Cage> cage, double tolerance)
      : cage_(std::move(cage)), pose_(moderate_pose(*cage_)) {
    bind_staged(model);
    dense_ = bind_fused(model, 0, deform::Storage::dense);
    compressed_ = bind_fused(model, tolerance, std::nullopt);
    if (staged_) add_staged();
    for (auto* pool : {&one_, &all_}) {
      if (pool == &all_ && all_.threads() == 1) continue;
      add_fused(frame_names::dense, dense_, *pool, false);
      if (compressed_->compressed()) add_fused(frame_names::compressed, compressed_, *pool, false);
      add_fused(frame_names::dragged, compressed_, *pool, true);
    }
    add_floors();
  }

  void run(std::size_t rounds, base::Progress& progress) {
    const auto all = static_cast<double>(rounds * cases_.size());
    double done = 0;
    for (std::size_t round = 0; round < rounds; ++round) {
      for (Case& c : cases_) {
        warm_up(c);
        time_once(c);
        progress.report(++done / all);
      }
    }
  }

  std::vector<FrameTime> times() const;
  void print(std::span<const FrameTime> times) const;

private:
  // Skipped if memory does not suffice: then there is no staged reference.
  void bind_staged(const mesh::Surface& model) try {
    binding_ = std::make_shared<const deform::Binding>(deform::bind(model, *cage_, weighting_, all_));
    staged_ = std::make_unique<deform::Deformer>(cage_, binding_, deform::Scheme{binding_->weighting}, one_);
    staged_->deform(pose_, Method::diag);  // an exponential without code in common with ours
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
    add_exponentials();
  }

  // As many exponentials as in a frame, of its matrices, in cache: a lower bound of the fused pass.
  void add_exponentials() {
    staged_->deform(pose_, Method::fast);
    const auto matrices = staged_->sample_matrices(expected_.size());
    const std::size_t stride = sym3::padded_stride<float>(exp_portion);
    exp_in_.resize(6 * stride), exp_out_.resize(6 * stride);
    for (std::size_t i = 0; i < exp_portion; ++i) {
      const auto& m = matrices[i * matrices.size() / exp_portion];
      const double entries[] = {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
      for (std::size_t k = 0; k < 6; ++k) exp_in_[k * stride + i] = static_cast<float>(entries[k]);
    }
    const sym3::View<const float, 6> in(exp_in_.data(), stride);
    const sym3::View<float, 6> out(exp_out_.data(), stride);
    cases_.push_back({frame_names::exponential,
                      &one_,
                      [in, out, count = matrices.size()] {
                        for (std::size_t i = 0; i < count; i += exp_portion)
                          sym3::exp(in, out, std::min(exp_portion, count - i));
                      },
                      {},
                      {},
                      0,
                      10});
  }

  std::shared_ptr<const deform::TiledBinding> bind_fused(const mesh::Surface& model, double tolerance,
                                                         std::optional<deform::Storage> storage) {
    const double start = base::thread_seconds();
    auto tiles = std::make_shared<const deform::TiledBinding>(
        deform::bind_tiles(model, *cage_, weighting_, one_, tolerance, nullptr, storage));
    bind_ms_.push_back(1e3 * (base::thread_seconds() - start));
    return tiles;
  }

  void add_fused(const std::string& name, const std::shared_ptr<const deform::TiledBinding>& tiles,
                 base::WorkerPool& pool, bool drag) {
    frames_.push_back(std::make_unique<FusedFrame>(cage_, tiles, pool));
    auto* frame = frames_.back().get();
    const auto run = [this, frame, drag] {
      if (!drag) return frame->deform(pose_);
      deform::Pose pose = pose_;
      pose.positions[0][0] += 1e-3 * cage_->diagonal * (++step_ % 16);
      frame->deform(pose);
    };
    if (drag) frame->deform(pose_), frame->state.begin_drag(std::array{0u});
    for (int warm = 0; warm < 3; ++warm) run();
    Case c{name, &pool, run, [frame] { return frame->times(); }, {}, frame->engine.bytes()};
    if (staged_) {
      c.error = [this, frame, drag] {
        if (drag) frame->deform(pose_);
        std::vector<mesh::Point> positions;
        const deform::Vec3 origin = frame->state.rows().origin;
        for (const auto& v : frame->engine.vertices())
          positions.push_back(origin + mesh::Point{v.position[0], v.position[1], v.position[2]});
        return distance(expected_, positions) / cage_->diagonal;
      };
    }
    cases_.push_back(std::move(c));
  }

  void add_floors() {
    const auto& w = dense_->weights;
    cases_.push_back({frame_names::read_floor,
                      &one_,
                      [this, &w] { sink_ = sink_ + run_read_floor(w.data(), w.size()); },
                      {},
                      {},
                      dense_->bytes()});
    const std::size_t sums = 12 * w.size();
    cases_.push_back({frame_names::multiply_add_floor,
                      &one_,
                      [this, sums] { sink_ = sink_ + run_multiply_add_floor(sums); },
                      {},
                      {},
                      0});
  }

  std::shared_ptr<const deform::Cage> cage_;
  deform::Pose pose_;
  deform::Weighting weighting_;
  base::WorkerPool one_{1}, all_{0};
  std::shared_ptr<const deform::Binding> binding_;
  std::shared_ptr<const deform::TiledBinding> dense_, compressed_;
  std::vector<double> bind_ms_;
  int step_ = 0;
  std::unique_ptr<deform::Deformer> staged_;
  std::unique_ptr<ReferenceFrame> reference_;
  std::vector<std::unique_ptr<FusedFrame>> frames_;
  std::vector<mesh::Point> expected_;
  std::vector<Case> cases_;
  base::AlignedVector<float> exp_in_, exp_out_;
  volatile float sink_ = 0;
};

std::vector<FrameTime> FrameRuns::times() const {
  std::vector<FrameTime> times;
  for (const Case& c : cases_) {
    times.push_back({dense_->leaves.vertices, cage_->element_count(), c.name, c.pool->threads(),
                     base::median(c.cpu_ms), base::median(c.wall_ms), c.error ? c.error() : std::nan(""),
                     c.bytes, link_medians(c)});
  }
  return times;
}

void FrameRuns::print(std::span<const FrameTime> times) const {
  const double reference = reference_ ? times.front().cpu_ms : 0;
  std::printf(
      "\n%zu vertices, %zu cage triangles; ms a frame: processor time (of the slower thread), wall; links: "
      "wall\n",
      dense_->leaves.vertices, cage_->element_count());
  std::printf("  %-31s %9s %9s %8s %9s %8s ", "", "cpu", "wall", "faster", "error", "MB");
  for (std::size_t l = 0; l < deform::link_count; ++l)
    std::printf(" %9s", std::string(deform::name(Link(l))).c_str());
  for (const FrameTime& t : times) {
    const std::string name = t.threads > 1 ? t.name + ", " + std::to_string(t.threads) + " threads" : t.name;
    std::printf("\n  %-31s %9.3f %9.3f %7.1fx", name.c_str(), t.cpu_ms, t.wall_ms, reference / t.cpu_ms);
    std::isnan(t.error) ? std::printf(" %9s", "") : std::printf(" %9.1e", t.error);
    std::printf(" %8.1f ", static_cast<double>(t.bytes) * 1e-6);
    for (const double ms : t.links.ms) ms > 0 ? std::printf(" %9.3f", ms) : std::printf(" %9s", "");
  }
  std::printf("\n  bound in %.0f ms dense, %.0f ms compressed%s", bind_ms_[0], bind_ms_[1],
              compressed_->compressed() ? "" : " (which does not pay here)");
  std::printf(" (processor time, one thread)\n");
}

nlohmann::json to_json(const FrameTime& t) {
  nlohmann::json json = {{"vertices", t.vertices}, {"faces", t.faces},   {"name", t.name},
                         {"threads", t.threads},   {"cpu_ms", t.cpu_ms}, {"wall_ms", t.wall_ms},
                         {"bytes", t.bytes}};
  if (!std::isnan(t.error)) json["error"] = t.error;
  for (std::size_t l = 0; l < deform::link_count; ++l)
    json["links_ms"][std::string(deform::name(Link(l)))] = t.links.ms[l];
  return json;
}

using Cages = std::vector<std::shared_ptr<const deform::Cage>>;

// The opened cage, or generated ones.
Cages cages_around(const mesh::Surface& model, const scene::Document& opened,
                   const std::vector<std::size_t>& faces) {
  if (opened.has_cage()) return {opened.cage};
  Cages cages;
  for (const std::size_t count : faces)
    cages.push_back(std::make_shared<const deform::Cage>(deform::make_cage(star_cage(model, count))));
  return cages;
}

// Calls show(runs, times) after each.
template <class Show>
std::vector<FrameTime> measured(const FrameOptions& options, const scene::Document& opened, const Show& show,
                                base::Progress& progress) {
  std::vector<FrameTime> all;
  const std::size_t each = opened.has_cage() ? 1 : options.faces.size();
  const auto total = static_cast<double>(options.counts.size() * each);
  double done = 0;
  for (const std::size_t count : options.counts) {
    const mesh::Surface model = of_size(*opened.model.surface, count);
    const auto share =
        std::max<std::size_t>(1, model.positions.size() / 50'000);  // rounds, reduced for large models
    for (const auto& cage : cages_around(model, opened, options.faces)) {
      progress.section(done / total, (done + 1) / total);
      ++done;
      FrameRuns runs(model, cage, options.tolerance);
      runs.run(std::max<std::size_t>(3, options.rounds / share), progress);
      const auto times = runs.times();
      show(runs, times);
      all.insert(all.end(), times.begin(), times.end());
    }
  }
  return all;
}

}  // namespace

std::vector<FrameTime> measure_frames(const FrameOptions& options, base::Progress& progress) {
  const auto silent = [](const auto&...) {};
  return measured(options, open_model(options.model, options.cage), silent, progress);
}

nlohmann::json to_json(std::span<const FrameTime> times) {
  nlohmann::json results = nlohmann::json::array();
  for (const FrameTime& t : times) results.push_back(to_json(t));
  return results;
}

void bench_frame(const FrameOptions& options) {
  std::printf("frame: kernel %s, %s\n", std::string(sym3::kernel_name()).c_str(), processor_name().c_str());
  const scene::Document opened = open_model(options.model, options.cage);
  base::Progress progress;
  const auto show = [](const FrameRuns& runs, const std::vector<FrameTime>& times) { runs.print(times); };
  const std::vector<FrameTime> all = measured(options, opened, show, progress);
  std::printf("\n");
  Bars bars;
  // The limits apply to generated cages.
  if (!opened.has_cage()) check_frame(all, bars);
  write_json(options.json, {{"figure", "frame"}, {"results", to_json(all)}, {"bars", bars.rows}});
}

}  // namespace viete::bench
