// Long work in another thread, while the caller's watches it.
#pragma once

#include <chrono>
#include <future>

#include "base/progress.h"
#include "library/deform.h"

namespace viete::library {

/// work(base::Progress*), which is null where nobody watches.
template <class Work>
auto watched(const Watch& watch, const Work& work) {
  using namespace std::chrono_literals;
  if (!watch) return work(static_cast<base::Progress*>(nullptr));
  base::Progress progress;
  auto result = std::async(std::launch::async, [&] { return work(&progress); });
  try {
    while (result.wait_for(50ms) != std::future_status::ready) watch(progress.done());
  } catch (...) {
    progress.cancel();
    result.wait();
    throw;
  }
  return result.get();
}

}  // namespace viete::library
