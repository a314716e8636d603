// Long work of a command: how far it is, on a terminal, and Ctrl+C.
#pragma once

#include <csignal>
#include <string>
#include <thread>

#include "base/progress.h"

namespace viete::app {

/// While it lives, Ctrl+C and SIGTERM cancel the work, which then throws base::Cancelled where it reports
/// next; one that comes two seconds later, or more, ends the program at once. Where stderr is a terminal, a
/// line there shows what is done, how far it is and how long it will take; else, with $VIETE_PROGRESS set,
/// there is a line a percent, "37 %". To be made before other threads are: these then leave the signals to
/// it. If the system allows no thread for this, nothing is shown and a signal ends the program at once.
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

/// "37 %", "37 %, 12 s left", "37 %, 3 min left": after so many seconds of work.
std::string progress_text(double done, double seconds);

}  // namespace viete::app
