// Renders the frames of a timeline to numbered PNG files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/offscreen_viewer.h"
#include "base/progress.h"

namespace viete::app {

struct PictureRun {
  std::filesystem::path file;  ///< frame_####.png
  std::vector<int> frames;
  double rate = 24;                         ///< timeline frames per second
  int step = 1;                             ///< timeline frames between pictures
  bool turntable = false;                   ///< a full camera turn from the first picture to the last
  scene::Force force = scene::Force::none;  ///< replace existing pictures
};

/// Renders the viewer's document, following its timeline and camera keys. Each file is written completely or
/// not at all. Returns notes for the user, one line each: the last one is ffmpeg_command(), if the
/// numbers have no gaps. Throws
/// base::Error and base::Cancelled.
std::vector<std::string> write_pictures(OffscreenViewer& offscreen, const PictureRun& run,
                                        base::Progress& progress);

/// The shell command that converts the pictures to a film at the timeline's rate, one line.
/// The numbers must not have gaps.
std::string ffmpeg_command(const PictureRun& run);

}  // namespace viete::app
