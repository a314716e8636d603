#include "app/assets.h"

#include <algorithm>

#include "base/error.h"
#include "base/os.h"
#include "base/text.h"

namespace viete::app {

namespace fs = std::filesystem;

fs::path program_folder() {
  return base::os::program_file().parent_path();
}

namespace {

// Beside the program in a portable folder, otherwise beside the program's folder bin.
std::vector<fs::path> shared_folders() {
  return {program_folder() / ".." / "share" / "viete", program_folder() / "share" / "viete"};
}

fs::path assets_folder() {
  std::vector<fs::path> places;
  if (std::string named = base::os::variable("VIETE_ASSETS"); !named.empty()) places.emplace_back(named);
  for (auto& folder : shared_folders()) places.push_back(std::move(folder));
  places.emplace_back(VIETE_SOURCE_ASSETS);
  std::vector<std::string> looked;
  for (const auto& place : places) {
    std::error_code ignored;
    if (fs::exists(place / "dragon" / "dragon.ply", ignored)) return fs::weakly_canonical(place);
    looked.push_back(place.string());
  }
  throw base::Error("dragon/dragon.ply", "the bundled model was not found in " + base::joined(looked),
                    "set VIETE_ASSETS to the folder that contains dragon/, or open another model");
}

fs::path manual_folder() {
  std::error_code ignored;
  std::vector<fs::path> places = shared_folders();
  for (fs::path& place : places) place /= "manual";
  places.insert(places.begin(), program_folder() / "manual");
  for (const fs::path& folder : places)
    if (fs::exists(folder / "index.html", ignored)) return fs::weakly_canonical(folder);
  throw base::Error("the manual", "its pages have not been built",
                    "read assets/manual/README.md in the sources, or install cmark-gfm and build again");
}

std::string chapters_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".html" && name != "index") names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return base::joined(names);
}

}  // namespace

BundledModel bundled_model() {
  const fs::path folder = assets_folder() / "dragon";
  BundledModel bundled{folder / "dragon.ply", folder / "cage.obj", {}, folder / "loop.viete"};
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with("pose_")) bundled.poses.push_back(entry.path());
  std::sort(bundled.poses.begin(), bundled.poses.end());
  return bundled;
}

fs::path manual_page(const std::string& chapter) {
  const fs::path folder = manual_folder(), page = folder / ((chapter.empty() ? "index" : chapter) + ".html");
  std::error_code ignored;
  const bool is_name = chapter.find('/') == chapter.npos;
  if (is_name && fs::exists(page, ignored)) return page;
  throw base::Error("the manual", "it has no chapter " + chapter, "choose one of " + chapters_in(folder));
}

const char* version() {
  return VIETE_VERSION;
}

const char* build_type() {
  return VIETE_BUILD_TYPE;
}

}  // namespace viete::app
