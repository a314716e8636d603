// Long work in another thread, while the caller's watches it.
#pragma once

#include "base/background.h"
#include "base/progress.h"
#include "library/deform.h"

namespace viete::library {

/// work(base::Progress*), which is null where nobody watches. If the system allows no thread, the caller
/// works unwatched.
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
