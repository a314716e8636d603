// The compiled kernels behind kernel.h, and the way out that they share. Internal.
#pragma once

#include <cstddef>

namespace viete::sym3 {

// `count` matrices of six numbers each, as in Kernel. This header is all that the kernels share with other
// code, and holds no inline function: the linker keeps one copy of those, and may keep one that needs newer
// hardware.

namespace fma {
extern const bool compiled;  ///< false where the compiler had no fused multiply-add to compile for
void exp(const double* in, double* out, std::size_t count);
void exp(const float* in, float* out, std::size_t count);
}  // namespace fma

namespace portable {
void exp(const double* in, double* out, std::size_t count);
void exp(const float* in, float* out, std::size_t count);
}  // namespace portable

/// exp for what the kernels cannot do: spreads beyond their squarings, overflow, NaN and infinities, entries
/// near the largest double. Jacobi in double-double, each entry of the answer summed relative to its own
/// largest term: relative error below 16 u (of double) at any spread. Never NaN for finite input. Some
/// microseconds, but for diagonal matrices. Six numbers each; in == out allowed.
void exp_by_jacobi(const double* in, double* out);
void exp_by_jacobi(const float* in, float* out);

}  // namespace viete::sym3
