#include "app/command_line.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "app/assets.h"
#include "app/options.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "sym3/kernel.h"

namespace viete::app {

namespace {

constexpr const char* footer =
    "Exit codes:\n"
    "  0  success\n"
    "  1  a file could not be read or written, or the work failed (see stderr)\n"
    "  2  wrong command line\n\n"
    "The manual explains all terms: viete manual glossary";

void note_kernel() {
  const char* kernel = std::getenv("VIETE_KERNEL");
  if (kernel && sym3::kernel_name() != kernel) {
    std::fprintf(stderr, "viete: note: VIETE_KERNEL=%s is not available on this machine; using %s\n", kernel,
                 std::string(sym3::kernel_name()).c_str());
  }
}

// Returns the exit code after the output has been written. A reader that has closed the pipe wants no
// message.
int finished(int code) {
  std::cout.flush();
  if (std::cout && std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  if (errno == EPIPE) return exit_failed;
  std::fprintf(stderr, "viete: standard output could not be written; check the disk space\n");
  return exit_failed;
}

int run(const Program& program, std::vector<std::string> arguments) {
  CLI::App app("Viete: cage-based mesh deformation with exponentials of symmetric 3x3 matrices", "viete");
  app.set_version_flag("--version",
                       std::string("viete ") + version() + "\n" + build_type() + ", kernel " +
                           std::string(sym3::kernel_name()),
                       "Show version information and exit");
  app.footer(footer);
  app.formatter(help_formatter());
  app.set_help_flag("-h,--help", "Show this help and exit");
  app.require_subcommand(1);
#if CLI11_VERSION_MAJOR > 2 || CLI11_VERSION_MINOR >= 6
  // Reports invalid values before missing values, as older CLI11 does. Subcommands inherit this setting.
  app.option_defaults()->callback_priority(CLI::CallbackPriority::PreRequirementsCheck);
#endif
  Action action;
  program.add_commands(app, action);
  try {
    std::vector<std::string> words = program.words(std::move(arguments), app);
    note_kernel();
    std::reverse(words.begin(), words.end());  // CLI11 expects the last argument first
    app.parse(words);
  } catch (const CLI::Success& help) {
    return finished(app.exit(help));
  } catch (const CLI::ParseError& error) {
    std::fputs(usage_error(app, error).c_str(), stderr);
    return exit_usage;
  }
  return finished(action());
}

}  // namespace

int run_program(int argc, char** argv, const Program& program) {
  // Failed writes are then errors, after which unfinished files are removed.
  for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);
  base::remove_parts_at_signals();
  try {
    return run(program, {argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "viete: %s\n", base::message_of(error).c_str());
    return exit_failed;
  }
}

}  // namespace viete::app
