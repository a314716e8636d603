#include "app/manual.h"

#include <algorithm>
#include <vector>

#include "app/assets.h"
#include "base/error.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

fs::path manual_folder() {
  std::error_code ignored;
  const fs::path program = program_folder();
  for (const fs::path& folder : {program / "manual", program / ".." / "share" / "viete" / "manual"})
    if (fs::exists(folder / "index.html", ignored)) return fs::weakly_canonical(folder);
  throw base::Error("the manual", "its pages were not made",
                    "read assets/manual/README.md in the sources, or install cmark-gfm and build again");
}

std::string chapters_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".html" && name != "index") names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

fs::path manual_page(const std::string& chapter) {
  const fs::path folder = manual_folder(), page = folder / ((chapter.empty() ? "index" : chapter) + ".html");
  std::error_code ignored;
  const bool is_name = chapter.find('/') == chapter.npos;
  if (is_name && fs::exists(page, ignored)) return page;
  throw base::Error("the manual", "there is no chapter " + chapter, "choose one of " + chapters_in(folder));
}

}  // namespace viete::app
