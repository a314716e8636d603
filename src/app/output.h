// The files that a command writes: what they may replace.
#pragma once

#include <filesystem>

#include "scene/files/output.h"

namespace viete::app {

using scene::check_output, scene::Content, scene::FilesInUse;

/// What a command writes.
struct Output {
  std::filesystem::path file;
  Content content;
  bool force = false;
};

}  // namespace viete::app
