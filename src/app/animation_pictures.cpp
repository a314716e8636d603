#include "app/animation_pictures.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

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
  pictures.replace(place, end - begin, digits + "d");
  // 4:2:0 plays everywhere, but needs even sizes.
  return "ffmpeg -framerate " + plain(run.rate) + " -start_number " + std::to_string(run.frames.front()) +
         " -i " + shell_word(pictures) + " -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p " +
         shell_word(film + ".mp4");
}

std::vector<std::string> write_pictures(OffscreenViewer& offscreen, const PictureRun& run,
                                        base::Progress& progress) {
  const base::NumberedName name(run.file);
  scene::check_frames_are_new(name, run.frames, run.force);
  offscreen.settle();
  Viewer& viewer = offscreen.viewer();
  scene::Workspace& w = viewer.workspace();
  const scene::CameraPose start = w.camera.pose();
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(run.frames.size());
    progress.report(share);
    w.camera.set_pose(start);
    if (!w.document.timeline.empty()) scene::go_to_frame(w, run.frames[i]);
    if (run.turntable) {
      scene::CameraPose camera = w.camera.pose();
      camera.yaw += static_cast<float>(2 * std::numbers::pi * share);
      w.camera.set_pose(camera);
    }
    // Panels and maps take several frames to become current.
    if (w.view.panels || w.view.field != lab::Field::none)
      offscreen.settle();
    else
      viewer.frame(0);
    render::write_png(name.file(run.frames[i]), viewer.picture());
  }
  progress.report(1);
  std::vector<std::string> notes = scene::other_files_note(name, run.frames);
  const bool has_gaps = run.step != 1 || run.frames.front() < 0;  // not supported by ffmpeg
  if (!has_gaps) notes.push_back(ffmpeg_command(run));
  return notes;
}

}  // namespace viete::app
