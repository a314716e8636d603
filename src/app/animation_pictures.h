// Pictures of the frames of a timeline: numbered PNG files.
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
  double rate = 24;                         ///< frames of the timeline a second
  int step = 1;                             ///< frames of it from one picture to the next
  bool turntable = false;                   ///< once round the model, from the first picture to the last
  scene::Force force = scene::Force::none;  ///< replace pictures that are there
};

/// Writes pictures of the viewer's document, following its timeline and camera keys. Every file is written as
/// a whole or not at all. Returns notes for the user, one line each: the last one is ffmpeg_command(). Throws
/// base::Error and base::Cancelled.
std::vector<std::string> write_pictures(OffscreenViewer& offscreen, const PictureRun& run,
                                        base::Progress& progress);

/// The command that makes a film of the pictures, one line for a shell, at the rate that the timeline has.
std::string ffmpeg_command(const PictureRun& run);

}  // namespace viete::app
