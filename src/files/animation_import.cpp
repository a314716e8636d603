#include "files/animation_import.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/memory.h"
#include "base/numbered_files.h"
#include "base/text.h"
#include "document/time_edit.h"
#include "files/shape_import.h"
#include "formats/format_table.h"
#include "formats/point_cache.h"
#include "formats/read.h"
#include "formats/source.h"
#include "pose/pose_file.h"

namespace viete::files {

namespace fs = std::filesystem;

namespace {

document::SharedPose shared(pose::Pose pose) {
  return std::make_shared<const document::WholePose>(document::WholePose{std::move(pose), {}});
}

void report_part(base::Progress* progress, std::size_t done, std::size_t of) {
  if (progress)
    progress->report(static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(of, 1)));
}

void add_targets(const fs::path& file, const MorphPositions& found, ImportedPoses& all) {
  const formats::MorphClip& clip = *found.clip;
  for (std::size_t i = 0; i < clip.targets().size(); ++i) {
    auto positions = found.at_target(i);
    check_places(file.string() + ": " + clip.targets()[i], positions);
    all.poses.push_back({clip.targets()[i], shared({std::move(positions), {}})});
  }
}

void add_poses_of(const fs::path& file, const pose::Cage& cage, ImportedPoses& all) {
  all.files.push_back(file);
  if (formats::is_a(formats::holds_morphs, file)) {
    const MorphPositions found = morphs_of(file, {cage.surface, "the cage"}, all.warnings);
    if (found.clip) return add_targets(file, found, all);
  }
  pose::Pose pose = pose::read_pose(file, cage, all.warnings);
  check_places(file.string(), pose.positions);
  all.poses.push_back({file.stem().string(), shared(std::move(pose))});
}

void check_key_count(const std::string& file, std::size_t count) {
  if (count <= document::Timeline::most_keys) return;
  throw base::Error(file,
                    "the file has " + base::counted(count, "frame") + ", and a timeline can have " +
                        base::with_thousands(document::Timeline::most_keys) + " keys",
                    "export every second frame, or fewer");
}

class KeyBuilder {
public:
  KeyBuilder(std::string file, document::Easing easing) : file_(std::move(file)), easing_(easing) {}

  void set_easing(document::Easing easing) { easing_ = easing; }

  void add(double frame, pose::Pose pose) {
    const double whole = std::round(frame);
    if (!(whole >= document::Timeline::least_frame && whole <= document::Timeline::largest_frame))
      throw base::Error(file_, "a frame number is below -1,000,000 or above 1,000,000",
                        "export a shorter range");
    const int number = static_cast<int>(whole);
    if (!keys_.empty() && number <= keys_.back().frame) {
      ++skipped_;
      return;
    }
    check_places(file_ + ": frame " + std::to_string(number), pose.positions);
    keys_.push_back({number, shared(std::move(pose)), easing_});
  }

  ImportedKeys take(std::vector<std::string> warnings, double rate) {
    if (skipped_ > 0)
      warnings.push_back(file_ + ": skipped " + base::counted(skipped_, "key") +
                         " because another key has the same frame at " + base::few_digits(rate) +
                         " frames per second; choose a higher rate before importing");
    return {std::move(keys_), std::move(warnings), {file_}};
  }

private:
  std::string file_;
  document::Easing easing_;
  std::vector<document::PoseKey> keys_;
  std::size_t skipped_ = 0;
};

ImportedKeys keys_of_files(const base::NumberedName& name, const pose::Cage& cage, base::Progress* progress) {
  const auto files = files_of(name);
  check_key_count(name.pattern(), files.size());
  KeyBuilder keys(name.pattern(), document::Easing::smooth);
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < files.size(); ++i) {
    report_part(progress, i, files.size());
    keys.add(static_cast<double>(files[i].number), pose::read_pose(files[i].path, cage, warnings));
  }
  ImportedKeys read = keys.take(std::move(warnings), 0);
  read.files.clear();
  for (const base::NumberedFile& file : files) read.files.push_back(file.path);
  return read;
}

ImportedKeys keys_of_cache(const fs::path& file, const pose::Cage& cage, const ImportTimes& times,
                           base::Progress* progress) {
  const formats::PointCache cache(file);
  const formats::PointCacheHead& head = cache.head();
  check_points(file.string(), head.points, {cage.surface, "the cage"});
  check_key_count(file.string(), head.frames);
  base::require_memory({24.0 * static_cast<double>(head.frames) * static_cast<double>(head.points),
                        base::counted(head.frames, "key") + " of the cage take", "export fewer frames",
                        file.string()});
  KeyBuilder keys(file.string(), document::Easing::constant_speed);
  for (std::size_t i = 0; i < head.frames; ++i) {
    report_part(progress, i, head.frames);
    const bool has_times = head.format == formats::PointCacheFormat::mdd;
    const double frame = has_times ? times.first + double(head.seconds[i]) * times.rate
                                   : double(head.start) + static_cast<double>(i) * double(head.rate);
    keys.add(frame, {cache.frame(i), {}});
  }
  return keys.take(cache.warnings(), times.rate);
}

ImportedKeys keys_of_gltf(const fs::path& file, const pose::Cage& cage, const ImportTimes& times,
                          base::Progress* progress) {
  std::vector<std::string> warnings;
  const MorphPositions found = morphs_of(file, {cage.surface, "the cage"}, warnings);
  const auto& clip = found.clip;
  if (!clip || clip->seconds().empty())
    throw base::Error(
        file.string(), clip ? "the morph targets are not animated" : "the file has no morph targets",
        clip ? "import it as poses" : "export the cage with animated morph targets (shape keys)");
  const auto& seconds = clip->seconds();
  check_key_count(file.string(), seconds.size());
  KeyBuilder keys(file.string(), document::Easing::constant_speed);
  const auto frame_of = [&](std::size_t key) { return std::round(times.first + seconds[key] * times.rate); };
  double sampled = 0;  // number of frames between keys
  for (std::size_t i = 0; i + 1 < seconds.size(); ++i)
    if (clip->curves()[i] == formats::MorphCurve::other) sampled += frame_of(i + 1) - frame_of(i);
  if (!(sampled < document::Timeline::most_keys))
    check_key_count(file.string(), document::Timeline::most_keys + 1);
  check_key_count(file.string(), seconds.size() + static_cast<std::size_t>(sampled));
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    report_part(progress, i, seconds.size());
    const auto curve = i + 1 < seconds.size() ? clip->curves()[i] : formats::MorphCurve::linear;
    keys.set_easing(curve == formats::MorphCurve::held ? document::Easing::hold
                                                       : document::Easing::constant_speed);
    keys.add(times.first + seconds[i] * times.rate, {found.at(seconds[i]), {}});
    if (curve != formats::MorphCurve::other) continue;
    for (double frame = frame_of(i) + 1; frame < frame_of(i + 1); ++frame)
      keys.add(frame, {found.at((frame - times.first) / times.rate), {}});
  }
  return keys.take(std::move(warnings), times.rate);
}

}  // namespace

ImportedPoses read_poses(std::span<const fs::path> files, const pose::Cage& cage, base::Progress* progress) {
  ImportedPoses all;
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::error_code ignored;
    if (fs::is_directory(files[i], ignored)) {
      read_folder(
          files[i], "a pose of this cage",
          "choose a folder with posed versions of the cage (same vertices, same order)",
          [&](const fs::path& file) {
            add_poses_of(file, cage, all);
            return true;
          },
          all.warnings, progress);
    } else {
      report_part(progress, i, files.size());
      add_poses_of(files[i], cage, all);
    }
  }
  if (all.poses.size() > document::PoseLibrary::most_poses)
    throw base::Error(files.front().string(),
                      "there are " + base::counted(all.poses.size(), "pose") + ", and a document can have " +
                          base::with_thousands(document::PoseLibrary::most_poses),
                      "choose fewer poses");
  return all;
}

ImportedKeys read_keys(const fs::path& file, const pose::Cage& cage, const ImportTimes& times,
                       base::Progress* progress) {
  if (base::NumberedName::is_pattern(file)) return keys_of_files(base::NumberedName(file), cage, progress);
  if (formats::point_cache_format(file)) return keys_of_cache(file, cage, times, progress);
  const auto sequence = base::NumberedName::of_file(file);
  const bool alone = !sequence || sequence->find().size() < 2;
  if (formats::is_a(formats::holds_morphs, file) && alone) return keys_of_gltf(file, cage, times, progress);
  if (!sequence)
    throw base::Error(file.string(), "the file name has no frame number",
                      "choose a numbered posed cage (pose_0001.obj), a point cache or a glTF file");
  return keys_of_files(*sequence, cage, progress);
}

void put_keys(document::Document& document, std::vector<document::PoseKey> keys, const std::string& label) {
  document::Timeline timeline = document.timeline();
  timeline.keys = std::move(keys);
  timeline.first = timeline.keys.front().frame;
  timeline.last = std::max(timeline.first + 1, timeline.keys.back().frame);
  put_timeline(document, std::move(timeline), label);
}

}  // namespace viete::files
