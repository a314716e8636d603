// The subcommands of `viete`: each adds its options to the command line and returns an exit code.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace viete::app {

/// Documented in --help.
enum ExitCode : int {
  exit_ok = 0,
  exit_failed = 1,  ///< reading, writing or the work failed; the reason is on stderr
  exit_usage = 2,   ///< invalid command line
};

/// The action main() runs after parsing: set by the chosen subcommand.
using Action = std::function<int()>;

void add_view_command(CLI::App& app, Action& action);
void add_render_command(CLI::App& app, Action& action);
void add_deform_command(CLI::App& app, Action& action);
void add_animate_command(CLI::App& app, Action& action);
void add_between_command(CLI::App& app, Action& action);
void add_pose_command(CLI::App& app, Action& action);
void add_mix_command(CLI::App& app, Action& action);
void add_cage_command(CLI::App& app, Action& action);
void add_manual_command(CLI::App& app, Action& action);
void add_info_command(CLI::App& app, Action& action);

}  // namespace viete::app
