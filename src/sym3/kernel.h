// The kernels: one compilation of the batched functions per instruction set, and which of them runs.
#pragma once

#include <span>
#include <string_view>

namespace viete::sym3 {

struct KernelTable;

/// What one instruction set runs. To force it: the field `kernel` of Batch (batch.h), for that call.
struct Kernel {
  std::string_view name;
  bool fused;                ///< multiply-add rounds once; all such kernels give the same bits
  long long highway_target;  ///< HWY_AVX3 and so on, so that fused loops elsewhere follow the same choice
  const KernelTable* table;  ///< internal
};

/// Those that are compiled in and that this machine can run, best first. The last one runs everywhere.
///   "avx512": AVX-512 F, VL, DQ, BW     "avx2": AVX2 and FMA     "neon": 64-bit ARM     (fused)
///   "sse4":   SSE4.2, and "scalar":  separate multiplications and additions; the same bits as each other
std::span<const Kernel> kernels();

/// The one that single calls and, by default, batches use: the first of kernels(), or the one named by the
/// environment variable VIETE_KERNEL if this machine can run it. Chosen at the first call, the same until the
/// program ends. Thread-safe.
const Kernel& kernel();

std::string_view kernel_name();

/// The one of kernels() with that name, or null.
const Kernel* kernel_from_name(std::string_view name);

}  // namespace viete::sym3
