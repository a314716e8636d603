// Cost of derivatives of matrix functions, compared with the functions themselves and the usual formula.
#pragma once

#include "bench/table.h"

namespace viete::bench {

/// Prints a table for each function and precision, and checks the limits.
void bench_derivatives(Bars& report);

}  // namespace viete::bench
