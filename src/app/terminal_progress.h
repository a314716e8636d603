// Shows the progress of a command in the terminal, and cancels the command on Ctrl+C.
#pragma once

#include <csignal>
#include <string>
#include <thread>

#include "base/progress.h"

namespace viete::app {

/// If stderr is a terminal, one line shows task, progress and remaining time. Otherwise, if $VIETE_PROGRESS
/// is set, prints a line such as "37 %" for every percent. While this object exists, Ctrl+C, SIGTERM and
/// SIGHUP cancel the work: the next progress report throws base::Cancelled. A second signal more than two
/// seconds later ends the program at once. Create this object before other threads, because threads inherit
/// its blocked signals. If no thread can be created, shows nothing, and a signal ends the program at once.
class TerminalProgress {
public:
  explicit TerminalProgress(std::string what);
  ~TerminalProgress();
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  base::Progress& progress() { return progress_; }

private:
  void watch(const std::stop_token& stop);

  std::string what_;
  base::Progress progress_;
  bool shows_, counts_;
  sigset_t signals_{}, before_{};
  std::jthread watcher_;
};

/// Text such as "37 %", "37 %, 12 s left" or "37 %, 3 min left". `seconds` is the elapsed time.
std::string progress_text(double done, double seconds);

}  // namespace viete::app
