// The viewer in a window.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/inputs.h"

namespace viete::app {

struct WindowOptions {
  Inputs inputs{Use::window};
  float scale = 0;                   ///< device pixels per logical pixel; 0: the display's scale
  int frames = 0;                    ///< stop after so many frames; 0: never
  std::filesystem::path first_pose;  ///< target of the motion at the first start; empty: none
};

/// Runs until the window is closed. Returns false with the `reason` if no window can be opened (no display,
/// no OpenGL 3.3).
bool run_window(const WindowOptions& options, std::string& reason);

}  // namespace viete::app
