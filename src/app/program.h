// What the main() of `viete` and that of `viete-bench` have in common.
#pragma once

#include <string>
#include <vector>

#include "app/command_line.h"

namespace viete::app {

/// Said of `viete bench` and `viete report` by both.
inline constexpr const char* bench_text = "Measure speed and accuracy on this machine";
inline constexpr const char* report_text = "Write a report of figures measured on this machine";

struct Program {
  void (*add_commands)(CLI::App& app, Action& action);
  /// The words of a command, made of what was typed.
  std::vector<std::string> (*words)(std::vector<std::string> typed, const CLI::App& app);
};

/// That of `viete`, which becomes another program for these two.
Program viete_program();

/// Parses the command line and runs its command. Returns the exit code; what is wrong is on stderr.
int run_program(int argc, char** argv, const Program& program);

}  // namespace viete::app
