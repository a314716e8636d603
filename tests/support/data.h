// Real meshes beside the checkout (../shared/data), used if present; a plain clone has none.
#pragma once

#include <filesystem>
#include <string>

#include "support/skip.h"

namespace viete::test {

/// Folders of this checkout and of the current build.
std::filesystem::path source_dir();
std::filesystem::path build_dir();

inline std::filesystem::path assets_dir() {
  return source_dir() / "assets";
}

/// The folder of real meshes, or an empty path; tests then skip the case.
inline std::filesystem::path shared_data(const std::string& below = "") {
  for (auto base : {source_dir().parent_path() / "shared" / "data", source_dir() / "shared" / "data"}) {
    if (std::filesystem::exists(base / below)) return base / below;
  }
  skip("../shared/data/" + below + " is not here");
  return {};
}

}  // namespace viete::test
