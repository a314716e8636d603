// A kernel is a copy of this library's functions, compiled for one instruction set. One kernel is active.
#pragma once

#include <span>
#include <string_view>

namespace viete::sym3 {

struct KernelTable;

/// The functions for one instruction set. To force a kernel for one call, set Batch::kernel (batch.h).
struct Kernel {
  std::string_view name;
  bool fused;                ///< true if multiply-add rounds once; all fused kernels give equal bits
  long long highway_target;  ///< Highway's name of the instruction set, such as HWY_AVX3
  const KernelTable* table;  ///< internal
};

/// The kernels that were compiled and that this processor supports, fastest first. "scalar" runs everywhere.
///   fused:      "avx512" (AVX-512 F, VL, DQ, BW), "avx2" (AVX2 and FMA), "neon" (64-bit ARM)
///   not fused:  "scalar"
std::span<const Kernel> kernels();

/// Returns the active kernel, which runs single calls and, by default, batches. The first call sets it to the
/// kernel named by the environment variable VIETE_KERNEL, or else to the first of kernels(). Thread-safe.
const Kernel& kernel();

std::string_view kernel_name();

/// Returns the kernel with this name in kernels(), or null.
const Kernel* kernel_from_name(std::string_view name);

}  // namespace viete::sym3
