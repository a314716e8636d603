#include "sym3/batch.h"

#include <algorithm>

#include "sym3/call_kernel.h"

namespace viete::sym3 {

namespace {

// About half of a large last-level cache. For more data, streaming stores are faster, because normal stores
// first load each cache line.
constexpr std::size_t streaming_bytes = 24u << 20;

constexpr std::size_t granule = 64;  // chunks begin at a multiple of this number of items

struct Chunks {
  const RangeTask& task;
  std::size_t count, size;
  bool stream;
};

void run_chunk(void* context, std::size_t i) {
  const auto& c = *static_cast<const Chunks*>(context);
  const std::size_t begin = i * c.size;
  if (begin < c.count) c.task.run(c.task.context, {begin, std::min(begin + c.size, c.count), c.stream});
}

bool should_stream(Stores stores, std::size_t bytes, bool in_place) {
  if (stores != Stores::automatic) return stores == Stores::streaming;
  return !in_place && bytes > streaming_bytes;
}

}  // namespace

const Kernel& kernel_of(const Batch& batch) {
  return batch.kernel ? *batch.kernel : kernel();
}

void run_batch(const RangeTask& task, std::size_t count, std::size_t bytes, bool in_place,
               const Batch& batch) {
  const Executor* executor = batch.executor;
  const std::size_t most = std::max<std::size_t>(1, count / Batch::least_chunk);
  const std::size_t tasks = executor ? std::clamp<std::size_t>(executor->threads, 1, most) : 1;
  const std::size_t size = ((count + tasks - 1) / tasks + granule - 1) / granule * granule;
  Chunks chunks = {task, count, size, should_stream(batch.stores, bytes, in_place)};
  if (tasks == 1) return run_chunk(&chunks, 0);
  executor->run(executor->self, tasks, run_chunk, &chunks);
}

}  // namespace viete::sym3
