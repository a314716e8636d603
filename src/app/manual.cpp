// viete manual [CHAPTER]: opens the manual in the browser.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "app/assets.h"
#include "app/child_process.h"
#include "app/command_line.h"
#include "app/options.h"

namespace viete::app {

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
