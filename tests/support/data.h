// Real meshes beside the checkout (../shared/data), used where they are present; a clone alone has none.
#pragma once

#include <filesystem>
#include <string>

#include "support/skip.h"

namespace viete::test {

/// Of this checkout, and of the build that the test belongs to.
std::filesystem::path source_dir();
std::filesystem::path build_dir();

inline std::filesystem::path assets_dir() {
  return source_dir() / "assets";
}

/// The folder of real meshes, or an empty path: then the case is skipped.
inline std::filesystem::path shared_data(const std::string& below = "") {
  for (auto base : {source_dir().parent_path() / "shared" / "data", source_dir() / "shared" / "data"}) {
    if (std::filesystem::exists(base / below)) return base / below;
  }
  skip("../shared/data/" + below + " is not here");
  return {};
}

}  // namespace viete::test
