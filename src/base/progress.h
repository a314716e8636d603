// How long work reports how far it is, and how it is told to stop.
#pragma once

#include <atomic>
#include <stdexcept>

namespace viete::base {

/// Thrown by Progress::report once cancel() was called; whoever started the work catches it.
class Cancelled : public std::runtime_error {
public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// Shared by the thread that works and the one that watches; what the watcher calls is thread-safe.
class Progress {
public:
  /// Called by the work, often: done in [0, 1]. Throws Cancelled when the watcher asked for it.
  void report(double done) {
    const double of_part = from_ + (to_ - from_) * done;
    done_.store(part_from_ + (part_to_ - part_from_) * of_part, std::memory_order_relaxed);
    if (cancelled_.load(std::memory_order_relaxed)) throw Cancelled();
  }

  /// Called by the work: what is reported from now on counts as the part [from, to] of the whole.
  void section(double from, double to) {
    from_ = from;
    to_ = to;
    report(0);
  }

  /// Called by work made of works that have sections: these are of the part [from, to] of the whole from now
  /// on.
  void part(double from, double to) {
    part_from_ = from;
    part_to_ = to;
    section(0, 1);
  }

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  double done() const { return done_.load(std::memory_order_relaxed); }

private:
  std::atomic<double> done_{0.0};
  std::atomic<bool> cancelled_{false};
  double from_ = 0, to_ = 1, part_from_ = 0, part_to_ = 1;
};

}  // namespace viete::base
