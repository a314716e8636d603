// Commands by name, as a key or a button runs them.
#pragma once

#include <doctest/doctest.h>

#include "workspace/command.h"

namespace viete::test {

/// Runs the command if it is enabled; returns whether it was.
inline bool run_command(workspace::Workspace& workspace, std::string_view name) {
  const workspace::Command* command = workspace::find_command(name);
  REQUIRE_MESSAGE(command, name);
  if (!command->enabled(workspace)) return false;
  command->run(workspace);
  return true;
}

}  // namespace viete::test
