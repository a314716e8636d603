#include "app/animation_pictures.h"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <utility>

#include "base/atomic_file.h"
#include "base/child_program.h"
#include "base/error.h"
#include "base/numbered_files.h"
#include "mesh/formats/source.h"
#include "scene/files/animation_export.h"
#include "scene/workspace/playing.h"

namespace viete::app {

namespace fs = std::filesystem;

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

void report_pictures(base::Progress& progress, std::size_t done, std::size_t of) {
  progress.report(static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(of, 1)));
}

std::vector<std::string> write_png_files(FrameViewer& viewer, const PictureRun& run,
                                         base::Progress& progress) {
  const base::NumberedName name(run.file);
  scene::check_frames_are_new(name, run.frames, run.force);
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    report_pictures(progress, i, run.frames.size());
    viewer.go_to(i);
    render::write_png(name.file(run.frames[i]), viewer.picture());
  }
  report_pictures(progress, 1, 1);
  return scene::other_files_note(name, run.frames);
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

std::vector<std::string> write_pictures(OffscreenViewer& offscreen, const PictureRun& run,
                                        base::Progress& progress) {
  const glm::ivec2 size = offscreen.viewer().device_size();
  const bool video = scene::is_video_format(mesh::extension_of(run.file));
  offscreen.settle();
  FrameViewer viewer(offscreen, run);
  if (!video) return write_png_files(viewer, run, progress);
  write_video(viewer, run, size, progress);
  return {};
}

}  // namespace viete::app
