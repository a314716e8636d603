#include "app/frame_bench.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/assets.h"
#include "app/bench_scene.h"
#include "app/bench_table.h"
#include "app/options.h"
#include "app/reference_frame.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/worker_pool.h"
#include "deform/floors.h"
#include "deform/fused_frame.h"
#include "deform/vec3.h"
#include "scene/document.h"

namespace viete::app {

namespace {

using deform::Link;
using sym3::Method;

struct Options {
  std::size_t count = 0;  ///< vertices: the bundled model is cut off or subdivided; 0: as it is
  std::vector<std::size_t> faces = {50, 100, 300, 600};
  int rounds = 11;
  double tolerance = deform::usual_tolerance;
  std::filesystem::path json;
};

// The bundled model, its first vertices, or subdivided until it has as many.
mesh::Surface benchmark_model(std::size_t count) {
  mesh::Surface model = *scene::open_document(bundled_model().model, {}).model.surface;
  while (count > model.positions.size()) model = subdivided(model);
  if (count == 0 || 2 * count > model.positions.size()) return model;
  std::vector<mesh::Triangle> kept;
  for (const auto& t : model.triangles) {
    if (t[0] < count && t[1] < count && t[2] < count) kept.push_back(t);
  }
  model.positions.resize(std::max<std::size_t>(count, 3));
  return mesh::from_triangles(std::move(model.positions), kept);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Something that is timed, and what it found out on the way.
struct Case {
  std::string name;
  base::WorkerPool* pool;
  std::function<void()> run;
  std::function<deform::LinkTimes()> links;          ///< empty: it has none
  std::function<double()> error;                     ///< distance from the staged frame in diagonals; may be empty
  std::size_t bytes = 0;                             ///< read once a frame
  std::vector<double> cpu_ms{}, wall_ms{};
  std::vector<deform::LinkTimes> link_ms{};
};

// Processor time, where several threads share the work of the one that took longest.
void time_once(Case& c) {
  const auto cost = c.pool->cost();
  const double wall = base::wall_seconds(), cpu = base::thread_seconds();
  c.run();
  const double seconds = base::thread_seconds() - cpu;
  c.wall_ms.push_back(1e3 * (base::wall_seconds() - wall));
  const auto now = c.pool->cost();
  c.cpu_ms.push_back(1e3 * (seconds - (now.caller - cost.caller) + (now.longest - cost.longest)));
  if (c.links) c.link_ms.push_back(c.links());
}

double link_median(const Case& c, std::size_t link) {
  std::vector<double> values;
  for (const auto& t : c.link_ms) values.push_back(t.ms[link]);
  return median(std::move(values));
}

double distance(std::span<const mesh::Point> expected, const deform::FusedFrame& frame) {
  using namespace deform;
  double largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& p = frame.vertices()[i].position;
    largest = std::max(largest, norm(frame.origin() + Vec3{p[0], p[1], p[2]} - expected[i]));
  }
  return largest;
}

/// One model in one cage: everything that is compared, bound and ready.
class Contest {
 public:
  Contest(const mesh::Surface& model, std::size_t faces, double tolerance)
      : cage_(std::make_shared<const deform::Cage>(deform::make_cage(star_cage(model, faces)))),
        pose_(moderate_pose(*cage_)) {
    bind_staged(model);
    dense_ = bind_fused(model, 0);
    compressed_ = bind_fused(model, tolerance);
    if (staged_) add_staged();
    for (auto* pool : {&one_, &all_}) {
      if (pool == &all_ && all_.threads() == 1) continue;
      const std::string threads = pool == &one_ ? "" : ", " + std::to_string(all_.threads()) + " threads";
      add_fused("fused, dense" + threads, dense_, *pool, false);
      if (compressed_->compressed()) add_fused("fused, compressed" + threads, compressed_, *pool, false);
      add_fused("one vertex dragged" + threads, compressed_, *pool, true);
    }
    add_floors();
  }

  void run(int rounds) {
    for (int round = 0; round < rounds; ++round) {
      for (Case& c : cases_) {
        c.run();  // frames follow each other: what the caches hold is the frame before
        time_once(c);
      }
    }
  }

  nlohmann::json report() const;

 private:
  // Not if it does not fit the memory: then there is nothing staged to compare with.
  void bind_staged(const mesh::Surface& model) try {
    binding_ = std::make_shared<const deform::Binding>(
        deform::bind(model, *cage_, deform::Coordinates::face, all_));
    staged_ = std::make_unique<deform::Deformer>(cage_, binding_, one_);
    staged_->deform(pose_, Method::fast);
    expected_.assign(staged_->positions().begin(), staged_->positions().end());
  } catch (const base::Error& error) {
    std::printf("  no staged frame: %s\n", error.what());
  }

  void add_staged() {
    reference_ = std::make_unique<ReferenceFrame>(*cage_, *binding_);
    const std::size_t bytes = binding_->weights.size() * sizeof(double);
    cases_.push_back({"reference", &one_, [this] { reference_->deform(pose_); }, {}, {}, bytes});
    for (const Method m : {Method::diag, Method::sd, Method::improved_sd, Method::fast}) {
      cases_.push_back({"staged, " + std::string(sym3::name(m)), &one_, [this, m] { staged_->deform(pose_, m); },
                        [this] { return staged_->times(); }, {}, bytes});
    }
  }

  std::shared_ptr<const deform::TiledBinding> bind_fused(const mesh::Surface& model, double tolerance) {
    const double start = base::thread_seconds();
    auto tiles = std::make_shared<const deform::TiledBinding>(
        deform::bind_tiles(model, *cage_, deform::Coordinates::face, one_, tolerance));
    bind_ms_.push_back(1e3 * (base::thread_seconds() - start));
    return tiles;
  }

  void add_fused(const std::string& name, std::shared_ptr<const deform::TiledBinding> tiles, base::WorkerPool& pool, bool drag) {
    frames_.push_back(std::make_unique<deform::FusedFrame>(cage_, std::move(tiles), pool));
    auto* frame = frames_.back().get();
    const auto run = [this, frame, drag] {
      if (!drag) return frame->deform(pose_);
      deform::Pose pose = pose_;
      pose.positions[0][0] += 1e-3 * cage_->diagonal * (++step_ % 16);
      frame->deform(pose);
    };
    frame->set_dragging(drag);
    for (int warm = 0; warm < 3; ++warm) run();
    Case c{name, &pool, run, [frame] { return frame->times(); }, {}, frame->bytes()};
    if (staged_) {
      c.error = [this, frame, drag] {
        if (drag) frame->deform(pose_);
        return distance(expected_, *frame) / cage_->diagonal;
      };
    }
    cases_.push_back(std::move(c));
  }

  void add_floors() {
    const auto& w = dense_->weights;
    cases_.push_back({"floor: reading", &one_, [this, &w] { sink_ = sink_ + deform::read_floor(w.data(), w.size()); }, {}, {},
                      dense_->bytes()});
    const std::size_t sums = 12 * w.size();
    cases_.push_back({"floor: multiply-adds", &one_, [this, sums] { sink_ = sink_ + deform::multiply_add_floor(sums); }, {}, {}, 0});
  }

  std::shared_ptr<const deform::Cage> cage_;
  deform::Pose pose_;
  base::WorkerPool one_{1}, all_{0};
  std::shared_ptr<const deform::Binding> binding_;
  std::shared_ptr<const deform::TiledBinding> dense_, compressed_;
  std::vector<double> bind_ms_;
  int step_ = 0;
  std::unique_ptr<deform::Deformer> staged_;
  std::unique_ptr<ReferenceFrame> reference_;
  std::vector<std::unique_ptr<deform::FusedFrame>> frames_;
  std::vector<mesh::Point> expected_;
  std::vector<Case> cases_;
  volatile float sink_ = 0;
};

nlohmann::json Contest::report() const {
  const double reference = reference_ ? median(cases_.front().cpu_ms) : 0;
  std::printf("\n%zu vertices, %zu cage triangles; ms a frame: processor time (of the slower thread), wall; links: wall\n",
              dense_->leaves.vertices, cage_->element_count());
  std::printf("  %-24s %9s %9s %8s %9s %8s ", "", "cpu", "wall", "faster", "error", "MB");
  for (std::size_t l = 0; l < deform::link_count; ++l) std::printf(" %9s", std::string(deform::name(Link(l))).c_str());
  nlohmann::json json = {{"vertices", dense_->leaves.vertices}, {"faces", cage_->element_count()}};
  for (const Case& c : cases_) {
    const double cpu = median(c.cpu_ms), wall = median(c.wall_ms), error = c.error ? c.error() : 0;
    std::printf("\n  %-24s %9.3f %9.3f %7.1fx", c.name.c_str(), cpu, wall, reference / cpu);
    c.error ? std::printf(" %9.1e", error) : std::printf(" %9s", "");
    std::printf(" %8.1f ", static_cast<double>(c.bytes) * 1e-6);
    nlohmann::json entry = {{"name", c.name}, {"cpu_ms", cpu}, {"wall_ms", wall}, {"bytes", c.bytes}, {"error", error}};
    for (std::size_t l = 0; c.links && l < deform::link_count; ++l) {
      const double ms = link_median(c, l);
      std::printf(" %9.3f", ms);
      entry["links_ms"][std::string(deform::name(Link(l)))] = ms;
    }
    json["results"].push_back(std::move(entry));
  }
  std::printf("\n  bound in %.0f ms dense, %.0f ms compressed%s (processor time, one thread)\n", bind_ms_[0], bind_ms_[1],
              compressed_->compressed() ? "" : " (which does not pay here)");
  json["bind_ms"] = {{"dense", bind_ms_[0]}, {"compressed", bind_ms_[1]}};
  return json;
}

int bench_frame(const Options& options) {
  const mesh::Surface model = benchmark_model(options.count);
  std::printf("frame: kernel %s\n", std::string(sym3::kernel_name()).c_str());
  nlohmann::json json = {{"figure", "frame"}, {"results", nlohmann::json::array()}};
  for (const std::size_t faces : options.faces) {
    Contest contest(model, faces, options.tolerance);
    contest.run(options.rounds);
    json["results"].push_back(contest.report());
  }
  write_json(options.json, json);
  return exit_ok;
}

}  // namespace

void add_frame_bench(CLI::App& bench, Action& action) {
  auto* command = bench.add_subcommand("frame", "A frame of the bundled model: by path, cage and stage");
  auto options = std::make_shared<Options>();
  command->add_option("--count", options->count, "Vertices (default: all 50,000; 200000 and 800000 subdivide)")
      ->check(CLI::PositiveNumber);
  command->add_option("--faces", options->faces, "Cage triangles (default: 50 100 300 600)")->check(CLI::Range(8, 10000));
  command->add_option("--rounds", options->rounds, "Repetitions (default 11)")->check(CLI::PositiveNumber);
  command->add_option("--tolerance", options->tolerance, "Of compressed weights (default 3e-5)")
      ->check(CLI::NonNegativeNumber);
  add_result_option(*command, "--json", options->json, "Also write the numbers to this file");
  command->callback([options, &action] { action = [options] { return bench_frame(*options); }; });
}

}  // namespace viete::app
