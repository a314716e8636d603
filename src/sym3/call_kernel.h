// From a public function to the kernel that runs it. Internal.
#pragma once

#include "sym3/kernel.h"
#include "sym3/run_batch.h"
#include "sym3/view.h"

namespace viete::sym3 {

template <class T, int N, int M>
const Function<T, N, M>& of_type(const Functions<N, M>& f) {
  if constexpr (sizeof(T) == sizeof(double)) {
    return *f.in_double;
  } else {
    return *f.in_float;
  }
}

/// One item by the running kernel; `which` is a member of KernelTable.
template <class T, int N, int M>
void call_one(Functions<N, M> KernelTable::*which, const T* in, T* out) {
  of_type<T>(kernel().table->*which).one(in, out);
}

template <class T, int N, int M>
void call_many(Functions<N, M> KernelTable::*which, const View<const T, N>& in, const View<T, M>& out,
               std::size_t count, const Batch& batch) {
  const Kernel& k = batch.kernel ? *batch.kernel : kernel();
  const auto many = of_type<T>(k.table->*which).many;
  run_batch([&](const Range& range) { many(in, out, range); }, count, (N + M) * sizeof(T) * count,
            in.plane[0] == out.plane[0], batch);
}

}  // namespace viete::sym3
