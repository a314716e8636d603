// The progress of long work, and its cancellation.
#pragma once

#include <atomic>
#include <stdexcept>

namespace viete::base {

/// Progress::report() throws this exception after cancel(). The caller that started the work must catch it.
class Cancelled : public std::runtime_error {
public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// The progress of long work. The thread that does the work calls report() and section(). Any other thread
/// may call cancel() and done().
class Progress {
public:
  /// Reports the finished fraction of the section. Call this often. After cancel(), throws Cancelled.
  void report(double done) {
    done_.store(section_.at(done), std::memory_order_relaxed);
    if (cancelled_.load(std::memory_order_relaxed)) throw Cancelled();
  }

  /// Begins a section. Its reports move the progress from `from` to `to`, as fractions of the current part.
  void section(double from, double to) {
    section_ = {part_.at(from), part_.at(to)};
    report(0);
  }

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  double done() const { return done_.load(std::memory_order_relaxed); }

private:
  friend class ProgressPart;
  struct Range {
    double from = 0, to = 1;
    double at(double share) const { return from + (to - from) * share; }
  };
  std::atomic<double> done_{0.0};
  std::atomic<bool> cancelled_{false};
  Range part_, section_;  // as fractions of the whole work
};

/// A part of the current section of `progress`, which may be null. During its lifetime, sections and reports
/// move the progress from `from` to `to`, as fractions of this section.
class ProgressPart {
public:
  ProgressPart(Progress* progress, double from, double to) : progress_(progress) {
    if (!progress) return;
    part_ = progress->part_;
    section_ = progress->section_;
    progress->part_ = {section_.at(from), section_.at(to)};
    progress->section(0, 1);
  }
  ~ProgressPart() {
    if (progress_) {
      progress_->part_ = part_;
      progress_->section_ = section_;
    }
  }
  ProgressPart(const ProgressPart&) = delete;
  ProgressPart& operator=(const ProgressPart&) = delete;

private:
  Progress* progress_;
  Progress::Range part_, section_;
};

}  // namespace viete::base
