#include "bench/time.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/error.h"
#include "base/median.h"
#include "base/quantity.h"
#include "base/worker_pool.h"
#include "bench/bars.h"
#include "bench/models.h"
#include "bench/rest_model.h"
#include "bench/table.h"
#include "deform/bind.h"
#include "deform/deformer.h"
#include "deform/tiled_binding.h"
#include "scene/document/animation.h"
#include "scene/files/open.h"

namespace viete::bench {

namespace {

using scene::Animation, scene::Timeline;

constexpr double bar_length = 4;
constexpr int way_steps = 60;

scene::SharedPose shared(deform::Pose pose) {
  return std::make_shared<const scene::WholePose>(scene::WholePose{std::move(pose), {}});
}

Timeline between(const deform::Cage& cage, deform::Pose pose) {
  Timeline timeline;
  timeline.last = 1 + way_steps;
  timeline.keys = {{1, shared(deform::rest_pose(cage)), scene::Easing::linear},
                   {timeline.last, shared(std::move(pose))}};
  return timeline;
}

Animation animation_of(const std::shared_ptr<const deform::Cage>& cage, const Timeline& timeline) {
  scene::KnownVectors vectors;
  vectors.follow(cage);
  return {timeline, vectors};
}

struct Way {
  std::string name;
  Volumes log_space, straight;
};

nlohmann::json to_json(const Way& way) {
  const auto volumes = [](const Volumes& v) {
    return nlohmann::json{{"least", v.least}, {"most", v.most}, {"first", v.first}, {"last", v.last}};
  };
  return {{"name", way.name}, {"log_space", volumes(way.log_space)}, {"straight", volumes(way.straight)}};
}

Way way_of(const std::string& name, const mesh::Surface& model,
           const std::shared_ptr<const deform::Cage>& cage, const Timeline& timeline, int steps,
           bool in_double) {
  return {name, volumes_between_keys(model, cage, timeline, false, steps, in_double),
          volumes_between_keys(model, cage, timeline, true, steps, in_double)};
}

void print(const std::vector<Way>& ways) {
  std::printf("  %-30s %21s   %21s   %s\n", "volume over that at rest", "log space", "straight line",
              "at the first and the last key");
  for (const auto& [name, log, straight] : ways)
    std::printf("  %-30s %9.6f ... %.6f   %9.6f ... %.6f   %.6f, %.6f\n", name.c_str(), log.least, log.most,
                straight.least, straight.most, log.first, log.last);
}

/// A model that follows the cage of an animation, as in the window: all of the cage moves, every frame.
class PlayedModel {
public:
  PlayedModel(mesh::Surface model, std::shared_ptr<const deform::Cage> cage, const deform::Scheme& scheme,
              const Timeline& timeline, int threads)
      : vertices_(model.positions.size()),
        timeline_(timeline),
        animation_(animation_of(cage, timeline)),
        pool_(threads),
        deformer_(cage,
                  std::make_shared<const deform::Binding>(deform::bind(
                      model, *cage, scheme.weighting, deform::EngineKind::fused, nullptr, pool_)),
                  scheme, pool_) {
    for (int i = 0; i < frames; ++i) poses_.push_back(animation_.at(frame(i)).cage);
  }

  /// A frame of a pose that is known, and of one that the animation makes for it.
  void deform_known() { deformer_.deform(poses_[next()], sym3::Method::fast); }
  void play() { deformer_.deform(animation_.at(frame(next())).cage, sym3::Method::fast); }
  void interpolate() { animation_.at(frame(next())); }
  bool compressed() const { return deformer_.binding().tiles->compressed(); }

  std::size_t vertices() const { return vertices_; }
  base::WorkerPool& pool() { return pool_; }

private:
  static constexpr int frames = 32;

  std::size_t next() { return next_ = (next_ + 1) % frames; }
  // Between keys, as most are.
  double frame(std::size_t i) const {
    const auto &first = timeline_.keys.front(), &last = timeline_.keys.back();
    return first.frame + (static_cast<double>(i) + 0.37) / frames * (last.frame - first.frame);
  }

  std::size_t vertices_, next_ = 0;
  Timeline timeline_;
  Animation animation_;
  base::WorkerPool pool_;
  deform::Deformer deformer_;
  std::vector<deform::Pose> poses_;
};

/// Times of one thing, round by round.
struct TimedCase {
  std::string name;
  PlayedModel* model;
  void (PlayedModel::*run)();
  std::vector<double> cpu_ms{}, wall_ms{};

  // Processor time, where several threads share the work of the one that took longest.
  void time(int repeats) {
    for (int i = 0; i < repeats; ++i) (model->*run)();  // caches as while it plays
    const auto cost = model->pool().cost();
    const double wall = base::wall_seconds(), cpu = base::thread_seconds();
    for (int i = 0; i < repeats; ++i) (model->*run)();
    const double seconds = base::thread_seconds() - cpu;
    const auto now = model->pool().cost();
    const double ms = 1e3 / repeats;
    wall_ms.push_back(ms * (base::wall_seconds() - wall));
    cpu_ms.push_back(ms * (seconds - (now.caller - cost.caller) + (now.longest - cost.longest)));
  }
  double median_ms() const { return base::median(cpu_ms); }
};

std::vector<TimedCase> time_frames(PlayedModel& model, PlayedModel& large, std::size_t rounds) {
  const char* plain = model.compressed() ? "compressed frame" : "frame, not compressed";
  std::vector<TimedCase> cases = {{plain, &model, &PlayedModel::deform_known},
                                  {"frame that plays", &model, &PlayedModel::play},
                                  {"interpolation alone", &model, &PlayedModel::interpolate},
                                  {"frame that plays", &large, &PlayedModel::play}};
  for (std::size_t round = 0; round < rounds; ++round)
    for (TimedCase& c : cases) c.time(c.model == &large ? 2 : 8);
  return cases;
}

void print(std::vector<TimedCase>& cases) {
  std::printf("\n  ms, medians of interleaved rounds: processor time (of the slower thread), wall\n");
  for (const TimedCase& c : cases)
    std::printf("  %-22s %9s vertices, %d thread%s %9.3f %9.3f\n", c.name.c_str(),
                base::with_thousands(c.model->vertices()).c_str(), c.model->pool().threads(),
                c.model->pool().threads() == 1 ? ": " : "s:", c.median_ms(), base::median(c.wall_ms));
}

nlohmann::json to_json(const TimedCase& c) {
  return {{"name", c.name},
          {"vertices", c.model->vertices()},
          {"threads", c.model->pool().threads()},
          {"cpu_ms", c.median_ms()},
          {"wall_ms", base::median(c.wall_ms)}};
}

scene::Document opened_session(const std::filesystem::path& session) {
  scene::Opened opened = scene::open_files({scene::OpenRequest::What::model, {session}}, {});
  scene::check_drawable(opened);
  scene::Document document = std::move(*opened.document);
  if (!document.has_cage() || document.timeline.keys.size() < 2)
    throw base::Error(session.string(), "nothing plays in it", "choose a session with a cage and two keys");
  return document;
}

}  // namespace

Bar::Bar()
    : model(box_along_z(1, bar_length, 6, 40)),
      cage(std::make_shared<const deform::Cage>(
          deform::make_cage(box_along_z(1.2, 1.05 * bar_length, 2, 12)))) {}

Timeline Bar::turned() const {
  deform::Pose pose = deform::rest_pose(*cage);
  for (mesh::Point& p : pose.positions) p = {p[0], -p[1], -p[2]};
  pose.turns = {{std::numbers::pi, 0, 0}};
  return between(*cage, std::move(pose));
}

Timeline Bar::twisted() const {
  deform::Pose pose = deform::rest_pose(*cage);
  const auto& rest = cage->surface.positions;
  for (std::size_t v = 0; v < rest.size(); ++v) {
    const double angle = std::numbers::pi * (rest[v][2] / (1.05 * bar_length) + 0.5);
    const double c = std::cos(angle), s = std::sin(angle);
    pose.positions[v] = {c * rest[v][0] - s * rest[v][1], s * rest[v][0] + c * rest[v][1], rest[v][2]};
  }
  return between(*cage, std::move(pose));
}

double Volumes::deviation() const {
  return std::max(std::abs(least - 1), std::abs(most - 1));
}

double Volumes::loss() const {
  return 1 - least / std::min(first, last);
}

Volumes volumes_between_keys(const mesh::Surface& model, const std::shared_ptr<const deform::Cage>& cage,
                             const Timeline& timeline, bool straight, int steps, bool in_double) {
  base::WorkerPool pool;
  const deform::Scheme scheme = deform::default_scheme();
  const auto engine = in_double ? deform::EngineKind::staged : deform::EngineKind::fused;
  deform::Deformer deformer(cage,
                            std::make_shared<const deform::Binding>(
                                deform::bind(model, *cage, scheme.weighting, engine, nullptr, pool)),
                            scheme, pool);
  deformer.set_all_staged(in_double);
  const RestModel rest(model);
  const Animation animation = animation_of(cage, timeline);
  const int first = timeline.keys.front().frame, last = timeline.keys.back().frame;
  const auto volume = [&](double frame) {
    deformer.deform(animation.at(frame, straight).cage, sym3::Method::fast);
    return rest.volume(deformer.positions());
  };
  Volumes v;
  v.first = v.least = v.most = volume(first);
  for (int i = 1; i <= steps; ++i) {
    v.last = volume(first + double(i) / steps * (last - first));
    v.least = std::min(v.least, v.last), v.most = std::max(v.most, v.last);
  }
  return v;
}

void bench_time(const TimeOptions& options) {
  std::printf("time: kernel %s\n", std::string(sym3::kernel_name()).c_str());
  const scene::Document document = opened_session(options.session);
  const mesh::Surface& model = *document.model.surface;
  const Bar bar;
  const int frames = document.timeline.keys.back().frame - document.timeline.keys.front().frame;
  const std::string name = document.model.path.stem().string();
  const std::vector<Way> ways = {
      way_of("bar, turned by 180 degrees", bar.model, bar.cage, bar.turned(), way_steps, true),
      way_of("bar, one end twisted by 180", bar.model, bar.cage, bar.twisted(), way_steps, true),
      way_of(name + ", its " + std::to_string(document.timeline.keys.size()) + " keys", model, document.cage,
             document.timeline, std::min(frames, 1000), false)};
  print(ways);

  PlayedModel small(model, document.cage, document.scheme, document.timeline, 1);
  PlayedModel large(subdivided(subdivided(model)), document.cage, document.scheme, document.timeline, 2);
  std::vector<TimedCase> cases = time_frames(small, large, options.rounds);
  print(cases);
  std::printf("\n");

  Bars bars;
  bars.check("turned bar: volume from rest, log space", ways[0].log_space.deviation(), 1e-6, false);
  bars.check("twisted bar: loss below both keys, log space", ways[1].log_space.loss(), 0.03, false);
  bars.check("frame that plays / compressed frame", cases[1].median_ms() / cases[0].median_ms(), 1.1, false);
  bars.check(base::with_thousands(large.vertices()) + " vertices, 2 threads, frames a second",
             1e3 / cases[3].median_ms(), 60, true);
  nlohmann::json all_ways = nlohmann::json::array(), times = nlohmann::json::array();
  for (const Way& way : ways) all_ways.push_back(to_json(way));
  for (const TimedCase& c : cases) times.push_back(to_json(c));
  write_json(options.json,
             {{"figure", "time"}, {"volumes", all_ways}, {"times", times}, {"bars", bars.rows}});
}

}  // namespace viete::bench
