// The subcommands of `viete`, and the common code of the main() of `viete` and `viete-bench`.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace viete::app {

enum ExitCode : int {
  exit_ok = 0,
  exit_failed = 1,  ///< reading, writing or the work failed; the reason is on stderr
  exit_usage = 2,   ///< invalid command line
};

/// The work of the chosen subcommand. Runs after parsing. Returns an exit code.
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

/// Descriptions of the commands `bench` and `report`.
inline constexpr const char* bench_text = "Measure speed and accuracy on this machine";
inline constexpr const char* report_text = "Measure speed and accuracy and write a report with figures";

struct Program {
  void (*add_commands)(CLI::App& app, Action& action);
  /// Returns the command and its arguments for the typed words. For example, inserts a missing `view`.
  std::vector<std::string> (*words)(std::vector<std::string> typed, const CLI::App& app);
};

/// The program `viete`. Its commands `bench` and `report` execute the program `viete-bench`.
Program viete_program();

/// Parses the command line and runs its command. Returns the exit code; errors go to stderr.
int run_program(int argc, char** argv, const Program& program);

}  // namespace viete::app
