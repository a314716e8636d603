// exp for what the kernels cannot do: the way out that they share. Internal.
#pragma once

namespace viete::sym3 {

// This header is included by the kernels and holds no inline function: the linker keeps one copy of those,
// and may keep one that needs newer hardware.

/// For spreads beyond the kernels' squarings, overflow, NaN and infinities, entries near the largest double.
/// Jacobi in double-double, each entry of the answer summed relative to its own largest term: relative error
/// below 16 u (of double) at any spread. Never NaN for finite input. Some microseconds, but for diagonal
/// matrices. Six numbers each; in == out allowed.
void exp_by_jacobi(const double* in, double* out);
void exp_by_jacobi(const float* in, float* out);

}  // namespace viete::sym3
