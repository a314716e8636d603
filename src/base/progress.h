// The progress of long work, and its cancellation.
#pragma once

#include <atomic>
#include <cmath>
#include <stdexcept>

namespace viete::base {

/// Progress::report() throws this exception after cancel(). The caller that started the work must catch it.
class Cancelled : public std::runtime_error {
public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// The progress of long work. The thread that does the work calls report(), section() and part(). Any other
/// thread may call cancel() and done().
class Progress {
public:
  /// Reports the finished fraction of the section. Call this often. After cancel(), throws Cancelled.
  void report(double done) {
    const double of_part = from_ + (to_ - from_) * done;
    done_.store(part_from_ + (part_to_ - part_from_) * of_part, std::memory_order_relaxed);
    if (cancelled_.load(std::memory_order_relaxed)) throw Cancelled();
  }

  /// Begins a section. Its reports move the progress from `from` to `to`, as fractions of the current part.
  void section(double from, double to) {
    from_ = from;
    to_ = to;
    report(0);
  }

  /// Begins a part. Its sections move the progress from `from` to `to`, as fractions of the whole work.
  void part(double from, double to) {
    part_from_ = from;
    part_to_ = to;
    section(0, 1);
  }

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  double done() const { return done_.load(std::memory_order_relaxed); }

private:
  friend class Subsection;
  std::atomic<double> done_{0.0};
  std::atomic<bool> cancelled_{false};
  double from_ = 0, to_ = 1, part_from_ = 0, part_to_ = 1;
};

/// A part of the current section: during its lifetime, reports move the progress from `from` to `to`, as
/// fractions of the section. `progress` may be null.
class Subsection {
public:
  Subsection(Progress* progress, double from, double to) : progress_(progress) {
    if (!progress) return;
    from_ = progress->from_, to_ = progress->to_;
    progress->section(std::lerp(from_, to_, from), std::lerp(from_, to_, to));
  }
  ~Subsection() {
    if (progress_) progress_->from_ = from_, progress_->to_ = to_;
  }
  Subsection(const Subsection&) = delete;
  Subsection& operator=(const Subsection&) = delete;

private:
  Progress* progress_;
  double from_ = 0, to_ = 1;
};

}  // namespace viete::base
