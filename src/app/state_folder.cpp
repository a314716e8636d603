#include "app/state_folder.h"

#include <cstdlib>

namespace viete::app {

namespace fs = std::filesystem;

namespace {

fs::path absolute_path_in(const char* variable) {
  const char* value = std::getenv(variable);
  const fs::path path = value ? value : "";
  return path.is_absolute() ? path : fs::path();
}

// Ours, in the folder that the variable names or else in that one of the home folder.
fs::path own_folder(const char* variable, const fs::path& of_home) {
  if (const fs::path folder = absolute_path_in(variable); !folder.empty()) return folder / "viete";
  if (const fs::path home = absolute_path_in("HOME"); !home.empty()) return home / of_home / "viete";
  return {};
}

}  // namespace

fs::path state_folder() {
  return own_folder("XDG_STATE_HOME", ".local/state");
}

}  // namespace viete::app
