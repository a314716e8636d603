// Lower bounds of frame times: the machine's memory read speed and multiply-add throughput, measured.
#pragma once

#include <cstddef>

#include "sym3/kernel.h"

namespace viete::bench {

/// Reads `count` floats, a multiple of 64, from aligned memory, with almost no computation.
float run_read_floor(const float* data, std::size_t count, const sym3::Kernel& kernel = sym3::kernel());

/// At least `count` multiply-adds of floats in registers, with as many in flight as there are registers.
float run_multiply_add_floor(std::size_t count, const sym3::Kernel& kernel = sym3::kernel());

}  // namespace viete::bench
