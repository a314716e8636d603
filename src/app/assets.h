// Finds the files installed with the program. Describes the build of the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viete::app {

struct BundledModel {
  std::filesystem::path model, cage;
  std::vector<std::filesystem::path> poses;  ///< poses of the cage, sorted by name
  std::filesystem::path loop;                ///< a session with this model and cage, poses and keys
};
/// Searches these folders: $VIETE_ASSETS, ../share/viete and share/viete relative to the program, and the
/// assets of the source tree from which the program was built. Throws base::Error if the model is not found.
BundledModel bundled_model();

std::filesystem::path program_folder();

/// Returns the manual's page of a chapter such as "cages". If `chapter` is empty, returns the first page.
/// Throws base::Error if the pages were not built or the chapter does not exist.
std::filesystem::path manual_page(const std::string& chapter);

/// For example "0.2.0".
const char* version();
/// Build type and compiler, for example "Release, GNU 12.2.0".
const char* build_type();

}  // namespace viete::app
