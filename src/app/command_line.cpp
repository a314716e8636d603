#include "app/command_line.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <utility>

#include "app/assets.h"
#include "app/options.h"
#include "base/atomic_file.h"
#include "base/background.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/worker_pool.h"
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
  const std::string kernel = base::os::variable("VIETE_KERNEL");
  if (!kernel.empty() && sym3::kernel_name() != kernel) {
    std::fprintf(stderr, "viete: note: VIETE_KERNEL=%s is not available on this machine; using %s\n",
                 kernel.c_str(), std::string(sym3::kernel_name()).c_str());
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
  app.allow_windows_style_options(false);  // a path may begin with a slash
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

constexpr const char* clear_line = "\r\x1B[K";

}  // namespace

int run_program(int argc, char** argv, const Program& program) {
  std::vector<std::string> arguments = base::os::start_program(argc, argv);
  base::remove_parts_at_signals();
  try {
    return run(program, std::move(arguments));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "viete: %s\n", base::message_of(error).c_str());
    return exit_failed;
  }
}

TerminalProgress::TerminalProgress(std::string what)
    : what_(std::move(what)),
      shows_(base::os::is_terminal(stderr)),
      counts_(!shows_ && !base::os::variable("VIETE_PROGRESS").empty()) {
  if (shows_ || counts_) watcher_ = base::try_thread([this](const std::stop_token& stop) { watch(stop); });
}

TerminalProgress::~TerminalProgress() {
  watcher_ = {};
  if (shows_) std::fputs(clear_line, stderr);
}

void TerminalProgress::cancel() {
  constexpr double time_to_stop = 2;  // the time to cancel the work and remove unfinished files
  const double now = base::wall_seconds();
  if (!cancelled_) {
    cancelled_ = now;
    progress_.cancel();
  } else if (now - *cancelled_ > time_to_stop) {
    requests_.end_process();
  }
}

void TerminalProgress::watch(const std::stop_token& stop) {
  constexpr auto tick = std::chrono::milliseconds(50);
  constexpr double shown_every = 0.2;
  const double begun = base::wall_seconds();
  double shown = begun;
  int counted = 0;
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(tick);
    const double now = base::wall_seconds();
    const int percent = static_cast<int>(100 * progress_.done());
    if (counts_ && percent > counted) std::fprintf(stderr, "%d %%\n", counted = percent);
    if (!shows_ || now - shown < shown_every) continue;
    std::fprintf(stderr, "%s%s: %s", clear_line, what_.c_str(),
                 progress_text(progress_.done(), now - begun).c_str());
    std::fflush(stderr);
    shown = now;
  }
}

std::string progress_text(double done, double seconds) {
  std::string text = std::to_string(static_cast<int>(100 * done)) + " %";
  const auto estimate = base::time_left(done, seconds);
  if (!estimate) return text;
  const double left = std::ceil(*estimate);
  constexpr double minute = 60, long_time = 120;
  if (left < long_time) return text + ", " + std::to_string(static_cast<long>(left)) + " s left";
  return text + ", " + std::to_string(static_cast<long>(std::ceil(left / minute))) + " min left";
}

}  // namespace viete::app
