// The viewer in a window.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/options.h"

namespace viete::app {

struct WindowOptions {
  std::filesystem::path model, cage, pose;  ///< model may be a session
  std::filesystem::path binding;            ///< saved, of this model and cage; empty: none
  sym3::Method method = sym3::Method::fast;
  SchemeOptions scheme;
  float scale = 0;  ///< device pixels per logical pixel; 0 asks the display
  int frames = 0;   ///< stop after so many frames; 0 never
};

/// What a model that is opened into this empty document starts with; a session has its own. Throws
/// base::Error if the options contradict each other.
void set_settings(scene::Document& document, const WindowOptions& options);

/// Runs until the window is closed. Returns false, saying why in `reason`, if no window can be opened (no
/// display, no OpenGL 3.3).
bool run_window(const WindowOptions& options, std::string& reason);

}  // namespace viete::app
