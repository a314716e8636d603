#include "bench/modes.h"

#include <algorithm>
#include <cstdio>
#include <deque>
#include <limits>
#include <set>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "base/median.h"
#include "base/text.h"
#include "bench/table.h"
#include "deform/frame_deformer.h"
#include "mesh/edge_paths.h"
#include "mesh/normals.h"
#include "mesh/point_tree.h"
#include "mesh/repair.h"
#include "mesh/triangle_tree.h"
#include "pose/maps.h"
#include "pose/pose_file.h"
#include "sym3/kernel.h"
#include "weights/bind.h"
#include "weights/binding.h"

namespace viete::bench {

namespace {

using mesh::norm, mesh::Point;

Point moved_by(const WholePose& pose, const Point& middle, double diagonal, const Point& p) {
  return pose::times(pose.linear, p - middle) + middle + diagonal * pose.shift;
}

sym3::Mat3<double> turned(double scale) {
  auto m = sym3::exp_rotation<double>({0.7, -1.1, 0.9});
  for (double& x : m) x *= scale;
  return m;
}

std::vector<std::uint32_t> used_vertices(const mesh::Surface& surface) {
  const std::set<std::uint32_t> used(surface.corners.begin(), surface.corners.end());
  return {used.begin(), used.end()};
}

std::vector<Point> cage_normals(const mesh::Surface& cage) {
  std::vector<Point> normals(cage.positions.size());
  mesh::vertex_normals(cage.positions, cage.triangles,
                       mesh::vertex_triangles(cage.positions.size(), cage.triangles), 0,
                       cage.positions.size(), normals);
  return normals;
}

}  // namespace

std::span<const WholePose> whole_poses() {
  static const std::array<WholePose, 4> poses = {
      WholePose{"translation", {1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.3, -0.2, 0.4}},
      WholePose{"rigid", turned(1), {0.3, -0.2, 0.4}}, WholePose{"similarity", turned(1.3), {0.3, -0.2, 0.4}},
      WholePose{"affine", {1.2, 0.3, -0.1, -0.2, 0.9, 0.25, 0.15, -0.35, 1.1}, {0.3, -0.2, 0.4}}};
  return poses;
}

double deviation(const WholePose& pose, const pose::Cage& cage, std::span<const Point> model,
                 const Deform& deform) {
  const Point middle = mesh::used_bounds(cage.surface).center();
  mesh::Surface posed = cage.surface;
  for (Point& p : posed.positions) p = moved_by(pose, middle, cage.diagonal, p);
  const std::vector<Point> positions = deform({posed.positions, {}});
  double largest = 0;
  for (std::size_t v = 0; v < model.size(); ++v) {
    const double off = norm(positions[v] - moved_by(pose, middle, cage.diagonal, model[v]));
    largest = std::isnan(largest) || off <= largest ? largest : off;  // NaN stays NaN
  }
  return largest / mesh::used_bounds(posed).diagonal();
}

double leak(const pose::Cage& cage, std::span<const Point> model, const Deform& deform) {
  const std::vector<Point> normals = cage_normals(cage.surface);
  const std::vector<Point> rest = deform(pose::rest_pose(cage));
  std::vector<double> medians;
  const auto used = used_vertices(cage.surface);
  const std::size_t count = std::min<std::size_t>(8, used.size());
  for (std::size_t n = 0; n < count; ++n) {
    const auto v = used[n * used.size() / count];
    pose::Pose pose = pose::rest_pose(cage);
    const Point from = pose.positions[v];
    pose.positions[v] = from + 0.1 * cage.diagonal * normals[v];
    const std::vector<Point> positions = deform(pose);
    std::vector<double> motions;
    for (std::size_t i = 0; i < model.size(); ++i) {
      if (norm(model[i] - from) <= 0.25 * cage.diagonal) continue;
      const double motion = norm(positions[i] - rest[i]);
      motions.push_back(std::isnan(motion) ? HUGE_VAL : motion);  // the median does not accept NaN
    }
    if (!motions.empty()) medians.push_back(base::median(std::move(motions)) / cage.diagonal);
  }
  return medians.empty() ? std::numeric_limits<double>::quiet_NaN() : base::median(std::move(medians));
}

std::vector<CagePoint> nearest_on_cage(const pose::Cage& cage, std::span<const Point> points,
                                       base::WorkerPool& pool) {
  const auto& p = cage.surface.positions;
  const mesh::TriangleTree tree(p, cage.surface.triangles);
  std::vector<CagePoint> nearest(points.size());
  pool.for_blocks(points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t t = tree.nearest(points[i]).triangle;
      const auto [a, b, c] = mesh::corners_of(p, cage.surface.triangles[t]);
      nearest[i] = {t, mesh::closest_on_triangle(points[i], a, b, c).barycentric};
    }
  });
  return nearest;
}

double gap(const pose::Cage& cage, std::span<const CagePoint> nearest, std::span<const double> shares,
           std::span<const Point> posed_cage, std::span<const Point> points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [triangle, w] = nearest[i];
    const auto& [a, b, c] = cage.surface.triangles[triangle];
    sum += shares[i] * norm(points[i] - (w[0] * posed_cage[a] + w[1] * posed_cage[b] + w[2] * posed_cage[c]));
  }
  return sum / cage.diagonal;
}

std::vector<mesh::Edge> near_pairs(const mesh::Surface& model) {
  constexpr double nearby = 0.01, touching = 0.001;  // relative to the diagonal
  constexpr std::size_t most = 20000;
  const mesh::Surface welded = mesh::welded(model);
  const auto& p = welded.positions;
  const double diagonal = mesh::used_bounds(welded).diagonal();
  const std::vector<std::uint32_t> used = used_vertices(welded);
  const mesh::EdgePaths paths(welded);
  const mesh::PointTree tree(p, used);
  std::vector<mesh::Edge> pairs;
  for (std::size_t i = 0; i < used.size(); i += (used.size() + most - 1) / most) {
    const std::uint32_t a = used[i];
    tree.for_within(p[a], nearby * diagonal, [&](std::uint32_t b) {
      const bool touches = a != b && norm(p[a] - p[b]) <= touching * diagonal;
      if (paths.part(a) != paths.part(b) || (touches && !paths.joined(a, b, nearby * diagonal)))
        pairs.push_back({a, b});
    });
  }
  return pairs;
}

double torn(std::span<const mesh::Edge> pairs, std::span<const Point> rest,
            std::span<const Point> positions) {
  double largest = 0;
  for (const auto& [a, b] : pairs) {
    const double change = std::abs(norm(positions[a] - positions[b]) - norm(rest[a] - rest[b]));
    largest = std::isnan(largest) || change <= largest ? largest : change;  // NaN stays NaN
  }
  return largest / mesh::bounds(rest).diagonal();
}

namespace {

// Results of mean value coordinates up to this are rounding errors. ratio() then returns NaN.
constexpr double next_to_none = 1e-10;

class ModeRuns {
public:
  ModeRuns(const mesh::Surface& model, std::shared_ptr<const pose::Cage> cage,
           std::span<const NamedPose> poses, sym3::Method method)
      : surface_(model), cage_(std::move(cage)), poses_(poses), method_(method), model_(model) {
    near_pairs_ = near_pairs(model);
    nearest_ = nearest_on_cage(*cage_, model_.positions(), all_);
  }

  // Uses a fused binding for stitched deformers, and otherwise a staged binding. Staged bindings are large,
  // so only the last one is kept.
  void measure_shapes(Mode& mode) {
    const pose::Weighting& weighting = mode.deformer.weighting;
    if (mode.deformer.stitched()) {
      deform::FrameDeformer deformer(cage_, fused(weighting).binding, mode.deformer, all_,
                                     stitching(mode.deformer));
      return measure_shapes(mode, deformer);
    }
    if (!staged_ || !(staged_->weighting == weighting)) {
      staged_.reset();
      staged_ = std::make_shared<const weights::Binding>(weights::bind(surface_, *cage_, weighting, all_));
      note(staged_->warnings);
    }
    deform::FrameDeformer deformer(cage_, staged_, mode.deformer, all_);
    measure_shapes(mode, deformer);
  }

  void measure_shapes(Mode& mode, deform::FrameDeformer& deformer) {
    const Deform deform = [&](const pose::Pose& pose) {
      deformer.deform(pose, method_);
      return deformer.positions();
    };
    std::ranges::transform(whole_poses(), mode.deviations.begin(), [&](const WholePose& pose) {
      return deviation(pose, *cage_, model_.positions(), deform);
    });
    mode.leak = leak(*cage_, model_.positions(), deform);
    for (const NamedPose& p : poses_) mode.qualities.push_back(quality(p.pose, deform(p.pose)));
  }
  const RestModel& model() const { return model_; }
  double rest_gap() const { return gap_of(pose::rest_pose(*cage_), model_.positions()); }
  const std::vector<std::string>& warnings() const { return warnings_; }
  void forget_shapes() { staged_.reset(); }

  // Binds the model as the program does, and adds a frame for time_frames().
  void add_frame(Mode& mode) {
    const pose::Weighting& weighting = mode.deformer.weighting;
    const Bound& bound = fused(weighting);
    mode.bind_ms = bound.ms;
    auto frame = std::make_unique<deform::FrameDeformer>(
        cage_, bound.binding, mode.deformer, one_,
        mode.deformer.stitched() ? stitching(mode.deformer) : nullptr);
    if (!frame->engine(method_)) {
      const auto both = std::make_shared<const weights::Binding>(weights::bind(
          mesh::lent(surface_), *cage_, weighting, pose::EngineKind::staged, bound.binding.get(), all_));
      frame = std::make_unique<deform::FrameDeformer>(cage_, both, mode.deformer, one_);
    }
    mode.fused = frame->engine(method_) == pose::EngineKind::fused;
    frames_.push_back({&mode, std::move(frame)});
  }

  // Times a few consecutive frames of each mode, as in a drag.
  void time_frames(std::size_t rounds, base::Progress& progress) {
    constexpr std::size_t in_a_row = 4;
    std::vector<RoundCase> cases;
    for (const auto& [mode, frame] : frames_) {
      cases.push_back({"", in_a_row, [this, f = frame.get()](std::size_t) {
                         for (std::size_t n = 0; n < in_a_row; ++n) f->deform(poses_[0].pose, method_);
                       }});
    }
    const auto results = measure_rounds(cases, rounds, progress);
    for (std::size_t f = 0; f < frames_.size(); ++f)
      frames_[f].mode->frame_ms = 1e-6 * results[f].ns_per_item;
  }

private:
  struct Bound {
    std::shared_ptr<const weights::Binding> binding;
    double ms = 0;
  };
  struct Frame {
    Mode* mode;
    std::unique_ptr<deform::FrameDeformer> deformer;
  };

  const Bound& fused(const pose::Weighting& weighting) {
    const auto known =
        std::ranges::find_if(bound_, [&](const auto& b) { return b.binding->weighting == weighting; });
    if (known != bound_.end()) return *known;
    const double start = base::thread_seconds();
    auto binding = std::make_shared<const weights::Binding>(
        weights::bind(mesh::lent(surface_), *cage_, weighting, pose::EngineKind::fused, nullptr, one_));
    bound_.push_back({std::move(binding), 1e3 * (base::thread_seconds() - start)});
    return bound_.back();
  }

  std::shared_ptr<const deform::Stitching> stitching(const pose::Deformer& deformer) {
    if (!stitching_ || !stitching_->serves(deformer))
      stitching_ =
          std::make_shared<const deform::Stitching>(deform::stitch(surface_, *cage_, all_, deformer));
    return stitching_;
  }

  void note(const std::vector<std::string>& warnings) {
    for (const auto& w : warnings)
      if (std::ranges::find(warnings_, w) == warnings_.end()) warnings_.push_back(w);
  }

  double gap_of(const pose::Pose& pose, std::span<const mesh::Point> positions) const {
    return gap(*cage_, nearest_, model_.vertex_shares(), pose.positions, positions);
  }

  ShapeQuality quality(const pose::Pose& pose, std::span<const mesh::Point> positions) const {
    const auto [energy, collapsed] = model_.distortion(positions);
    const double torn = bench::torn(near_pairs_, model_.positions(), positions);
    return {energy, collapsed, model_.bending(positions), model_.volume(positions), gap_of(pose, positions),
            torn};
  }

  const mesh::Surface& surface_;
  std::shared_ptr<const pose::Cage> cage_;
  std::span<const NamedPose> poses_;
  sym3::Method method_;
  RestModel model_;
  std::vector<mesh::Edge> near_pairs_;
  base::WorkerPool one_{1}, all_{0};
  std::vector<CagePoint> nearest_;
  std::shared_ptr<const weights::Binding> staged_;
  std::deque<Bound> bound_;  // a deque, so that references to its elements stay valid
  std::shared_ptr<const deform::Stitching> stitching_;
  std::vector<Frame> frames_;
  std::vector<std::string> warnings_;
};

std::vector<pose::Deformer> measured_deformers(const ModeSettings& settings) {
  std::vector<pose::Deformer> all, deformers;
  for (const auto preset : base::all_values<pose::Preset>()) all.push_back(pose::deformer_of(preset));
  if (!settings.named_only) {
    const auto others = pose::valid_deformers();
    all.insert(all.end(), others.begin(), others.end());
  }
  for (pose::Deformer deformer : all) {
    if (preset_of(deformer) != pose::Preset::mean_value && !fits(settings.choice, deformer)) continue;
    deformer.weighting.radius = settings.radius.value_or(deformer.weighting.radius);
    if (settings.iterations > 0) deformer.iterations = settings.iterations;
    if (conflict(deformer)) deformer.iterations = 0;
    if (deformer.stitched()) deformer.holding = settings.holding;
    if (std::ranges::find(deformers, deformer) == deformers.end()) deformers.push_back(deformer);
  }
  return deformers;
}

// Groups deformers with equal weights, so that each weighting is computed once.
std::vector<Mode> modes_by_weights(const std::vector<pose::Deformer>& deformers) {
  std::vector<Mode> modes;
  for (const pose::Deformer& deformer : deformers) {
    const auto alike = std::find_if(modes.rbegin(), modes.rend(), [&](const Mode& m) {
      return m.deformer.weighting == deformer.weighting;
    });
    Mode mode;
    mode.deformer = deformer;
    modes.insert(alike == modes.rend() ? modes.end() : alike.base(), std::move(mode));
  }
  return modes;
}

double ratio(double value, double of) {
  return of > next_to_none ? value / of : NAN;
}

void compare_with_mean_values(std::vector<Mode>& modes) {
  const auto reference = std::ranges::find_if(modes, [](const Mode& m) {
    return m.problem.empty() && preset_of(m.deformer) == pose::Preset::mean_value;
  });
  if (reference == modes.end()) return;
  const std::vector<ShapeQuality> theirs = reference->qualities;
  for (Mode& mode : modes)
    for (std::size_t p = 0; p < mode.qualities.size(); ++p) {
      ShapeQuality& q = mode.qualities[p];
      q.energy_ratio = ratio(q.energy, theirs[p].energy);
      q.bending_ratio = ratio(q.bending, theirs[p].bending);
      q.torn_ratio = ratio(q.torn, theirs[p].torn);
    }
}

}  // namespace

ModeComparison measure_modes(const mesh::Surface& model, std::shared_ptr<const pose::Cage> cage,
                             std::span<const NamedPose> poses, const ModeSettings& settings,
                             base::Progress& progress) {
  ModeRuns runs(model, std::move(cage), poses, settings.method);
  const std::vector<pose::Deformer> deformers = measured_deformers(settings);
  std::vector<Mode> modes = modes_by_weights(deformers);
  // The progress after each of the first two stages.
  constexpr double shapes = 0.6, bound = 0.7;
  const auto each = [&](double from, double to, const auto& measure) {
    const auto count = static_cast<double>(modes.size());
    progress.section(from, to);
    for (std::size_t i = 0; i < modes.size(); ++i) {
      Mode& mode = modes[i];
      try {
        if (mode.problem.empty()) measure(mode);
      } catch (const base::Error& error) {  // this cage does not support the deformer
        mode.problem = error.what();
        mode.qualities.clear();
      }
      progress.report(static_cast<double>(i + 1) / count);
    }
  };
  each(0, shapes, [&](Mode& m) { runs.measure_shapes(m); });
  runs.forget_shapes();
  each(shapes, bound, [&](Mode& m) { runs.add_frame(m); });
  progress.section(bound, 1);
  runs.time_frames(settings.rounds, progress);
  compare_with_mean_values(modes);
  std::ranges::sort(modes, {}, [&](const Mode& mode) { return std::ranges::find(deformers, mode.deformer); });
  return {std::move(modes), runs.model().encloses(), runs.model().without_area(), runs.rest_gap(),
          runs.warnings()};
}

std::vector<NamedPose> read_poses(std::span<const std::filesystem::path> files, const pose::Cage& cage,
                                  std::vector<std::string>& warnings) {
  std::vector<NamedPose> poses;
  for (const auto& file : files)
    poses.push_back({without_prefix(file.stem().string(), "pose_"), pose::read_pose(file, cage, warnings)});
  return poses;
}

namespace {

constexpr const char* modes_legend =
    R"(  moved, rigid, similar, affine: largest distance of the model from a map of this kind that poses the
    whole cage, in diagonals; exact: below 1e-9
  leak: one cage vertex moves by a tenth of the diagonal; how far vertices more than a quarter of the diagonal
    away move, in diagonals; median over the model and over 8 cage vertices
  frame, bind: processor time of one thread in ms; *: stage by stage, in double
  volume: relative to rest
  energy: symmetric Dirichlet energy of the triangles, mean by area, 0 at rest
  x mvc: relative to mean value coordinates
  bending: energy of the changes of angle between triangles (discrete shells); kinks increase it
  gap: mean distance of the surface from the posed nearest points of the cage, in diagonals
  torn: largest change of distance between vertices close at rest but not joined by edges, in diagonals
)";

/// A member of ShapeQuality, with its column in the table of a pose and its key in JSON.
struct Measure {
  const char *column, *key;
  double ShapeQuality::*value;
  const char* format;
};

constexpr Measure measures[] = {{"volume", "volume", &ShapeQuality::volume, "%.4f"},
                                {"energy", "energy", &ShapeQuality::energy, "%.3g"},
                                {"x mvc", "energy_to_mean_value", &ShapeQuality::energy_ratio, "%.3f"},
                                {"bending", "bending", &ShapeQuality::bending, "%.3g"},
                                {"x mvc", "bending_to_mean_value", &ShapeQuality::bending_ratio, "%.3f"},
                                {"gap", "gap", &ShapeQuality::gap, "%.4f"},
                                {"torn", "torn", &ShapeQuality::torn, "%.2e"},
                                {"x mvc", "torn_to_mean_value", &ShapeQuality::torn_ratio, "%.2f"}};

struct Summary {
  const char* column;
  double ShapeQuality::*value;
  double OverPoses::*over;
  const char* format;
};

constexpr Summary summaries[] = {{"volume", &ShapeQuality::volume, &OverPoses::least, "%.4f"},
                                 {"to", &ShapeQuality::volume, &OverPoses::most, "%.4f"},
                                 {"energy", &ShapeQuality::energy_ratio, &OverPoses::middle, "%.3f"},
                                 {"worst", &ShapeQuality::energy_ratio, &OverPoses::most, "%.3f"},
                                 {"bending", &ShapeQuality::bending_ratio, &OverPoses::middle, "%.3f"},
                                 {"worst", &ShapeQuality::bending_ratio, &OverPoses::most, "%.3f"},
                                 {"gap", &ShapeQuality::gap, &OverPoses::middle, "%.4f"},
                                 {"torn", &ShapeQuality::torn, &OverPoses::most, "%.2e"},
                                 {"x mvc", &ShapeQuality::torn_ratio, &OverPoses::most, "%.2f"}};

std::string cell(double value, const char* format) {
  return std::isnan(value) ? "-" : base::formatted(format, value);
}

std::string name_of(const Mode& mode) {
  const auto preset = pose::preset_of(mode.deformer);
  return (preset ? std::string(base::entry_of(*preset).word) + ": " : "") + pose::text(mode.deformer);
}

template <class Row>
void print_modes(const std::string& title, std::vector<std::string> columns, std::span<const Mode> modes,
                 const Row& row) {
  Table table{std::move(columns), {}};
  for (const Mode& mode : modes) {
    if (!mode.problem.empty()) continue;
    table.rows.push_back(row(mode));
    table.rows.back().insert(table.rows.back().begin(), name_of(mode));
  }
  print(title, table);
}

std::vector<std::string> own_cells(const Mode& mode) {
  std::vector<std::string> cells;
  for (const double d : mode.deviations) cells.push_back(d <= exactly ? "exact" : cell(d, "%.1e"));
  cells.insert(cells.end(), {cell(mode.leak, "%.1e"), cell(mode.frame_ms, mode.fused ? "%.3f" : "%.3f*"),
                             cell(mode.bind_ms, "%.1f")});
  return cells;
}

template <class Entries>
std::vector<std::string> columns_of(const Entries& entries) {
  std::vector<std::string> columns = {""};
  for (const auto& entry : entries) columns.emplace_back(entry.column);
  return columns;
}

void print_notes(const ModeComparison& compared, std::span<const NamedPose> poses) {
  std::printf("\ngap at rest: %.4f\n", compared.rest_gap);
  if (!compared.encloses) std::printf("note: the model is not closed, so volumes are not compared\n");
  if (compared.without_area)
    std::printf("note: %zu triangles of the model have no area at rest and are ignored\n",
                compared.without_area);
  for (const auto& warning : compared.warnings) std::printf("note: %s\n", warning.c_str());
  for (const Mode& mode : compared.modes) {
    const std::string name = name_of(mode);
    if (!mode.problem.empty())
      std::printf("note: %s was not measured: %s\n", name.c_str(), mode.problem.c_str());
    for (std::size_t p = 0; p < mode.qualities.size(); ++p) {
      if (const auto collapsed = mode.qualities[p].collapsed)
        std::printf("note: %s, %s: %zu triangles have collapsed\n", name.c_str(), poses[p].name.c_str(),
                    collapsed);
    }
  }
}

nlohmann::json to_json(const Mode& mode, std::span<const NamedPose> poses) {
  const pose::Deformer& deformer = mode.deformer;
  nlohmann::json json = {{"name", pose::text(deformer)},
                         {"weights", base::entry_of(deformer.weighting.weights).word},
                         {"blend", base::entry_of(deformer.blend).word}};
  if (const auto preset = pose::preset_of(deformer)) json["deformer"] = base::entry_of(*preset).word;
  if (!mode.problem.empty()) {
    json["problem"] = mode.problem;
    return json;
  }
  for (std::size_t i = 0; i < mode.deviations.size(); ++i)
    json["deviations"][whole_poses()[i].name] = mode.deviations[i];
  json["leak"] = mode.leak;
  json["fused"] = mode.fused;
  json["frame_ms"] = mode.frame_ms;
  json["bind_ms"] = mode.bind_ms;
  for (std::size_t p = 0; p < poses.size(); ++p) {
    nlohmann::json pose = {{"pose", poses[p].name}, {"collapsed", mode.qualities[p].collapsed}};
    for (const Measure& m : measures) pose[m.key] = mode.qualities[p].*m.value;
    json["poses"].push_back(std::move(pose));
  }
  return json;
}

void print(const ModeComparison& compared, std::span<const NamedPose> poses) {
  print_modes("independent of the poses",
              {"", "moved", "rigid", "similar", "affine", "leak", "frame", "bind"}, compared.modes,
              own_cells);
  for (std::size_t p = 0; p < poses.size(); ++p)
    print_modes(poses[p].name, columns_of(measures), compared.modes, [&](const Mode& mode) {
      std::vector<std::string> cells;
      for (const Measure& m : measures) cells.push_back(cell(mode.qualities[p].*m.value, m.format));
      return cells;
    });
  if (poses.size() > 1)
    print_modes("all " + std::to_string(poses.size()) +
                    " poses; energy and bending x mvc: median and worst; gap: median; torn: worst",
                columns_of(summaries), compared.modes, [](const Mode& mode) {
                  std::vector<std::string> cells;
                  for (const Summary& s : summaries)
                    cells.push_back(cell(over_poses(mode, s.value).*s.over, s.format));
                  return cells;
                });
  print_notes(compared, poses);
}

}  // namespace

OverPoses over_poses(const Mode& mode, double ShapeQuality::*value) {
  std::vector<double> values;
  for (const ShapeQuality& q : mode.qualities) values.push_back(q.*value);
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return {std::nan(""), std::nan(""), std::nan("")};
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

nlohmann::json to_json(const ModeComparison& compared, std::span<const NamedPose> poses) {
  nlohmann::json results = nlohmann::json::array();
  for (const Mode& mode : compared.modes) results.push_back(to_json(mode, poses));
  return {{"figure", "modes"}, {"rest_gap", compared.rest_gap}, {"results", results}};
}

void bench_modes(const ModelOptions& options, ModeSettings settings) {
  const document::Document opened = open_model(options.model, options.cage);
  const mesh::Surface& model = *opened.model().surface;
  std::vector<std::string> warnings = opened.cage()->warnings;
  const std::vector<NamedPose> poses = read_poses(options.poses, *opened.cage(), warnings);
  std::printf("modes: %s vertices, %zu cage triangles, method %s, kernel %s, %s\n%s",
              base::with_thousands(model.positions.size()).c_str(), opened.cage()->surface.triangles.size(),
              std::string(sym3::name(settings.method)).c_str(), std::string(sym3::kernel_name()).c_str(),
              base::os::processor_name().c_str(), modes_legend);
  for (const auto& warning : warnings) std::printf("note: %s\n", warning.c_str());
  base::Progress progress;
  settings.rounds = options.rounds;
  const ModeComparison compared = measure_modes(model, opened.cage(), poses, settings, progress);
  print(compared, poses);
  write_json(options.json, to_json(compared, poses));
}

}  // namespace viete::bench
