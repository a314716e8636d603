// The subcommands of `viete`, each of which adds its options to the command line and returns an exit code,
// and the common code of the main() of `viete` and `viete-bench`.
#pragma once

#include <functional>
#include <string>
#include <vector>

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

/// Descriptions of `viete bench` and `viete report`, used by both.
inline constexpr const char* bench_text = "Measure speed and accuracy on this machine";
inline constexpr const char* report_text = "Measure speed and accuracy and write a report with figures";

struct Program {
  void (*add_commands)(CLI::App& app, Action& action);
  /// Converts the typed words to those of a command.
  std::vector<std::string> (*words)(std::vector<std::string> typed, const CLI::App& app);
};

/// The program `viete`, which executes another program for these two commands.
Program viete_program();

/// Parses the command line and runs its command. Returns the exit code; errors go to stderr.
int run_program(int argc, char** argv, const Program& program);

}  // namespace viete::app
