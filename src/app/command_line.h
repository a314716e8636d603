// The subcommands of `viete`, and the common code of the main() of `viete` and `viete-bench`: parsing,
// progress in the terminal and Ctrl+C.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/os.h"
#include "base/progress.h"

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

/// If stderr is a terminal, one line shows task, progress and remaining time. Otherwise, if $VIETE_PROGRESS
/// is set, prints a line such as "37 %" for every percent. While this object exists, Ctrl+C, SIGTERM and
/// SIGHUP cancel the work: the next progress report throws base::Cancelled. A second signal more than two
/// seconds later ends the program at once. If no thread can be created, shows nothing, and a signal ends the
/// program at once.
class TerminalProgress {
public:
  explicit TerminalProgress(std::string what);
  ~TerminalProgress();
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  base::Progress& progress() { return progress_; }

private:
  void cancel();
  void watch(const std::stop_token& stop);

  std::string what_;
  base::Progress progress_;
  bool shows_, counts_;
  std::optional<double> cancelled_;  // the time of the first request to end, in wall seconds
  std::jthread watcher_;
  base::os::EndRequests requests_{[this] { cancel(); }};
};

/// Text such as "37 %", "37 %, 12 s left" or "37 %, 3 min left". `seconds` is the elapsed time.
std::string progress_text(double done, double seconds);

}  // namespace viete::app
