// Runs long work in another thread while the calling thread reports its progress.
#pragma once

#include "base/background.h"
#include "base/progress.h"
#include "library/deform.h"

namespace viete::library {

/// Runs work(base::Progress*). The pointer is null without a watch; then, or if the system cannot start a
/// thread, the work runs in the calling thread.
template <class Work>
auto watched(const Watch& watch, const Work& work) {
  if (!watch) return work(static_cast<base::Progress*>(nullptr));
  base::Progress progress;
  base::BackgroundQueue queue;
  auto result = queue.add([&] { return work(&progress); });
  try {
    while (!base::is_ready(result, 0.05)) watch(progress.done());
  } catch (...) {
    progress.cancel();
    result.wait();
    throw;
  }
  return result.get();
}

}  // namespace viete::library
