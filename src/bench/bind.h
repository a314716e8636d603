// viete bench bind: time and memory of binding, compared with plain loops.
#pragma once

#include "bench/models.h"

namespace viete::bench {

/// Prints a table for each cage. Throws base::Error.
void bench_bind(const ModelOptions& options);

}  // namespace viete::bench
