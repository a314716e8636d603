// Runs commands by name, as keys and buttons do.
#pragma once

#include <doctest/doctest.h>

#include "workspace/command.h"

namespace viete::test {

/// Runs the command. If it is disabled, does not run it and returns false.
inline bool run_command(workspace::Workspace& workspace, std::string_view name) {
  const workspace::Command* command = workspace::find_command(name);
  REQUIRE_MESSAGE(command, name);
  if (!command->enabled(workspace)) return false;
  command->run(workspace);
  return true;
}

}  // namespace viete::test
