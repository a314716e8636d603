// Which machine code runs exp by method `fast`: the kernels that this machine can run, and the one chosen.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace viete::sym3 {

/// One compilation of the fast exponential. The functions read `count` matrices of six numbers (the order of
/// Sym3) and write as many; in and out may be the same, else must not overlap. No allocation, no state.
struct Kernel {
  std::string_view name;
  void (*exp_double)(const double* in, double* out, std::size_t count);
  void (*exp_float)(const float* in, float* out, std::size_t count);
};

/// Those that this machine can run, best first; the last one is "portable", which runs everywhere.
///   "fma":      fused multiply-add (on x86-64: compiled for AVX2 and FMA)
///   "portable": separate multiplications and additions
std::span<const Kernel> kernels();

/// The one that exp uses: the first of kernels(), or the one named by the environment variable VIETE_KERNEL
/// if this machine can run it. Chosen at the first call, the same until the program ends. Thread-safe.
const Kernel& kernel();

std::string_view kernel_name();

}  // namespace viete::sym3
