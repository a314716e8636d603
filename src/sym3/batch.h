// Settings of a batch: kernel, threads, and stores.
#pragma once

#include <cstddef>

namespace viete::sym3 {

struct Kernel;

/// Runs several tasks, possibly in parallel: run(self, n, task, context) must call task(context, i) once for
/// each i < n, on any threads in any order, and return when all are done.
struct Executor {
  void (*run)(void* self, std::size_t tasks, void (*task)(void* context, std::size_t i), void* context);
  void* self = nullptr;
  std::size_t threads = 1;  ///< useful number of tasks
};

enum class Stores : unsigned char {
  automatic,  ///< streaming if it pays: not in place, aligned, and much more data than the caches hold
  ordinary,
  streaming,  ///< bypasses the caches (non-temporal), if layout and alignment allow it
};

/// Defaults: the best kernel, the calling thread. Chunks are static, at least `least_chunk` items each;
/// results do not depend on their number.
struct Batch {
  const Kernel* kernel = nullptr;  ///< one of kernels(), or null: kernel()
  const Executor* executor = nullptr;
  Stores stores = Stores::automatic;

  static constexpr std::size_t least_chunk = 4096;
};

}  // namespace viete::sym3
