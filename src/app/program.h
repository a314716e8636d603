// Common code of the main() of `viete` and `viete-bench`.
#pragma once

#include <string>
#include <vector>

#include "app/command_line.h"

namespace viete::app {

/// Descriptions of `viete bench` and `viete report`, used by both.
inline constexpr const char* bench_text = "Measure speed and accuracy on this machine";
inline constexpr const char* report_text = "Write a report of figures measured on this machine";

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
