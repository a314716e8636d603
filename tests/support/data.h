// Folders of the checkout. Optional real meshes are in ../shared/data.
#pragma once

#include <filesystem>
#include <string>

#include "support/skip.h"

namespace viete::test {

std::filesystem::path source_dir();
std::filesystem::path build_dir();

inline std::filesystem::path assets_dir() {
  return source_dir() / "assets";
}

/// Returns the folder of real meshes. Without this folder, skips the test case and returns an empty path.
inline std::filesystem::path shared_data(const std::string& below = "") {
  for (auto base : {source_dir().parent_path() / "shared" / "data", source_dir() / "shared" / "data"})
    if (std::filesystem::exists(base / below)) return base / below;
  skip("../shared/data/" + below + " does not exist");
  return {};
}

}  // namespace viete::test
