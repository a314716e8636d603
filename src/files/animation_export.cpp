#include "files/animation_export.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/memory.h"
#include "base/text.h"
#include "base/worker_pool.h"
#include "files/animated_model.h"
#include "formats/format_table.h"
#include "formats/point_cache.h"
#include "formats/text_writer.h"
#include "formats/write.h"

namespace viete::files {

namespace fs = std::filesystem;

namespace {

bool is_numbered(const AnimationExport& what) {
  return base::NumberedName::is_pattern(what.model.file);
}

std::array<double, 3> sample_frames(const std::vector<int>& frames) {
  return {double(frames.front()), double(frames[frames.size() / 2]), double(frames.back())};
}

// Includes the rounding of the file, if AnimatedModel::floats() computed the frames.
std::string engine_text(const AnimatedModel& model, double cage_diagonal) {
  const bool exact = model.precision() == AnimatedModel::Precision::exact;
  const double rounding = std::sqrt(3.0) * model.rounding() / cage_diagonal;
  if (exact && rounding == 0) return "deformed in double precision";
  const double error = (exact ? 0 : model.fast_error()) + rounding;
  return std::string("deformed in ") + (exact ? "double precision and rounded to float" : "float") +
         ", error up to " + at_most(error) + " of the cage's diagonal";
}

double diagonal_of(const AnimationExport& what) {
  return mesh::bounds(what.model.model->positions).diagonal();
}

// Collects notes of all frames. Equal texts appear only once.
class FrameNotes {
public:
  void add(const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
      if (seen_.insert(note).second) all_.push_back(note);
  }
  std::vector<std::string> take() {
    constexpr std::size_t most = 12;
    if (all_.size() > most) {
      const std::size_t left = all_.size() - most + 1;
      all_.resize(most - 1);
      all_.push_back("and " + base::with_thousands(left) + " more notes about other frames");
    }
    return std::move(all_);
  }

private:
  std::set<std::string> seen_;
  std::vector<std::string> all_;
};

formats::PointCacheHead cache_head(const AnimationExport& what, const std::vector<int>& frames) {
  formats::PointCacheHead head;
  head.format = *formats::point_cache_format(what.model.file);
  head.points = what.model.model->positions.size();
  head.frames = frames.size();
  head.start = static_cast<float>(what.first);
  head.rate = static_cast<float>(what.step);
  if (head.format == formats::PointCacheFormat::mdd)
    for (const int frame : frames)
      head.seconds.push_back(static_cast<float>((frame - what.first) / what.rate));
  return head;
}

AnimationReport write_cache(const AnimationExport& what, base::WorkerPool& pool, base::Progress* progress) {
  const std::vector<int> frames = what.frames();
  if (progress) progress->section(0, 0.02);
  AnimatedModel model(what.model, what.timeline, AnimatedModel::Precision::fast, fast_frame_error,
                      sample_frames(frames), pool, progress);
  if (progress) progress->section(0.02, 1);
  AnimationReport report{.frames = frames.size()};
  FrameNotes notes;
  formats::write_point_cache(what.model.file, cache_head(what, frames), [&](std::size_t i) {
    if (progress) progress->report(static_cast<double>(i) / static_cast<double>(frames.size()));
    const std::span<const float> positions = model.floats(frames[i]);
    notes.add(model.notes());
    return positions;
  });
  notes.add(formats::rounding_notes(model.rounding(), diagonal_of(what)));
  if (what.model.splats) notes.add({"left out of the point cache: " + std::string(formats::splat_content)});
  report.notes = notes.take();
  report.summary = base::counted(frames.size(), "frame") + " of " +
                   base::with_thousands(what.model.model->positions.size()) + " vertices, " +
                   engine_text(model, what.model.cage->diagonal);
  return report;
}

// Tolerance for rounding to float, relative to the distance from the model's centre.
constexpr double float_noise = 0x1p-22;

struct Sample {
  double frame;
  bool is_key;  // if true, a linear piece must end at this frame
};

// Returns the exported frames, the keys, and a frame just before each jump. Poses jump after Easing::hold.
std::vector<Sample> samples_of(const AnimationExport& what) {
  std::map<double, bool> samples{{double(what.first), true}, {double(what.last), true}};
  for (const int frame : what.frames()) samples.emplace(frame, false);
  const double jump = std::max(1e-3, (what.last - what.first) * 0x1p-21);  // not lost by rounding to float
  for_each_track(what.timeline, [&](const auto& keys, const std::string&) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const double frame = keys[i].frame;
      if constexpr (requires { keys[i].easing; }) {
        if (frame <= what.first || frame > what.last) continue;
        samples[frame] = true;
        if (i > 0 && keys[i - 1].easing == document::Easing::hold) samples[frame - jump] = true;
      }
    }
  });
  std::vector<Sample> all;
  for (const auto& [frame, is_key] : samples) all.push_back({frame, is_key});
  return all;
}

// Checks whether a linear piece from a first pose to a later pose approximates all poses in between. Stores
// the smallest and the largest allowed slope of each coordinate.
class StraightLines {
public:
  StraightLines(double tolerance, const mesh::Point& center)
      : reach_(tolerance / std::sqrt(3.0)), center_(center) {}

  void start(double frame, std::span<const mesh::Point> pose) {
    constexpr double any = std::numeric_limits<double>::infinity();
    frame_ = frame;
    from_.assign(pose.begin(), pose.end());
    flattest_.assign(pose.size(), {-any, -any, -any});
    steepest_.assign(pose.size(), {any, any, any});
  }
  // Returns true if the line to `pose` approximates all earlier poses. Later calls also compare with `pose`.
  bool lead_to(double frame, std::span<const mesh::Point> pose) {
    const double length = frame - frame_;
    bool near = true;
    for (std::size_t v = 0; v < pose.size(); ++v)
      for (std::size_t c = 0; c < 3; ++c) {
        const double change = pose[v][c] - from_[v][c],
                     reach = std::max(reach_, float_noise * std::abs(pose[v][c] - center_[c]));
        near &= flattest_[v][c] <= change / length && change / length <= steepest_[v][c];
        flattest_[v][c] = std::max(flattest_[v][c], (change - reach) / length);
        steepest_[v][c] = std::min(steepest_[v][c], (change + reach) / length);
      }
    return near;
  }

private:
  double reach_, frame_ = 0;
  mesh::Point center_;
  std::vector<mesh::Point> from_, flattest_, steepest_;
};

// A morph target, and its weight at a frame.
struct MorphTarget {
  std::string name;
  std::function<double(double frame)> weight;
  std::function<std::vector<mesh::Point>()> positions;
};

// Frames at which linear pieces begin or end. Each frame has a morph target, except if the model rests in it
// or if the targets are keyed shapes.
struct MorphPlan {
  std::vector<double> frames;  // in ascending order
  std::vector<MorphTarget> targets;
  std::vector<char> moves;  // for each vertex, true if the vertex leaves its rest position

  double bytes(double of_vertex) const {
    const auto moving = static_cast<double>(std::ranges::count(moves, 1)),
               moments = static_cast<double>(frames.size());
    return static_cast<double>(targets.size()) * (of_vertex * moving + 4 * moments) + 4 * moments;
  }
};

std::string frame_name(double frame) {
  return base::formatted("frame %.6g", frame);
}

// The keyed shapes, if their weights have keys and the positions are linear in the weights: with linear
// interpolation, without a cage and probes. Otherwise returns nothing.
std::vector<MorphTarget> shape_targets(const AnimationExport& what) {
  const document::Timeline& timeline = what.timeline;
  const auto is_pin = [](const pose::Probe& probe) { return probe.pin.has_value(); };
  if (!timeline.linear || timeline.channels.empty() || what.model.cage->element_count() > 0 ||
      !std::ranges::all_of(what.model.probes.all, is_pin))
    return {};
  std::vector<MorphTarget> targets;
  const auto add = [&](const std::string& name, const document::SharedPose& pose, auto weight) {
    if (pose->shape) targets.push_back({name, weight, [pose] { return *pose->shape; }});
  };
  for (std::size_t i = 0; i < timeline.keys.size(); ++i) {
    const auto share = [&timeline, i](double frame) {
      const auto shares = moment_at(timeline, frame).shares;
      const auto found = std::ranges::find(shares, i, &document::KeyShare::key);
      return found == shares.end() ? 0 : found->factor;
    };
    add(frame_name(timeline.keys[i].frame), timeline.keys[i].pose, share);
  }
  for (const document::Channel& channel : timeline.channels)
    add(channel.name, channel.pose, [&](double frame) { return weight_at(timeline, channel, frame); });
  return targets;
}

void check_floats(std::span<const mesh::Point> pose, double frame) {
  constexpr double most = std::numeric_limits<float>::max() / 4;
  for (std::size_t v = 0; v < pose.size(); ++v)
    if (!formats::is_place(pose[v], most))
      throw base::Error("vertex " + std::to_string(v),
                        "the position at " + frame_name(frame) + " exceeds the range of glTF (float)",
                        "export numbered models (frame_####.ply), or scale the model");
}

constexpr double least_tolerance = 1e-7;  // about the rounding error of floats

class MorphedModel {
public:
  MorphedModel(const AnimationExport& what, base::WorkerPool& pool, base::Progress* progress)
      : what_(what), diagonal_(std::max(diagonal_of(what), 1e-300)) {
    if (progress) progress->section(0, 0.05);
    model_.emplace(what.model, what.timeline, AnimatedModel::Precision::fast,
                   std::min(fast_frame_error, 0.1 * what.tolerance), sample_frames(what.frames()), pool,
                   progress);
  }

  MorphPlan plan(base::Progress* progress) {
    const auto& rest = what_.model.model->positions;
    MorphPlan plan{{}, shape_targets(what_), std::vector<char>(rest.size(), 0)};
    if (!plan.targets.empty()) return plan_of_shapes(std::move(plan));
    if (progress) progress->section(0.05, 0.7);
    const double tolerance = tolerance_ * diagonal_;
    StraightLines lines(tolerance, mesh::bounds(rest).center());
    const auto is_still = [&](const mesh::Point& p, const mesh::Point& q) {
      return mesh::norm(p - q) <= tolerance;
    };
    const auto take = [&](double frame, std::span<const mesh::Point> pose) {
      if (!std::ranges::equal(pose, rest, is_still))
        plan.targets.push_back({frame_name(frame), [frame](double at) { return double(at == frame); },
                                [this, frame] { return at(frame); }});
      plan.frames.push_back(frame);
      check_size(plan);
      lines.start(frame, pose);
    };
    std::vector<mesh::Point> before;
    const std::vector<Sample> samples = samples_of(what_);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double frame = samples[i].frame;
      auto pose = at(frame);
      take_moves(plan, pose, frame, tolerance);
      if (!plan.frames.empty() && !lines.lead_to(frame, pose)) {
        take(samples[i - 1].frame, before);
        lines.lead_to(frame, pose);
      }
      if (samples[i].is_key) take(frame, pose);
      before = std::move(pose);
      if (progress) progress->report(static_cast<double>(i + 1) / static_cast<double>(samples.size()));
    }
    return plan;
  }

  // A target has three floats for each moving vertex, and with normals six floats.
  double bytes(const MorphPlan& plan) const { return plan.bytes(what_.normals ? 24 : 12); }

  formats::MorphMotion motion(const MorphPlan& plan) {
    formats::MorphMotion motion;
    motion.name = what_.model.file.stem().string();
    motion.normals = what_.normals;
    for (const MorphTarget& target : plan.targets) motion.targets.push_back(target.name);
    for (const double frame : plan.frames) {
      motion.seconds.push_back((frame - what_.first) / what_.rate);
      for (const MorphTarget& target : plan.targets)
        motion.weights.push_back(static_cast<float>(target.weight(frame)));
    }
    motion.moves = plan.moves;
    motion.positions = [&](std::size_t target) {
      auto pose = plan.targets[target].positions();
      for (std::size_t v = 0; v < pose.size(); ++v)
        if (!plan.moves[v]) pose[v] = what_.model.model->positions[v];
      return pose;
    };
    return motion;
  }

  AnimationReport report(const MorphPlan& plan) {
    AnimationReport report{.frames = plan.frames.size()};
    report.notes = notes_.take();
    report.summary = base::counted(plan.targets.size(), "morph target") +
                     " with linear interpolation, error up to " + error_text() +
                     " of the model's diagonal; " + engine_text(*model_, what_.model.cage->diagonal);
    return report;
  }

  FrameNotes& notes() { return notes_; }

private:
  void take_moves(MorphPlan& plan, std::span<const mesh::Point> pose, double frame, double still) {
    check_floats(pose, frame);
    const auto& rest = what_.model.model->positions;
    for (std::size_t v = 0; v < pose.size(); ++v) {
      plan.moves[v] |= !(mesh::norm(pose[v] - rest[v]) <= still);
      farthest_ = std::max(farthest_, mesh::largest_abs(pose[v] - rest[v]));
    }
  }

  MorphPlan plan_of_shapes(MorphPlan plan) {
    tolerance_ = least_tolerance;
    for (const Sample& sample : samples_of(what_)) plan.frames.push_back(sample.frame);
    for (const MorphTarget& shape : plan.targets) take_moves(plan, shape.positions(), what_.first, 0);
    check_size(plan);
    return plan;
  }

  std::vector<mesh::Point> at(double frame) {
    auto positions = model_->positions(frame);
    notes_.add(model_->notes());
    return positions;
  }

  // The tolerance, and the rounding of the offsets if it is not negligible.
  std::string error_text() const {
    const double rounding = 0x1p-23 * farthest_ / diagonal_;
    if (rounding < 0.05 * tolerance_) return base::formatted("%.6g", tolerance_);
    return at_most(tolerance_ + rounding);
  }

  // If the targets are too large, throws base::Error. The GLB format allows at most 4 GB.
  void check_size(const MorphPlan& plan) const {
    const bool binary = base::extension_of(what_.model.file) == "glb";
    const double most = binary ? std::min(what_.most_bytes, 4.2e9) : what_.most_bytes, size = bytes(plan);
    if (size <= most) return;
    throw base::Error("",
                      "the motion needs at least " + base::counted(plan.targets.size(), "morph target") +
                          " of " + base::memory_size(size) + " in total; the limit is " +
                          base::memory_size(most),
                      "allow a larger tolerance, or export a point cache (.pc2)");
  }

  const AnimationExport& what_;
  double diagonal_;                                                // of the model
  double tolerance_ = std::max(what_.tolerance, least_tolerance);  // relative to the diagonal
  double farthest_ = 0;  // the largest change of a coordinate by a pose, in the model's unit
  std::optional<AnimatedModel> model_;
  FrameNotes notes_;
};

AnimationReport write_morphs(const AnimationExport& what, base::WorkerPool& pool, base::Progress* progress) {
  MorphedModel model(what, pool, progress);
  const MorphPlan plan = model.plan(progress);
  // The text of a .gltf file, with targets in base64, is created in memory.
  const double copies = base::extension_of(what.model.file) == "glb" ? 1 : 4;
  base::require_memory({copies * model.bytes(plan),
                        base::counted(plan.targets.size(), "morph target") + " take",
                        "allow a larger tolerance, export fewer frames, or export a point cache (.pc2)",
                        what.model.file.string()});
  if (progress) progress->section(0.7, 1);
  const formats::Content content{
      *what.model.model, what.model.model->positions, {}, what.model.attributes.get()};
  model.notes().add(formats::write_animated(what.model.file, content, what.model.original.get(),
                                            model.motion(plan), progress));
  const bool original = formats::writes_itself(what.model.original.get(), what.model.file);
  if (!original) model.notes().add(gltf_notes(what.model.up));
  return model.report(plan);
}

AnimationReport write_frames(const AnimationExport& what, base::WorkerPool& pool, base::Progress* progress) {
  const base::NumberedName name(what.model.file);
  const std::vector<int> frames = what.frames();
  check_frames_are_new(name, frames, what.force);
  AnimatedModel model(what.model, what.timeline, AnimatedModel::Precision::exact, 0, {}, pool);
  FrameNotes notes;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double frame = frames[i];
    const auto share = [&](double done) { return done / static_cast<double>(frames.size()); };
    const auto at = static_cast<double>(i);
    Export one = what.model;
    one.file = name.file(frames[i]);
    const document::WholePose pose = model.pose(frame);
    one.pose = pose.cage;
    one.probes = model.probes(pose);
    one.shape = pose.shape;
    if (progress) progress->section(share(at), share(at + 0.5));
    deform::ExactModel deformed = model.exact(pose, progress);
    if (progress) progress->section(share(at + 0.5), share(at + 1));
    notes.add(write_exact(one, std::move(deformed), progress));
  }
  AnimationReport report{.frames = frames.size()};
  notes.add(other_files_note(name, frames));
  report.notes = notes.take();
  report.summary = base::counted(frames.size(), "frame") + ", deformed in double precision";
  return report;
}

}  // namespace

std::vector<int> AnimationExport::frames() const {
  std::vector<int> all;
  for (int frame = first; frame <= last; frame += step) all.push_back(frame);
  return all;
}

AnimationExport animation_export_of(const document::Document& document, const fs::path& file) {
  AnimationExport what{export_of(document, file), document.timeline()};
  what.first = document.timeline().first;
  what.last = document.timeline().last;
  what.rate = document.timeline().rate;
  return what;
}

bool is_animation_format(const std::string& extension) {
  const formats::Format* format = formats::format_by_extension(extension);
  return format && (format->is_sequence || format->holds_morphs);
}

void check_animation_export(const AnimationExport& what) {
  const fs::path& file = what.model.file;
  const std::string extension = base::extension_of(file);
  if (!formats::format_by_extension(extension))
    throw base::Error(
        file.string(),
        extension.empty() ? "the file name has no extension" : "unknown extension ." + extension,
        "use " + formats::format_extensions(formats::is_sequence, ", ") + ", " +
            formats::format_extensions(formats::holds_morphs) + ", a film (" +
            base::listed(std::vector<std::string>(film_formats.begin(), film_formats.end())) +
            "), or numbered models or pictures (frame_####.obj, frame_####.png)");
  if (!is_numbered(what) && !is_animation_format(extension))
    throw base::Error(file.string(), "this format stores only one frame per file",
                      "use a numbered name: " + (file.stem() += "_####." + extension).string());
  if (is_numbered(what) && formats::point_cache_format(file))
    throw base::Error(file.string(), "a point cache stores all frames in one file",
                      "remove #### from the name");
  formats::check_deformable(file, what.model.original.get());
  if (!what.timeline.has_poses())
    throw base::Error("", "the timeline has no keys", "set keys on the timeline, and save the session");
  base::check_replaceable(is_numbered(what) ? base::NumberedName(file).file(what.first) : file);
}

AnimationReport write_animation(const AnimationExport& what, base::Progress* progress) {
  check_animation_export(what);
  base::WorkerPool pool;
  if (is_numbered(what)) return write_frames(what, pool, progress);
  if (formats::point_cache_format(what.model.file)) return write_cache(what, pool, progress);
  return write_morphs(what, pool, progress);
}

std::vector<std::string> other_files_note(const base::NumberedName& name, std::span<const int> frames) {
  std::vector<std::string> others;
  for (const base::NumberedFile& file : name.find())
    if (!std::ranges::binary_search(frames, file.number)) others.push_back(file.path.filename().string());
  if (others.empty()) return {};
  if (others.size() == 1) return {others.front() + " already existed and is not one of these frames"};
  return {base::counted(others.size(), "file") + " from " + others.front() + " to " + others.back() +
          " already existed and are not among these frames"};
}

}  // namespace viete::files
