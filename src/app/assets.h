// Facts about this build, and its installed files, for a program run from a build, an install or elsewhere.
#pragma once

#include <filesystem>
#include <string>
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

/// The manual's page of chapter "cages", for example; empty: the first page. In the build or install folder.
/// Throws base::Error for an unknown chapter, listing the existing ones, or if the pages were not built.
std::filesystem::path manual_page(const std::string& chapter);

/// "0.2.0".
const char* version();
/// Build type and compiler: "Release, GNU 12.2.0".
const char* build_type();
/// The assets folder of the source tree it was built from.
const char* source_assets();

}  // namespace viete::app
