// Pictures of the frames of a timeline: numbered PNG files, or a video made by ffmpeg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/offscreen_viewer.h"
#include "base/progress.h"

namespace viete::app {

struct PictureRun {
  std::filesystem::path file;  ///< frame_####.png, or a video
  std::vector<int> frames;
  double rate = 24;                         ///< frames of the timeline a second
  int step = 1;                             ///< frames of it from one picture to the next
  bool turntable = false;                   ///< once round the model, from the first picture to the last
  scene::Force force = scene::Force::none;  ///< replace pictures that are there
};

/// Writes pictures or a film of the viewer's document, following its timeline and camera keys. Every file is
/// written as a whole or not at all. Returns notes for the user, one line each. Throws base::Error, also where
/// ffmpeg is not installed, and base::Cancelled.
std::vector<std::string> write_pictures(OffscreenViewer& offscreen, const PictureRun& run,
                                        base::Progress& progress);

/// The words that run ffmpeg for a video of pictures of that size, four bytes a pixel, which it reads.
std::vector<std::string> ffmpeg_words(const std::string& extension, int width, int height, double rate,
                                      const std::filesystem::path& to);

}  // namespace viete::app
