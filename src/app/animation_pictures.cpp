#include "app/animation_pictures.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>
#include <utility>

#include "base/atomic_file.h"
#include "base/checksum.h"
#include "base/child_program.h"
#include "base/error.h"
#include "base/made_files.h"
#include "mesh/formats/source.h"
#include "scene/document/pose_edit.h"
#include "scene/files/animation_export.h"
#include "scene/files/session.h"
#include "scene/workspace/playing.h"
#include "scene/workspace/saving.h"

namespace viete::app {

namespace fs = std::filesystem;
using Planned = base::MadeFiles::Planned;

namespace {

struct VideoFormat {
  std::string_view extension, container;
  std::vector<std::string> coding;
};

// Every player takes 4:2:0, which needs even sizes.
const std::vector<VideoFormat>& video_formats() {
  const std::string even = "pad=ceil(iw/2)*2:ceil(ih/2)*2";
  static const std::vector<VideoFormat> all = {
      {"mp4",
       "mp4",
       {"-vf", even, "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart"}},
      {"webm", "webm", {"-vf", even, "-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-pix_fmt", "yuv420p"}},
      {"mkv", "matroska", {"-vf", even, "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p"}},
      {"gif",
       "gif",
       {"-filter_complex", "[0:v]split[a][b];[a]palettegen[p];[b][p]paletteuse", "-loop", "0"}}};
  return all;
}

std::string plain(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

// Shows one frame after another.
class FrameViewer {
public:
  FrameViewer(OffscreenViewer& offscreen, const PictureRun& run)
      : offscreen_(offscreen), run_(run), start_(workspace().camera.pose()) {}

  scene::Workspace& workspace() { return offscreen_.viewer().workspace(); }

  // Pose and camera of the picture with this number among all.
  void go_to(std::size_t picture) {
    workspace().camera.set_pose(start_);
    if (!workspace().document.timeline.empty()) scene::go_to_frame(workspace(), run_.frames[picture]);
    if (!run_.turntable) return;
    scene::CameraPose camera = workspace().camera.pose();
    const double share = static_cast<double>(picture) / static_cast<double>(run_.frames.size());
    camera.yaw += static_cast<float>(2 * std::numbers::pi * share);
    workspace().camera.set_pose(camera);
  }

  // Panels and errors come some frames after what they tell of.
  render::Image picture() {
    const scene::ViewOptions& view = workspace().view;
    if (view.panels || view.field != lab::Field::none) {
      offscreen_.settle();
    } else {
      offscreen_.viewer().frame(0);
    }
    return offscreen_.viewer().picture();
  }

private:
  OffscreenViewer& offscreen_;
  const PictureRun& run_;
  scene::CameraPose start_;
};

// All that the pictures are made from but pose and camera.
std::uint64_t common_key(scene::Workspace& w, glm::ivec2 size) {
  scene::Session session = scene::session_of(w);
  session.timeline = {};
  session.library = {};
  session.pose.reset();
  session.camera.reset();
  session.frame = 1;
  session.origin.clear();
  session.origin_content.reset();
  for (auto& probe : session.probes.all) probe.pose = probe.locked ? probe.pose : scene::ProbePose{};
  constexpr bool portable = false;
  const std::string text = scene::session_text(session, "/", portable) + w.about.version + w.about.renderer +
                           std::to_string(size.x) + ' ' + std::to_string(size.y);
  base::Checksum sum;
  sum.add(text.data(), text.size());
  const std::uint64_t content = scene::content_key(scene::export_of(w.document, ""));
  sum.add(&content, sizeof content);
  return sum.value();
}

std::uint64_t picture_key(std::uint64_t common, const scene::Workspace& w) {
  const scene::CameraPose& camera = w.camera.pose();
  const std::array numbers{camera.target.x,
                           camera.target.y,
                           camera.target.z,
                           camera.distance,
                           camera.yaw,
                           camera.pitch,
                           camera.orthographic ? 1.0f : 0.0f,
                           camera.up == scene::UpAxis::z ? 1.0f : 0.0f};
  base::Checksum sum;
  sum.add(numbers.data(), sizeof numbers);
  const std::uint64_t pose = scene::pose_key(common, scene::whole_pose(w.document));
  sum.add(&pose, sizeof pose);
  return sum.value();
}

void report_pictures(base::Progress& progress, std::size_t done, std::size_t of) {
  progress.report(static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(of, 1)));
}

PicturesReport write_png_files(FrameViewer& viewer, const PictureRun& run, glm::ivec2 size,
                               base::Progress& progress) {
  const base::NumberedName name(run.file);
  base::MadeFiles made(name);
  const std::uint64_t common = common_key(viewer.workspace(), size);
  std::vector<Planned> all;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    viewer.go_to(i);
    all.push_back({run.frames[i], picture_key(common, viewer.workspace())});
  }
  const auto missing = scene::files_to_make(made, name, all, run.force);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    report_pictures(progress, i, missing.size());
    const auto at = std::ranges::find(run.frames, missing[i].number);
    viewer.go_to(static_cast<std::size_t>(at - run.frames.begin()));
    render::write_png(name.file(missing[i].number), viewer.picture());
    made.add(missing[i]);
  }
  report_pictures(progress, 1, 1);
  return {all.size() - missing.size(), scene::other_files_note(name, all)};
}

void write_video(FrameViewer& viewer, const PictureRun& run, glm::ivec2 size, base::Progress& progress) {
  base::FileOfProgram file(run.file);
  const std::string extension = mesh::extension_of(run.file);
  base::ChildProgram ffmpeg(ffmpeg_words(extension, size.x, size.y, run.rate / run.step, file.part()),
                            "install it (apt-get install ffmpeg), or write numbered pictures: " +
                                run.file.stem().string() + "_####.png");
  std::size_t done = 0;
  const auto waiting = [&] { report_pictures(progress, done, run.frames.size()); };
  for (; done < run.frames.size(); ++done) {
    viewer.go_to(done);
    ffmpeg.write(viewer.picture().rgba, waiting);
  }
  ffmpeg.finish(waiting);
  report_pictures(progress, 1, 1);
  file.replace();
}

}  // namespace

std::vector<std::string> ffmpeg_words(const std::string& extension, int width, int height, double rate,
                                      const fs::path& to) {
  const auto format = std::ranges::find(video_formats(), extension, &VideoFormat::extension);
  std::vector<std::string> words{"ffmpeg",      "-y",
                                 "-loglevel",   "error",
                                 "-f",          "rawvideo",
                                 "-pix_fmt",    "rgba",
                                 "-video_size", std::to_string(width) + "x" + std::to_string(height),
                                 "-framerate",  plain(rate),
                                 "-i",          "pipe:0"};
  words.insert(words.end(), format->coding.begin(), format->coding.end());
  words.insert(words.end(), {"-f", std::string(format->container), "file:" + fs::absolute(to).string()});
  return words;
}

PicturesReport write_pictures(OffscreenViewer& offscreen, const PictureRun& run, base::Progress& progress) {
  const glm::ivec2 size = offscreen.viewer().device_size();
  const bool video = scene::is_video_format(mesh::extension_of(run.file));
  offscreen.settle();
  FrameViewer viewer(offscreen, run);
  if (!video) return write_png_files(viewer, run, size, progress);
  write_video(viewer, run, size, progress);
  return {};
}

}  // namespace viete::app
