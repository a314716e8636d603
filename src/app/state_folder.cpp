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

}  // namespace

fs::path state_folder() {
  if (const fs::path state = absolute_path_in("XDG_STATE_HOME"); !state.empty()) return state / "viete";
  if (const fs::path home = absolute_path_in("HOME"); !home.empty())
    return home / ".local" / "state" / "viete";
  return {};
}

}  // namespace viete::app
