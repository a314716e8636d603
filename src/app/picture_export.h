// Pictures of an animation, for the window: this program draws them, run once more without one, so
// that the view stays live.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/progress.h"
#include "scene/files/session.h"

namespace viete::app {

struct PictureExport {
  std::filesystem::path file;     ///< frame_####.png
  std::filesystem::path program;  ///< `viete`
  scene::Session session;         ///< as it is at one moment: what plays, as it is looked at
  bool panels = false;
};

/// Throws base::Error with what the other run says, and base::Cancelled. Returns what a person should know of
/// the result, one line each. Thread-safe.
std::vector<std::string> write_pictures_aside(const PictureExport& what, base::Progress& progress);

}  // namespace viete::app
