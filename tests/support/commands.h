// Commands by name, as a key or a button runs them.
#pragma once

#include <doctest/doctest.h>

#include "scene/workspace/command.h"

namespace viete::test {

/// Runs the command if it is enabled; returns whether it was.
inline bool run_command(scene::Workspace& workspace, std::string_view name) {
  const scene::Command* command = scene::find_command(name);
  REQUIRE_MESSAGE(command, name);
  if (!command->enabled(workspace)) return false;
  command->run(workspace);
  return true;
}

}  // namespace viete::test
