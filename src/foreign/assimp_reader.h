// Reads a file with Assimp. Only the program viete-import links this.
#pragma once

#include <filesystem>
#include <functional>

#include "foreign/scene.h"

namespace viete::foreign {

/// Reads only files in the folder of `file` and below. Reports the finished fraction, 0 to 1. If the file
/// cannot be read, the scene has a failure.
Scene read_with_assimp(const std::filesystem::path& file, const std::function<void(double)>& report);

}  // namespace viete::foreign
