// What no frame can be faster than: the machine's speed of reading memory and of multiply-adds, measured.
#pragma once

#include <cstddef>

#include "sym3/kernel.h"

namespace viete::bench {

/// Reads `count` floats, a multiple of 64, from aligned memory, and does next to nothing with them.
float run_read_floor(const float* data, std::size_t count, const sym3::Kernel& kernel = sym3::kernel());

/// At least `count` multiply-adds of floats on registers alone, with as many in flight as the machine has
/// registers for.
float run_multiply_add_floor(std::size_t count, const sym3::Kernel& kernel = sym3::kernel());

}  // namespace viete::bench
