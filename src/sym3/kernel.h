// Kernels: the functions of this library, compiled for one instruction set each. One kernel is active.
#pragma once

#include <span>
#include <string_view>

namespace viete::sym3 {

struct KernelTable;

/// The functions for one instruction set. To force a kernel for one call, set Batch::kernel (batch.h).
struct Kernel {
  std::string_view name;
  bool fused;                ///< multiply-add rounds once; all fused kernels give the same bits
  long long highway_target;  ///< Highway's name of the instruction set, such as HWY_AVX3
  const KernelTable* table;  ///< internal
};

/// Kernels that were compiled and that this processor supports, fastest first. The last one runs everywhere.
///   fused:      "avx512" (AVX-512 F, VL, DQ, BW), "avx2" (AVX2 and FMA), "neon" (64-bit ARM)
///   not fused:  "scalar"
std::span<const Kernel> kernels();

/// The active kernel, which single calls and, by default, batches use. It is the kernel that the environment
/// variable VIETE_KERNEL names, if that is in kernels(), otherwise the first of kernels(). It is chosen at
/// the first call. Thread-safe.
const Kernel& kernel();

std::string_view kernel_name();

/// The kernel with this name in kernels(), or null.
const Kernel* kernel_from_name(std::string_view name);

}  // namespace viete::sym3
