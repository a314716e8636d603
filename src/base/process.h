// Other processes: their unique names, protection from fork(), and child programs.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/os.h"
#include "base/progress.h"

namespace viete::base {

/// Returns "PID-START" of this process. START is its start time: a later process may get the same PID.
std::string process_name();

/// True if the process with this name is running. False for a zombie, for a process that cannot be inspected,
/// and for a text that is not a process name.
bool process_runs(std::string_view name);

/// While a ForkDelay exists, fork() waits in all other threads. The child then cannot inherit half-changed
/// data or locked mutexes. A thread may have several ForkDelays at once.
class ForkDelay {
public:
  ForkDelay();
  ~ForkDelay();
  ForkDelay(const ForkDelay&) = delete;
  ForkDelay& operator=(const ForkDelay&) = delete;
};

/// A child process. Its standard input is empty. Its standard error is kept, and its standard output is kept
/// or discarded. Ctrl+C in a terminal does not end the child. The destructor kills the program and its
/// children. Not thread-safe.
class ChildProgram {
public:
  /// Searches PATH for the program words[0] and starts it, with the other words as arguments. Adds
  /// `variables` ("NAME=value") to the environment. If the program is not installed or cannot be run, throws
  /// Error, usually with `advice`.
  ChildProgram(const std::vector<std::string>& words, const std::string& advice,
               const std::vector<std::string>& variables = {}, bool keeps_output = false);

  /// The first 4 KB of the program's standard error.
  std::string said() const;
  /// The program's standard output. Call this after the program has ended.
  std::string output() const { return child_->output(); }
  bool running() { return child_->running(); }
  /// Asks the program to end (SIGTERM).
  void stop() { child_->ask_to_end(); }
  /// Waits until the program ends, or for `most_seconds`. Reports the progress that the program prints as
  /// lines such as "37 %". Returns the other lines of said(). If `progress` is cancelled, stops the program
  /// and throws Cancelled.
  std::vector<std::string> follow(Progress& progress,
                                  double most_seconds = std::numeric_limits<double>::infinity());
  /// Waits until the program ends. If the program failed, throws Error with its standard error.
  void finish();

private:
  std::string name_;
  std::unique_ptr<os::Child> child_;
};

}  // namespace viete::base
