#include "bench/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "base/quantity.h"
#include "base/worker_pool.h"
#include "bench/bars.h"
#include "bench/models.h"
#include "bench/plain_shapes.h"
#include "bench/published_shapes.h"
#include "bench/shape_errors.h"
#include "bench/table.h"
#include "bench/timing/rounds.h"
#include "deform/example_posing.h"
#include "deform/shape_space.h"
#include "mesh/normals.h"
#include "scene/document/animation.h"

namespace viete::bench {

namespace {

using deform::LogTerm, deform::LogVector;
using Points = std::vector<mesh::Point>;

constexpr double half_length = 10;  // of the bar, which is 1 wide
constexpr std::size_t most_examples = 8, pins = 8;
constexpr int compared_steps = 12;
constexpr deform::PosingSettings unfitted{.freedom = 0};  // as the plain loops are

// About an axis, 0 to 2.
mesh::Point turned(mesh::Point p, std::size_t axis, double sine, double cosine) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double x = p[i], y = p[j];
  p[i] = cosine * x - sine * y, p[j] = sine * x + cosine * y;
  return p;
}

// An end twisted against the other, which needs branches.
Points twisted(Points points, double angle) {
  for (mesh::Point& p : points) {
    const double turn = angle * (p[2] / (2 * half_length) + 0.5);
    p = turned(p, 2, std::sin(turn), std::cos(turn));
  }
  return points;
}

// A joint at z = `start`: there and beyond, over this length, bent about x or y.
Points bent(Points points, int side, double start, double length, double angle) {
  const double radius = length / angle;
  for (mesh::Point& p : points) {
    const double share = std::clamp((p[2] - start) / length, 0.0, 1.0),
                 beyond = std::max(0.0, p[2] - start - length);
    if (share == 0) continue;
    const double c = std::cos(share * angle), s = std::sin(share * angle), off = p[std::size_t(side)];
    p[std::size_t(side)] = radius * (1 - c) + beyond * s + off * c;
    p[2] = start + radius * s + beyond * c - off * s;
  }
  return points;
}

// Of 50,000 vertices, in eight shapes.
ShapesOfModel made_bar() {
  const double quarter = std::numbers::pi / 2;
  ShapesOfModel bar{box_along_z(1, 2 * half_length, 24, 519), {}, {}};
  const Points& rest = bar.rest.positions;
  const auto add = [&](std::string name, Points shape) {
    bar.names.push_back(std::move(name)), bar.shapes.push_back(std::move(shape));
  };
  add("twisted by 285", twisted(rest, 285 / 90.0 * quarter));
  add("bent in an edge", bent(rest, 0, 0, 0.1, quarter));  // where neighbours turn much against each other
  for (int joint = 1; joint <= 6; ++joint)
    add("bent at " + std::to_string(joint) + "/7",
        bent(rest, joint % 2, half_length * (2.0 * joint / 7 - 1), 1, quarter));
  return bar;
}

/// Everything that is timed of one model: the first two shapes and what lies halfway between, the logs of the
/// first one, and steps of posing by eight shapes at most.
class ShapeRuns {
public:
  explicit ShapeRuns(const ShapesOfModel& model)
      : model_(model), space_(model.rest, pool_), logs_(space_.logs()), positions_(size()), normals_(size()) {
    for (const Points& shape : model.shapes) vectors_.push_back(space_.vector(shape, pool_));
    around_ = mesh::vertex_triangles(size(), model.rest.triangles);
    between(vectors_, terms_);
    const LogVector rest = logs_.at_rest();
    held_ = vectors_.size() > 1 ? logs_.held_between(vectors_[0], vectors_[1])
                                : logs_.held_between(rest, vectors_[0]);
    sound_ = {vectors_.begin(), vectors_.begin() + std::ptrdiff_t(terms_.size())};
    for (LogVector& vector : sound_) vector.doubts.clear();
    between(sound_, sound_terms_);
    add_posing();
  }

  std::vector<BenchResult> run(std::size_t rounds) {
    PlainShapes plain(space_, model_.rest);
    PlainPosing plain_posing(plain, examples_, pins_);
    std::vector<RoundCase> cases;
    const auto add = [&](const char* name, std::function<void(std::size_t)> what) {
      cases.push_back({name, size(), std::move(what)});
    };
    add("straight lines, normals",
        [this](std::size_t) { logs_.straight(terms_, positions_), add_normals(); });
    add("frame", [this](std::size_t) { shape(), add_normals(); });
    add("plain frame", [&](std::size_t) { plain.shape(terms_, held_); });
    add("logs of a shape", [this](std::size_t) { space_.vector(model_.shapes[0], pool_); });
    add("plain logs", [&](std::size_t) { plain.vector(model_.shapes[0]); });
    add("step of posing", [this](std::size_t round) { step(round); });
    add("step that fits", [this](std::size_t round) { posing_->step(targets_[round % 2], {}); });
    if (one_part()) add("plain step", [&](std::size_t round) { plain_posing.step(targets_[round % 2]); });
    add("followed without fits", [this](std::size_t) { logs_.follow(sound_terms_, pool_, work_); });
    add("followed", [this](std::size_t) { logs_.follow(terms_, pool_, work_); });
    add("solved", [this](std::size_t) { logs_.solve(work_); });
    add("shape", [this](std::size_t) { shape(); });
    add("normals", [this](std::size_t) { add_normals(); });
    base::Progress progress;
    const auto results = measure_rounds(cases, rounds, progress);
    compare(plain, plain_posing);
    return results;
  }

  double step_ms(std::size_t rounds) {
    base::Progress progress;
    const std::vector<RoundCase> steps{{"step", 1, [this](std::size_t round) { step(round); }}};
    return measure_rounds(steps, rounds, progress)[0].ns_per_item * 1e-6;
  }

  std::size_t size() const { return model_.rest.positions.size(); }
  std::size_t examples() const { return examples_.size(); }
  /// Plain posing is of such models alone.
  bool one_part() const { return logs_.parts().count() == 1; }
  /// From the plain frame, and from plain posing, both after some steps; in diagonals.
  double frame_difference() const { return frame_difference_; }
  double posing_difference() const { return posing_difference_; }

private:
  static void between(const std::vector<LogVector>& vectors, std::vector<LogTerm>& terms) {
    for (std::size_t i = 0; i < std::min<std::size_t>(2, vectors.size()); ++i)
      terms.push_back({&vectors[i], 0.5});
  }

  // Targets that come and go, as under a hand.
  void add_posing() {
    for (const LogVector& vector : vectors_)
      if (examples_.size() < most_examples) examples_.push_back(&vector);
    pins_ = far_vertices(model_.rest.positions, pins);
    posing_ = std::make_unique<deform::ExamplePosing>(space_, examples_, pool_);
    std::vector<deform::PosingPin> held;
    for (const auto v : pins_) held.push_back({v, std::numeric_limits<double>::infinity()});
    posing_->set_pins(held);
    shape();
    for (const double share : {0.5, 0.55}) {
      auto& targets = targets_.emplace_back();
      for (const auto v : pins_)
        targets.push_back(model_.rest.positions[v] + share * (positions_[v] - model_.rest.positions[v]));
    }
  }

  void shape() { logs_.shape(terms_, held_, pool_, work_, positions_); }
  void step(std::size_t round) { posing_->step(targets_[round % 2], unfitted); }
  void add_normals() {
    mesh::vertex_normals(positions_, model_.rest.triangles, around_, 0, size(), normals_);
  }

  void compare(PlainShapes& plain, PlainPosing& plain_posing) {
    const ShapeErrors errors(model_.rest);
    shape(), plain.shape(terms_, held_);
    frame_difference_ = errors.farthest(positions_, plain.positions());
    if (!one_part()) return;
    posing_->solve(targets_[0], unfitted, compared_steps);
    for (int i = 0; i < compared_steps; ++i) plain_posing.step(targets_[0]);
    posing_difference_ = errors.farthest(posing_->positions(), plain_posing.positions());
  }

  const ShapesOfModel& model_;
  base::WorkerPool pool_{1};
  deform::ShapeSpace space_;
  const deform::LogSpace& logs_;
  std::vector<LogVector> vectors_, sound_;  // sound: without doubts
  std::vector<LogTerm> terms_, sound_terms_;
  deform::Held held_;
  deform::LogSpace::Work work_;
  Points positions_, normals_;
  mesh::Adjacency around_;
  std::vector<const LogVector*> examples_;
  std::vector<std::uint32_t> pins_;
  std::vector<Points> targets_;
  std::unique_ptr<deform::ExamplePosing> posing_;
  double frame_difference_ = 0, posing_difference_ = 0;
};

/// By name, in ms.
class ShapeTimes {
public:
  ShapeTimes(std::vector<BenchResult> results, std::size_t size)
      : results_(std::move(results)), ms_(1e-6 * static_cast<double>(size)) {}

  double operator()(const char* name) const { return ms_ * time_of(results_, name); }
  const std::vector<BenchResult>& results() const { return results_; }

private:
  std::vector<BenchResult> results_;
  double ms_;
};

void print(const ShapeRuns& runs, const ShapeTimes& ms) {
  std::printf("\n  ms of one thread, its processor time, medians of interleaved rounds\n");
  std::printf("  %-34s %9s %9s\n", "", "ours", "plain");
  const auto row = [&](const std::string& name, const char* ours, const char* plain) {
    std::printf("  %-34s %9.2f", name.c_str(), ms(ours));
    if (plain) std::printf(" %9.2f %6.1f times", ms(plain), ms(plain) / ms(ours));
    std::printf("\n");
  };
  row("frame between shapes, normals", "frame", "plain frame");
  row("logs of a shape", "logs of a shape", "plain logs");
  row("step, " + std::to_string(runs.examples()) + " examples, " + std::to_string(pins) + " vertices",
      "step of posing", runs.one_part() ? "plain step" : nullptr);
  row("the same, rotations fitted", "step that fits", nullptr);
  row("straight lines, normals", "straight lines, normals", nullptr);
  const double solved = ms("solved"), sound = ms("followed without fits"), followed = ms("followed");
  std::printf("  frame by links, ms: sums, exponentials, loads %.2f, solve %.2f, ", sound - solved, solved);
  std::printf("doubtful rotations %.2f, place %.2f, normals %.2f\n", std::max(0.0, followed - sound),
              std::max(0.0, ms("shape") - followed), ms("normals"));
  std::printf("  from the plain ones differ, in diagonals: frame %.1e", runs.frame_difference());
  if (runs.one_part()) std::printf(", what %d steps pose %.1e", compared_steps, runs.posing_difference());
  std::printf("\n");
}

// At both keys of a timeline from rest to a shape.
std::size_t changed_at_ends(const ShapesOfModel& model) {
  const auto shape = std::make_shared<const Points>(model.shapes[0]);
  scene::Timeline timeline;
  scene::WholePose first, last;
  last.shape = shape;
  timeline.keys = {{1, std::make_shared<const scene::WholePose>(first), scene::Easing::linear},
                   {60, std::make_shared<const scene::WholePose>(last)}};
  scene::KnownVectors vectors;
  vectors.follow_model(std::make_shared<const mesh::Surface>(model.rest));
  const scene::Animation animation(timeline, vectors);
  std::size_t changed = 0;
  const auto count = [&](double frame, const Points& expected) {
    const scene::SharedShape at = animation.at(frame).shape;
    for (std::size_t v = 0; at && v < expected.size(); ++v) changed += (*at)[v] != expected[v];
  };
  count(1, model.rest.positions), count(60, *shape);
  return changed + !animation.at(60).shape;
}

// How far half of a half turn is from a quarter turn, either way round; of a bar of a thousand vertices, as
// what solving rounds off grows with the number.
double off_quarter_turn() {
  const mesh::Surface rest = box_along_z(1, 4, 6, 40);
  const auto all = [&](double sine, double cosine) {
    Points points = rest.positions;
    for (mesh::Point& p : points) p = turned(p, 0, sine, cosine);
    return points;
  };
  base::WorkerPool pool(1);
  const deform::ShapeSpace space(rest, pool);
  const LogVector vector = space.vector(all(0, -1), pool);
  const LogTerm half{&vector, 0.5};
  Points positions(rest.positions.size());
  deform::LogSpace::Work work;
  space.logs().shape({&half, 1}, space.logs().held_between(space.logs().at_rest(), vector), pool, work,
                     positions);
  const ShapeErrors errors(rest);
  return std::min(errors.farthest(positions, all(1, 0)), errors.farthest(positions, all(-1, 0)));
}

void check_times(const ShapeRuns& runs, const ShapeTimes& ms, Bars& bars) {
  if (runs.size() <= 50'000) {
    bars.check("frame between shapes, with normals, ms", ms("frame"), 12, false);
    bars.check("step of posing, ms", ms("step of posing"), 40, false);
    bars.check("logs of a shape, ms", ms("logs of a shape"), 150, false);
  }
  bars.check("frame: plain loops / ours", ms("plain frame") / ms("frame"), 5, true);
  if (runs.one_part())
    bars.check("step of posing: plain loops / ours", ms("plain step") / ms("step of posing"), 5, true);
  bars.check("logs of a shape: plain loops / ours", ms("plain logs") / ms("logs of a shape"), 5, true);
}

void check_published(const ShapesOptions& options, Bars& bars, nlohmann::json& json) {
  const ShapesOfModel lion = read_lion(options.published);
  base::Progress progress;
  json["lion"] = measure_halfway(lion, progress);
  print_halfway(json["lion"]);
  std::printf("\n");
  check_halfway(json["lion"], bars);
  json["gallop"] = check_gallop(options.published, bars);
  bars.check("lion: step of posing, ms", ShapeRuns(lion).step_ms(options.rounds), 4, false);
}

}  // namespace

void bench_shapes(const ShapesOptions& options) {
  const ShapesOfModel model =
      options.rest.empty() ? made_bar() : read_shapes_of_model(options.rest, options.shapes);
  std::printf("shapes: %s vertices, %s, kernel %s\n",
              base::with_thousands(model.rest.positions.size()).c_str(),
              base::counted(model.shapes.size(), "shape").c_str(), std::string(sym3::kernel_name()).c_str());
  base::Progress progress;
  nlohmann::json json{{"figure", "shapes"}, {"halfway", measure_halfway(model, progress)}};
  print_halfway(json["halfway"]);
  ShapeRuns runs(model);
  const ShapeTimes times(runs.run(options.rounds), runs.size());
  print(runs, times);
  std::printf("\n");
  Bars bars;
  if (!options.published.empty()) check_published(options, bars, json);
  bars.check("ends: vertices that differ in a bit", static_cast<double>(changed_at_ends(model)), 0, false);
  bars.check("half of a half turn from a quarter turn, diagonals", off_quarter_turn(), 1e-12, false);
  check_times(runs, times, bars);
  json["results"] = to_json(times.results());
  json["difference"] = {{"frame", runs.frame_difference()}, {"posing", runs.posing_difference()}};
  json["bars"] = bars.rows;
  write_json(options.json, json);
}

}  // namespace viete::bench
