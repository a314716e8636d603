// Settings of a batch: kernel, threads and store instructions.
#pragma once

#include <cstddef>

namespace viete::sym3 {

struct Kernel;

/// Runs tasks, possibly in parallel. run(self, tasks, task, context) must call task(context, i) exactly once
/// for each i < tasks, in any order and on any threads. run() must return only after all these calls have
/// returned.
struct Executor {
  void (*run)(void* self, std::size_t tasks, void (*task)(void* context, std::size_t i), void* context);
  void* self = nullptr;
  std::size_t threads = 1;  ///< a batch is split into at most this number of chunks
};

enum class Stores : unsigned char {
  automatic,  ///< streaming, if the data exceeds the caches and the output is aligned and not the input
  ordinary,
  streaming,  ///< non-temporal stores, which bypass the caches, if layout and alignment allow
};

/// By default a batch runs in the calling thread. If there is an executor, the batch is split into chunks of
/// at least `least_chunk` items. The number of chunks does not change the results.
struct Batch {
  const Kernel* kernel = nullptr;  ///< one of kernels(); null selects the active kernel
  const Executor* executor = nullptr;
  Stores stores = Stores::automatic;

  static constexpr std::size_t least_chunk = 4096;
};

}  // namespace viete::sym3
