#include "app/manual.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "app/assets.h"
#include "app/child_process.h"
#include "app/command_line.h"
#include "app/help.h"
#include "app/options.h"
#include "base/error.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

fs::path manual_folder() {
  std::error_code ignored;
  const fs::path program = program_folder();
  for (const fs::path& folder : {program / "manual", program / ".." / "share" / "viete" / "manual"})
    if (fs::exists(folder / "index.html", ignored)) return fs::weakly_canonical(folder);
  throw base::Error("the manual", "its pages are not built",
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

// viete manual [CHAPTER]: opens the manual in the browser.

namespace {

bool has_display() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
    const char* const value = std::getenv(name);
    if (value && *value) return true;
  }
  return false;
}

int show_manual(const std::string& chapter) {
  const std::filesystem::path page = manual_page(chapter);
  std::printf("%s\n", page.c_str());
  if (has_display()) open_in_browser(page);
  return exit_ok;
}

}  // namespace

void add_manual_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("manual", "Open the manual in the browser");
  auto chapter = std::make_shared<std::string>();
  command->add_option("CHAPTER", *chapter, "Chapter, for example cages, blending or python")
      ->default_str("the first page");
  add_examples(*command, {"manual", "manual cages"});
  command->callback([chapter, &action] { action = [chapter] { return show_manual(*chapter); }; });
}

}  // namespace viete::app
