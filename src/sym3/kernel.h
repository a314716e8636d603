// Kernels: one compilation of the batched functions per instruction set, and the choice of the active one.
#pragma once

#include <span>
#include <string_view>

namespace viete::sym3 {

struct KernelTable;

/// One instruction set. To force it for a call, set the field `kernel` of Batch (batch.h).
struct Kernel {
  std::string_view name;
  bool fused;                ///< multiply-add rounds once; all such kernels give the same bits
  long long highway_target;  ///< Highway's target, such as HWY_AVX3, for fused loops of other libraries
  const KernelTable* table;  ///< internal
};

/// Kernels that are compiled in and supported by this machine, best first. The last one runs everywhere.
///   "avx512": AVX-512 F, VL, DQ, BW     "avx2": AVX2 and FMA     "neon": 64-bit ARM     (fused)
///   "scalar": separate multiplications and additions
std::span<const Kernel> kernels();

/// The kernel of single calls and, by default, of batches: the first of kernels(), or the one named by the
/// environment variable VIETE_KERNEL if this machine supports it. Chosen at the first call, then constant.
/// Thread-safe.
const Kernel& kernel();

std::string_view kernel_name();

/// The kernel with that name in kernels(), or null.
const Kernel* kernel_from_name(std::string_view name);

}  // namespace viete::sym3
