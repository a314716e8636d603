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

fs::path assets_folder() {
  std::vector<fs::path> places;
  if (std::string named = base::os::variable("VIETE_ASSETS"); !named.empty()) places.emplace_back(named);
  for (const char* prefix : {"..", "."}) places.push_back(program_folder() / prefix / "share" / "viete");
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
  const fs::path program = program_folder();
  for (const fs::path& folder : {program / "manual", program / ".." / "share" / "viete" / "manual",
                                 program / "share" / "viete" / "manual"})
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
