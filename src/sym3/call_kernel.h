// Calls kernel functions and splits batches into chunks. Internal.
#pragma once

#include "sym3/kernel.h"
#include "sym3/kernel_table.h"
#include "sym3/view.h"

namespace viete::sym3 {

struct Batch;

template <class T>
const KernelFunctions<T>& functions(const Kernel& k) {
  if constexpr (sizeof(T) == sizeof(double)) {
    return k.table->in_double;
  } else {
    return k.table->in_float;
  }
}

/// A type-erased callable that processes a range of items.
struct RangeTask {
  void (*run)(const void* context, const Range& range);
  const void* context;
};

/// Returns a task that calls `call`. `call` must outlive the task.
template <class Call>
RangeTask task_of(const Call& call) {
  return {[](const void* context, const Range& range) { (*static_cast<const Call*>(context))(range); },
          &call};
}

/// Processes items [0, count) with the batch's executor. `bytes` is the number of bytes read and written.
/// `in_place` is true if the output is the input.
void run_batch(const RangeTask& task, std::size_t count, std::size_t bytes, bool in_place,
               const Batch& batch);

const Kernel& kernel_of(const Batch& batch);

/// Calls a function of the active kernel for one item. `which` is a member of KernelFunctions. The kernel
/// writes the result, of type Out, as contiguous numbers.
template <class Out, class T, class F, class... More>
Out call_one(const F* KernelFunctions<T>::*which, const T* in, const More&... more) {
  Out out;
  (functions<T>(kernel()).*which)->one(in, reinterpret_cast<T*>(&out), more...);
  return out;
}

template <class T, int N>
constexpr std::size_t numbers_of(const View<T, N>&) {
  return N;
}
template <class Parameter>
constexpr std::size_t numbers_of(const Parameter&) {
  return 0;
}

/// Calls a function of the batch's kernel for many items. `more` are further views and parameters.
template <class T, int N, int M, class F, class... More>
void call_many(const F* KernelFunctions<T>::*which, const View<const T, N>& in, const View<T, M>& out,
               std::size_t count, const Batch& batch, const More&... more) {
  const auto many = (functions<T>(kernel_of(batch)).*which)->many;
  const auto call = [&](const Range& range) { many(in, out, more..., range); };
  const std::size_t numbers = N + M + (std::size_t{0} + ... + numbers_of(more));
  run_batch(task_of(call), count, numbers * sizeof(T) * count, in.plane[0] == out.plane[0], batch);
}

}  // namespace viete::sym3
