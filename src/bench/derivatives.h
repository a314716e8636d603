// What derivatives of functions of matrices cost, beside the functions and beside the formula that others
// use.
#pragma once

#include "bench/table.h"

namespace viete::bench {

/// Prints a table for each function and precision, and the bars.
void bench_derivatives(Bars& report);

}  // namespace viete::bench
