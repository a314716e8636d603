#include "scene/animation_export.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>

#include "base/atomic_file.h"
#include "base/checksum.h"
#include "base/error.h"
#include "base/quantity.h"
#include "base/worker_pool.h"
#include "mesh/point_cache.h"
#include "mesh/source.h"
#include "mesh/write.h"
#include "scene/animated_model.h"
#include "scene/animation_samples.h"
#include "scene/pose_json.h"

namespace viete::scene {

namespace fs = std::filesystem;
using Planned = base::MadeFiles::Planned;
using State = base::MadeFiles::State;

namespace {

bool is_numbered(const AnimationExport& what) {
  return base::NumberedName::is_pattern(what.model.file);
}

bool has_morphs(const std::string& extension) {
  return extension == "glb" || extension == "gltf";
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
  return "deformed in float, off by up to " + scientific(model.fast_error()) + " of the cage's diagonal";
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

std::uint64_t cache_key(const AnimationExport& what, const AnimatedModel& model) {
  base::Checksum sum;
  const std::uint64_t content = content_key(what.model);
  sum.add(&content, sizeof content);
  const std::string text = timeline_json(what.timeline, 0).dump() + std::to_string(what.first) + ' ' +
                           std::to_string(what.last) + ' ' + std::to_string(what.step) + ' ' +
                           std::to_string(static_cast<int>(model.precision())) +
                           std::string(sym3::kernel_name());
  sum.add(text.data(), text.size());
  return sum.value();
}

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
  mesh::PointCacheWriter writer(what.model.file, cache_head(what, frames), cache_key(what, model));
  AnimationReport report{.frames = frames.size(), .there = writer.frames_there()};
  FrameNotes notes;
  try {
    for (std::size_t i = writer.frames_there(); i < frames.size(); ++i) {
      writer.append(model.floats(frames[i]));
      notes.add(model.notes());
      if (progress) progress->report(static_cast<double>(i + 1) / static_cast<double>(frames.size()));
    }
    writer.finish();
  } catch (...) {
    if (!what.keeps_unfinished) writer.discard();
    throw;
  }
  report.notes = notes.take();
  report.summary = base::counted(frames.size(), "frame") + " of " +
                   base::with_thousands(what.model.model->positions.size()) + " vertices, " +
                   engine_text(model);
  return report;
}

// Keys of the range, its ends, and what comes before a jump.
std::vector<double> sampled_frames(const AnimationExport& what) {
  std::set<double> frames{double(what.first), double(what.last)};
  const auto& keys = what.timeline.keys;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const double frame = keys[i].frame;
    if (frame <= what.first || frame > what.last) continue;
    frames.insert(frame);
    if (i > 0 && keys[i - 1].easing == Easing::hold) frames.insert(frame - jump_frames);
  }
  return {frames.begin(), frames.end()};
}

double diagonal_of(const mesh::Surface& surface) {
  const mesh::Bounds box = mesh::bounds(surface.positions);
  return std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
}

std::string frame_name(double frame) {
  char text[32];
  std::snprintf(text, sizeof text, "frame %.6g", frame);
  return text;
}

mesh::MorphAnimation morph_animation(const AnimationExport& what, const MotionSamples& motion) {
  mesh::MorphAnimation animation{what.model.file.stem().string(), {}, true};
  for (const auto& [frame, positions] : motion.samples)
    animation.keys.push_back({(frame - what.first) / what.rate, frame_name(frame), positions});
  return animation;
}

// Below this nothing can be told from rounding of floats.
constexpr double least_tolerance = 1e-7;

MotionSamples sampled(const AnimationExport& what, AnimatedModel& model, double diagonal, FrameNotes& notes,
                      base::Progress* progress) {
  const MotionAt at = [&](double frame) {
    auto positions = model.positions(frame);
    notes.add(model.notes());
    return positions;
  };
  if (what.every_frame) {
    const auto frames = what.frames();
    return sample_at({frames.begin(), frames.end()}, at, progress);
  }
  return sample_motion(sampled_frames(what), at, std::max(what.tolerance, least_tolerance) * diagonal,
                       progress);
}

AnimationReport write_morphs(const AnimationExport& what, base::WorkerPool& pool, base::Progress* progress) {
  const double most = std::min(fast_frame_error, 0.1 * what.tolerance);
  if (progress) progress->section(0, 0.05);
  AnimatedModel model(what.model, what.timeline, AnimatedModel::Precision::fast, most,
                      judged_frames(what.frames()), pool, progress);
  const double diagonal = std::max(diagonal_of(*what.model.model), 1e-300);
  if (progress) progress->section(0.05, 0.7);
  FrameNotes notes;
  const MotionSamples motion = sampled(what, model, diagonal, notes, progress);
  if (progress) progress->section(0.7, 1);
  const mesh::Content content{
      *what.model.model, what.model.model->positions, {}, what.model.attributes.get()};
  AnimationReport report{.frames = motion.samples.size()};
  notes.add(mesh::write_animated(what.model.file, content, what.model.original.get(),
                                 morph_animation(what, motion), progress));
  const std::string extension = mesh::extension_of(what.model.file);
  const bool original = what.model.original && what.model.original->writes(extension);
  const std::string units = original ? "" : gltf_note(what.model.unit, what.model.up);
  if (!units.empty()) notes.add({units});
  report.notes = notes.take();
  report.summary = base::counted(report.frames, "pose") + " with straight lines between them, off by up to " +
                   scientific(motion.error / diagonal) + " of the model's diagonal; " + engine_text(model);
  return report;
}

// Each frame's key is of its pose, so that another key elsewhere in time makes only those anew that it moves.
std::vector<Planned> planned_frames(const AnimationExport& what, const AnimatedModel& model) {
  const std::uint64_t content = content_key(what.model);
  std::vector<Planned> planned;
  for (const int frame : what.frames()) planned.push_back({frame, pose_key(content, model.pose(frame))});
  return planned;
}

AnimationReport write_frames(const AnimationExport& what, base::WorkerPool& pool, base::Progress* progress) {
  const base::NumberedName name(what.model.file);
  base::MadeFiles made(name);
  AnimatedModel model(what.model, what.timeline, AnimatedModel::Precision::exact, 0, {}, pool);
  const std::vector<Planned> all = planned_frames(what, model);
  const std::vector<Planned> missing = files_to_make(made, name, all, what.replaces_foreign);
  FrameNotes notes;
  const auto count = static_cast<double>(missing.size());
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const auto frame = static_cast<double>(missing[i].number), at = static_cast<double>(i);
    Export one = what.model;
    one.file = name.file(missing[i].number);
    const WholePose pose = model.pose(frame);
    one.pose = pose.cage;
    one.probes = model.probes(pose);
    if (progress) progress->section(at / count, (at + 0.5) / count);
    deform::ExactModel deformed = model.exact(pose, progress);
    if (progress) progress->section((at + 0.5) / count, (at + 1) / count);
    notes.add(write_exact(one, std::move(deformed), progress));
    made.add(missing[i]);
  }
  AnimationReport report{.frames = all.size(), .there = all.size() - missing.size()};
  report.notes = notes.take();
  report.summary = base::counted(all.size(), "frame") + ", deformed in double";
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
  return extension == "pc2" || extension == "mdd" || has_morphs(extension);
}

bool is_frame_format(const std::string& extension) {
  constexpr std::array formats{"obj", "ply", "off", "stl", "glb", "gltf"};
  return std::ranges::find(formats, extension) != formats.end();
}

bool is_video_format(const std::string& extension) {
  constexpr std::array formats{"mp4", "webm", "mkv", "gif"};
  return std::ranges::find(formats, extension) != formats.end();
}

void check_animation_export(const AnimationExport& what) {
  const fs::path& file = what.model.file;
  const std::string extension = mesh::extension_of(file);
  if (!is_animation_format(extension) && !is_frame_format(extension))
    throw base::Error(file.string(), extension.empty() ? "no extension" : "unknown extension ." + extension,
                      "use .pc2, .mdd, .glb or .gltf, or numbered models such as frame_####.obj");
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

AnimationReport write_animation(const AnimationExport& what, base::Progress* progress) {
  check_animation_export(what);
  base::WorkerPool pool;
  if (is_numbered(what)) return write_frames(what, pool, progress);
  if (mesh::point_cache_format(what.model.file)) return write_cache(what, pool, progress);
  return write_morphs(what, pool, progress);
}

std::vector<Planned> files_to_make(base::MadeFiles& made, const base::NumberedName& name,
                                   std::span<const Planned> files, bool replaces) {
  std::vector<Planned> missing, foreign;
  for (const Planned& file : files) {
    const State state = made.state(file);
    if (state != State::whole) missing.push_back(file);
    if (state == State::foreign) foreign.push_back(file);
  }
  if (!foreign.empty() && !replaces)
    throw base::Error(
        name.file(foreign.front().number).string(),
        "this file was made or changed otherwise, and would be replaced" +
            (foreign.size() > 1 ? ", as " + base::with_thousands(foreign.size() - 1) + " more would"
                                : std::string()),
        "choose another name, move them away, or use viete animate --force");
  made.begin(missing);
  return missing;
}

std::uint64_t pose_key(std::uint64_t before, const WholePose& pose) {
  base::Checksum sum;
  const auto add = [&](const auto& values) { sum.add(values.data(), values.size() * sizeof(values[0])); };
  sum.add(&before, sizeof before);
  add(pose.cage.positions);
  add(pose.cage.turns);
  add(pose.probes);
  return sum.value();
}

}  // namespace viete::scene
