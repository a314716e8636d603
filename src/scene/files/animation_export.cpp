#include "scene/files/animation_export.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/text.h"
#include "base/worker_pool.h"
#include "mesh/formats/format_table.h"
#include "mesh/formats/point_cache.h"
#include "mesh/formats/source.h"
#include "mesh/formats/write.h"
#include "scene/files/animated_model.h"
#include "scene/files/morph_plan.h"
#include "scene/files/pose_json.h"

namespace viete::scene {

namespace fs = std::filesystem;

namespace {

bool is_numbered(const AnimationExport& what) {
  return base::NumberedName::is_pattern(what.model.file);
}

// Where float frames are judged.
std::array<double, 3> judged_frames(const std::vector<int>& frames) {
  return {double(frames.front()), double(frames[frames.size() / 2]), double(frames.back())};
}

std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

std::string engine_text(const AnimatedModel& model) {
  if (model.precision() == AnimatedModel::Precision::exact) return "deformed in double";
  return "deformed in float, off by up to " + at_most(model.fast_error()) + " of the cage's diagonal";
}

// Frame after frame the same may be said.
class FrameNotes {
public:
  void add(const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
      if (said_.insert(note).second) all_.push_back(note);
  }
  std::vector<std::string> take() {
    constexpr std::size_t most = 12;
    if (all_.size() > most) {
      const std::size_t left = all_.size() - most + 1;
      all_.resize(most - 1);
      all_.push_back("and " + base::with_thousands(left) + " more notes of other frames");
    }
    return std::move(all_);
  }

private:
  std::set<std::string> said_;
  std::vector<std::string> all_;
};

mesh::PointCacheHead cache_head(const AnimationExport& what, const std::vector<int>& frames) {
  mesh::PointCacheHead head;
  head.format = *mesh::point_cache_format(what.model.file);
  head.points = what.model.model->positions.size();
  head.frames = frames.size();
  head.start = static_cast<float>(what.first);
  head.rate = static_cast<float>(what.step);
  if (head.format == mesh::PointCacheFormat::mdd)
    for (const int frame : frames)
      head.seconds.push_back(static_cast<float>((frame - what.first) / what.rate));
  return head;
}

AnimationReport write_cache(const AnimationExport& what, base::WorkerPool& pool, base::Progress* progress) {
  const std::vector<int> frames = what.frames();
  if (progress) progress->section(0, 0.02);
  AnimatedModel model(what.model, what.timeline, AnimatedModel::Precision::fast, fast_frame_error,
                      judged_frames(frames), pool, progress);
  if (progress) progress->section(0.02, 1);
  AnimationReport report{.frames = frames.size()};
  FrameNotes notes;
  mesh::write_point_cache(what.model.file, cache_head(what, frames), [&](std::size_t i) {
    if (progress) progress->report(static_cast<double>(i) / static_cast<double>(frames.size()));
    const std::span<const float> positions = model.floats(frames[i]);
    notes.add(model.notes());
    return positions;
  });
  report.notes = notes.take();
  report.summary = base::counted(frames.size(), "frame") + " of " +
                   base::with_thousands(what.model.model->positions.size()) + " vertices, " +
                   engine_text(model);
  return report;
}

// Keys of the range, its ends, and what comes before a jump.
std::vector<double> sampled_frames(const AnimationExport& what) {
  std::set<double> frames{double(what.first), double(what.last)};
  const double jump = std::max(jump_frames, (what.last - what.first) * 0x1p-21);  // floats tell it apart
  const auto& keys = what.timeline.keys;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const double frame = keys[i].frame;
    if (frame <= what.first || frame > what.last) continue;
    frames.insert(frame);
    if (i > 0 && keys[i - 1].easing == Easing::hold) frames.insert(frame - jump);
  }
  return {frames.begin(), frames.end()};
}

double diagonal_of(const mesh::Surface& surface) {
  return std::max(mesh::bounds(surface.positions).diagonal(), 1e-300);
}

std::string frame_name(double frame) {
  char text[32];
  std::snprintf(text, sizeof text, "frame %.6g", frame);
  return text;
}

// Below this nothing can be told from rounding of floats.
constexpr double least_tolerance = 1e-7;

// Of a target: three floats, and three of its normal.
double bytes_of_vertex(const AnimationExport& what) {
  return what.normals ? 24 : 12;
}

// A GLB file says its size in 32 bits, and holds the model too.
double most_bytes(const AnimationExport& what) {
  return mesh::extension_of(what.model.file) == "glb" ? std::min(what.most_bytes, 4.2e9) : what.most_bytes;
}

// The model in time, and how few targets show it.
class MorphedModel {
public:
  MorphedModel(const AnimationExport& what, base::WorkerPool& pool, base::Progress* progress)
      : what_(what), pool_(pool), diagonal_(diagonal_of(*what.model.model)) {
    if (progress) progress->section(0, 0.05);
    model_.emplace(what.model, what.timeline, AnimatedModel::Precision::fast,
                   std::min(fast_frame_error, 0.1 * what.tolerance), judged_frames(what.frames()), pool,
                   progress);
  }

  // By every so many vertices.
  MorphPlan plan(std::size_t step, base::Progress* progress) {
    const auto given = what_.frames();
    return plan_morphs(
        some(what_.model.model->positions, step),
        what_.every_frame ? std::vector<double>(given.begin(), given.end()) : sampled_frames(what_),
        [&, step](double frame) { return some(at(frame), step); },
        {.tolerance = std::max(what_.tolerance, least_tolerance) * diagonal_,
         .refines = !what_.every_frame,
         .bytes_of_vertex = bytes_of_vertex(what_) * static_cast<double>(step),
         .most_bytes = most_bytes(what_),
         .to_allow_more = what_.to_allow_more},
        pool_, progress);
  }

  mesh::MorphMotion motion(const MorphPlan& plan) {
    mesh::MorphMotion motion;
    motion.name = what_.model.file.stem().string();
    motion.normals = what_.normals;
    for (const double frame : plan.frames) motion.seconds.push_back((frame - what_.first) / what_.rate);
    for (const auto& target : plan.targets) motion.targets.push_back(frame_name(target.front().frame));
    if (plan.steady) motion.targets.back() = "steady";
    motion.weights = plan.weights;
    motion.moves = plan.moves;
    motion.positions = [&](std::size_t t) {
      return plan.positions(t, what_.model.model->positions, [&](double frame) { return at(frame); });
    };
    return motion;
  }

  void tell(const MorphPlan& plan, AnimationReport& report) {
    report.targets = plan.targets.size();
    report.frames = plan.frames.size();
    report.notes = notes_.take();
    const double asked = what_.tolerance * diagonal_;
    if (plan.error > asked && !what_.every_frame)
      report.notes.push_back("the tolerance of " + scientific(what_.tolerance) +
                             " is below what floats tell apart in coordinates of up to " +
                             scientific(plan.farthest) + ": it is not kept everywhere");
    report.summary = base::counted(report.targets, "morph target") + " that " +
                     (report.targets == 1 ? "takes " : "take ") + base::counted(report.frames, "pose") +
                     " with straight lines between them, off by up to " + at_most(plan.error / diagonal_) +
                     " of the model's diagonal; " + engine_text(*model_);
  }

  FrameNotes& notes() { return notes_; }

private:
  static std::vector<mesh::Point> some(std::vector<mesh::Point> all, std::size_t step) {
    for (std::size_t i = 0; i * step < all.size(); ++i) all[i] = all[i * step];
    all.resize((all.size() + step - 1) / step);
    return all;
  }

  std::vector<mesh::Point> at(double frame) {
    auto positions = model_->positions(frame);
    notes_.add(model_->notes());
    return positions;
  }

  const AnimationExport& what_;
  base::WorkerPool& pool_;
  double diagonal_;
  std::optional<AnimatedModel> model_;
  FrameNotes notes_;
};

// Text holds the bytes as letters, and is put together in memory.
void require_memory_of(const AnimationExport& what, const MorphPlan& plan) {
  const double copies = mesh::extension_of(what.model.file) == "glb" ? 1 : 4;
  base::require_memory({copies * plan.bytes(bytes_of_vertex(what)),
                        base::counted(plan.targets.size(), "morph target") + " take",
                        "allow a larger tolerance, export fewer frames, or write a point cache (.pc2)",
                        what.model.file.string()});
}

AnimationReport write_morphs(const AnimationExport& what, base::WorkerPool& pool, base::Progress* progress) {
  MorphedModel model(what, pool, progress);
  const MorphPlan plan = model.plan(1, progress);
  require_memory_of(what, plan);
  if (progress) progress->section(0.7, 1);
  const mesh::Content content{
      *what.model.model, what.model.model->positions, {}, what.model.attributes.get()};
  model.notes().add(mesh::write_animated(what.model.file, content, what.model.original.get(),
                                         model.motion(plan), progress));
  const bool original = mesh::writes_itself(what.model.original.get(), what.model.file);
  const std::string units = original ? "" : gltf_note(what.model.up);
  if (!units.empty()) model.notes().add({units});
  AnimationReport report;
  model.tell(plan, report);
  return report;
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
    const WholePose pose = model.pose(frame);
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
  report.summary = base::counted(frames.size(), "frame") + ", deformed in double";
  return report;
}

}  // namespace

std::vector<int> AnimationExport::frames() const {
  std::vector<int> all;
  for (int frame = first; frame <= last; frame += step) all.push_back(frame);
  return all;
}

AnimationExport animation_export_of(const Document& document, const fs::path& file) {
  AnimationExport what{export_of(document, file), document.timeline};
  what.first = document.timeline.first;
  what.last = document.timeline.last;
  what.rate = document.timeline.rate;
  return what;
}

bool is_animation_format(const std::string& extension) {
  const mesh::Format* format = mesh::format_by_extension(extension);
  return format && (format->is_sequence || format->holds_morphs);
}

bool is_video_format(const std::string& extension) {
  constexpr std::array formats{"mp4", "webm", "mkv", "gif"};
  return std::ranges::find(formats, extension) != formats.end();
}

void check_animation_export(const AnimationExport& what) {
  const fs::path& file = what.model.file;
  const std::string extension = mesh::extension_of(file);
  if (!mesh::format_by_extension(extension))
    throw base::Error(file.string(), extension.empty() ? "no extension" : "unknown extension ." + extension,
                      "use " + mesh::format_extensions(mesh::is_sequence, ", ") + ", " +
                          mesh::format_extensions(mesh::holds_morphs) +
                          ", or numbered models such as frame_####.obj");
  if (!is_numbered(what) && !is_animation_format(extension))
    throw base::Error(file.string(), "a file of this format holds one frame",
                      "write numbered files, " + (file.stem() += "_####." + extension).string());
  if (is_numbered(what) && mesh::point_cache_format(file))
    throw base::Error(file.string(), "a point cache holds all frames", "leave the #### out of its name");
  if (what.timeline.keys.empty())
    throw base::Error("", "there are no keys in time, so that nothing moves",
                      "set keys on the timeline, and save the session");
  base::check_replaceable(is_numbered(what) ? base::NumberedName(file).file(what.first) : file);
}

MorphEstimate estimate_morphs(const AnimationExport& what, base::Progress* progress) {
  base::WorkerPool pool;
  MorphedModel model(what, pool, progress);
  constexpr std::size_t enough = 2000;
  const std::size_t step = std::max<std::size_t>(1, what.model.model->positions.size() / enough);
  const MorphPlan plan = model.plan(step, progress);
  return {plan.targets.size(), plan.bytes(bytes_of_vertex(what) * static_cast<double>(step))};
}

AnimationReport write_animation(const AnimationExport& what, base::Progress* progress) {
  check_animation_export(what);
  base::WorkerPool pool;
  if (is_numbered(what)) return write_frames(what, pool, progress);
  if (mesh::point_cache_format(what.model.file)) return write_cache(what, pool, progress);
  return write_morphs(what, pool, progress);
}

std::vector<std::string> other_files_note(const base::NumberedName& name, std::span<const int> frames) {
  std::vector<std::string> others;
  for (const base::NumberedFile& file : name.find())
    if (!std::ranges::binary_search(frames, file.number)) others.push_back(file.path.filename().string());
  if (others.empty()) return {};
  if (others.size() == 1) return {others.front() + " was there before and is not one of these frames"};
  return {base::counted(others.size(), "file") + " from " + others.front() + " to " + others.back() +
          " were there before and are not among these frames"};
}

}  // namespace viete::scene
