// Where the bundled model is, whether the program runs from a build, an install or anywhere else.
#pragma once

#include <filesystem>
#include <vector>

namespace viete::app {

/// The folder of assets: $VIETE_ASSETS, else beside the program (../share/viete), else the source tree it was
/// built from. Throws base::Error naming the places looked at when none is there.
std::filesystem::path assets_folder();

struct BundledModel {
  std::filesystem::path model, cage;
  std::vector<std::filesystem::path> poses;  ///< of the cage, by name
  std::filesystem::path loop;                ///< a session of both, with poses and keys
};
BundledModel bundled_model();

/// The folder of the running program.
std::filesystem::path program_folder();

}  // namespace viete::app
