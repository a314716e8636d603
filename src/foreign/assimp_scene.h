// Reads a foreign file with Assimp, for the program viete-import.
#pragma once

#include <filesystem>

#include "foreign/scene.h"

namespace viete::foreign {

/// Prints the progress to the standard error. If the file cannot be read, throws an exception with the
/// reason.
Scene scene_by_assimp(const std::filesystem::path& file);

}  // namespace viete::foreign
