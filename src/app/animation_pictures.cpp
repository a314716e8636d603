#include "app/animation_pictures.h"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <utility>

#include "base/numbered_files.h"
#include "scene/files/animation_export.h"
#include "scene/workspace/playing.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

// Quotes a word for the shell.
std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

std::string plain(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

// Renders successive frames.
class FrameViewer {
public:
  FrameViewer(OffscreenViewer& offscreen, const PictureRun& run)
      : offscreen_(offscreen), run_(run), start_(workspace().camera.pose()) {}

  scene::Workspace& workspace() { return offscreen_.viewer().workspace(); }

  // Sets pose and camera of the picture with this index.
  void go_to(std::size_t picture) {
    workspace().camera.set_pose(start_);
    if (!workspace().document.timeline.empty()) scene::go_to_frame(workspace(), run_.frames[picture]);
    if (!run_.turntable) return;
    scene::CameraPose camera = workspace().camera.pose();
    const double share = static_cast<double>(picture) / static_cast<double>(run_.frames.size());
    camera.yaw += static_cast<float>(2 * std::numbers::pi * share);
    workspace().camera.set_pose(camera);
  }

  // Waits for panels and error maps, which take several frames to become current.
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

}  // namespace

std::string ffmpeg_command(const PictureRun& run) {
  const std::string pattern = base::NumberedName(fs::absolute(run.file)).pattern();
  const std::size_t first = pattern.rfind('/') + 1, begin = pattern.find('#', first),
                    end = pattern.find_last_of('#') + 1;
  std::string film = pattern.substr(0, begin), pictures;
  film.resize(std::max(film.find_last_not_of("_-. ") + 1, first));
  if (film.size() == first) film += "film";
  for (const char c : pattern) pictures += c == '%' ? "%%" : std::string(1, c);
  const auto place = pictures.rfind(pattern.substr(begin, end - begin));
  const std::string digits = "%0" + std::to_string(end - begin);
  const bool gaps = run.step != 1 || run.frames.front() < 0;  // numbering that ffmpeg does not support
  pictures.replace(place, end - begin, digits + (gaps ? ".0f" : "d"));
  const std::string rate = " -framerate " + plain(run.rate / run.step),
                    number = std::to_string(run.frames.front());
  const std::string input =
      gaps ? "seq -f " + shell_word(pictures) + ' ' + number + ' ' + std::to_string(run.step) + ' ' +
                 std::to_string(run.frames.back()) + " | tr '\\n' '\\0' | xargs -0 cat | ffmpeg" + rate +
                 " -f image2pipe -i -"
           : "ffmpeg" + rate + " -start_number " + number + " -i " + shell_word(pictures);
  // 4:2:0 plays everywhere, but needs even sizes.
  return input + " -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p " + shell_word(film + ".mp4");
}

std::vector<std::string> write_pictures(OffscreenViewer& offscreen, const PictureRun& run,
                                        base::Progress& progress) {
  const base::NumberedName name(run.file);
  scene::check_frames_are_new(name, run.frames, run.force);
  offscreen.settle();
  FrameViewer viewer(offscreen, run);
  const auto count = static_cast<double>(run.frames.size());
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    progress.report(static_cast<double>(i) / count);
    viewer.go_to(i);
    render::write_png(name.file(run.frames[i]), viewer.picture());
  }
  progress.report(1);
  std::vector<std::string> notes = scene::other_files_note(name, run.frames);
  notes.push_back(ffmpeg_command(run));
  return notes;
}

}  // namespace viete::app
