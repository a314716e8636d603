#include "app/assets.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "app/build_facts.h"
#include "base/error.h"

namespace viete::app {

namespace fs = std::filesystem;

fs::path program_folder() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

fs::path assets_folder() {
  std::vector<fs::path> places;
  if (const char* named = std::getenv("VIETE_ASSETS")) places.emplace_back(named);
  places.push_back(program_folder() / ".." / "share" / "viete");
  places.emplace_back(source_assets());
  std::string looked;
  for (const auto& place : places) {
    std::error_code ignored;
    if (fs::exists(place / "dragon" / "dragon.ply", ignored)) return fs::weakly_canonical(place);
    looked += (looked.empty() ? "" : ", ") + place.string();
  }
  throw base::Error("dragon/dragon.ply", "the bundled model was not found in " + looked,
                    "set VIETE_ASSETS to the folder that contains dragon/, or open another model");
}

BundledModel bundled_model() {
  const fs::path folder = assets_folder() / "dragon";
  BundledModel bundled{folder / "dragon.ply", folder / "cage.obj", {}, folder / "loop.viete"};
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with("pose_")) bundled.poses.push_back(entry.path());
  }
  std::sort(bundled.poses.begin(), bundled.poses.end());
  return bundled;
}

}  // namespace viete::app
