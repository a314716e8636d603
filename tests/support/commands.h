// Runs commands by name, as a key or a button does.
#pragma once

#include <doctest/doctest.h>

#include "workspace/command.h"

namespace viete::test {

/// Returns false, without running the command, if it is disabled.
inline bool run_command(workspace::Workspace& workspace, std::string_view name) {
  const workspace::Command* command = workspace::find_command(name);
  REQUIRE_MESSAGE(command, name);
  if (!command->enabled(workspace)) return false;
  command->run(workspace);
  return true;
}

}  // namespace viete::test
