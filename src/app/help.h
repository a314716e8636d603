// What the command line says about itself: help that fits a terminal, and errors that lead on.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

namespace viete::app {

/// Writes --help, 80 columns wide. A command's usage line is made of its options, unless `usage` is given for
/// the program itself.
std::shared_ptr<CLI::FormatterBase> help_formatter();

/// "viete bench exp": the command that the command line has got to.
std::string name_of_command(const CLI::App& app);

/// What is wrong with a command line, in one or two lines that end with the help to read. What the program
/// does not know is named before what it misses.
std::string usage_error(const CLI::App& app, const CLI::Error& error);

/// The names of an app's commands.
std::vector<std::string> command_names(const CLI::App& app);

}  // namespace viete::app
