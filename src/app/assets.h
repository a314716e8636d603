// Locates the bundled model, for a program run from a build, an install or elsewhere.
#pragma once

#include <filesystem>
#include <vector>

namespace viete::app {

/// The assets folder: $VIETE_ASSETS, else next to the program (../share/viete), else the source tree it was
/// built from. Throws base::Error naming the searched folders if none exists.
std::filesystem::path assets_folder();

struct BundledModel {
  std::filesystem::path model, cage;
  std::vector<std::filesystem::path> poses;  ///< poses of the cage, sorted by name
  std::filesystem::path loop;                ///< a session of both with poses and keys
};
BundledModel bundled_model();

/// The folder of the running program.
std::filesystem::path program_folder();

}  // namespace viete::app
