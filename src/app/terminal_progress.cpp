#include "app/terminal_progress.h"

#include <pthread.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>

#include "base/background.h"
#include "base/clock.h"
#include "base/worker_pool.h"

namespace viete::app {

namespace {

constexpr const char* clear_line = "\r\x1B[K";

}  // namespace

TerminalProgress::TerminalProgress(std::string what)
    : what_(std::move(what)),
      shows_(isatty(STDERR_FILENO) == 1),
      counts_(!shows_ && std::getenv("VIETE_PROGRESS") != nullptr) {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  struct sigaction hang_up {};
  if (sigaction(SIGHUP, nullptr, &hang_up) == 0 && hang_up.sa_handler != SIG_IGN)  // nohup ignores it
    sigaddset(&signals_, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  watcher_ = base::try_thread([this](const std::stop_token& stop) { watch(stop); });
  if (!watcher_.joinable()) pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

TerminalProgress::~TerminalProgress() {
  watcher_ = {};
  if (shows_) std::fputs(clear_line, stderr);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void TerminalProgress::watch(const std::stop_token& stop) {
  constexpr timespec tick{0, 50'000'000};
  constexpr double shown_every = 0.2;
  constexpr double time_to_stop = 2;  // the time to cancel the work and remove unfinished files
  const double begun = base::wall_seconds();
  double shown = begun;
  std::optional<double> cancelled;
  int counted = 0;
  while (!stop.stop_requested()) {
    const bool signal = sigtimedwait(&signals_, nullptr, &tick) > 0;
    const double now = base::wall_seconds();
    if (signal && cancelled && now - *cancelled > time_to_stop) {
      pthread_sigmask(SIG_SETMASK, &before_, nullptr);
      std::raise(SIGINT);
    }
    if (signal && !cancelled) {
      cancelled = now;
      progress_.cancel();
    }
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
