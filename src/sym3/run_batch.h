// A batch cut into static chunks. Internal.
#pragma once

#include <cstddef>

#include "sym3/batch.h"
#include "sym3/kernel_table.h"

namespace viete::sym3 {

/// run(context, range) does the items of the range.
struct RangeTask {
  void (*run)(const void* context, const Range& range);
  const void* context;
};

/// All of [0, count), on the batch's executor. `bytes`: what is read and written in all.
void run_batch(const RangeTask& task, std::size_t count, std::size_t bytes, bool in_place,
               const Batch& batch);

/// The same for a callable of a range.
template <class F>
void run_batch(const F& f, std::size_t count, std::size_t bytes, bool in_place, const Batch& batch) {
  const auto call = [](const void* context, const Range& range) { (*static_cast<const F*>(context))(range); };
  run_batch(RangeTask{call, &f}, count, bytes, in_place, batch);
}

}  // namespace viete::sym3
