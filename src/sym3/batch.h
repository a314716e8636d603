// How a batch is run: by which kernel, on which threads, with which stores.
#pragma once

#include <cstddef>

namespace viete::sym3 {

struct Kernel;

/// A way to run a few tasks at once, without owning threads: run(self, n, task, context) calls
/// task(context, i) once for each i < n, on any threads in any order, and returns when all are done.
struct Executor {
  void (*run)(void* self, std::size_t tasks, void (*task)(void* context, std::size_t i), void* context);
  void* self = nullptr;
  std::size_t threads = 1;  ///< tasks worth making
};

enum class Stores : unsigned char {
  automatic,  ///< streaming where it pays: not in place, aligned, and far more data than caches hold
  ordinary,
  streaming,  ///< past the caches (non-temporal), where the layout and alignment allow it
};

/// Defaults: the best kernel, the calling thread. Chunks are static, at least `least_chunk` items each; the
/// answers do not depend on their number.
struct Batch {
  const Kernel* kernel = nullptr;  ///< one of kernels(), or null: kernel()
  const Executor* executor = nullptr;
  Stores stores = Stores::automatic;

  static constexpr std::size_t least_chunk = 4096;
};

}  // namespace viete::sym3
