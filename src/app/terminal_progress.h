// Progress of a command's long work on a terminal, and Ctrl+C.
#pragma once

#include <csignal>
#include <string>
#include <thread>

#include "base/progress.h"

namespace viete::app {

/// During its lifetime Ctrl+C and SIGTERM cancel the work, which throws base::Cancelled at its next report; a
/// second signal at least two seconds later ends the program at once. If stderr is a terminal, a line shows
/// the task, its progress and the remaining time; otherwise, with $VIETE_PROGRESS set, it prints a line per
/// percent, "37 %". Create it before other threads, which then leave the signals to it. If no thread can be
/// created, nothing is shown and a signal ends the program at once.
class TerminalProgress {
public:
  explicit TerminalProgress(std::string what);
  ~TerminalProgress();
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  base::Progress& progress() { return progress_; }

private:
  void watch(const std::stop_token& stop);
  void show(double seconds) const;

  std::string what_;
  base::Progress progress_;
  bool shows_, counts_;
  sigset_t signals_{}, before_{};
  std::jthread watcher_;
};

/// "37 %", "37 %, 12 s left", "37 %, 3 min left"; `seconds` is the elapsed time.
std::string progress_text(double done, double seconds);

}  // namespace viete::app
