// Single-matrix fallbacks for input that the vector code cannot process: badly conditioned, huge, tiny or not
// finite. Internal.
#pragma once

namespace viete::sym3 {

// Included by the kernels, so it has no inline functions: the linker keeps one copy of those, possibly one
// that needs newer hardware. Contiguous numbers; in == out is allowed.

/// For spreads beyond the kernels' squarings, overflow, NaN and infinities, entries near the largest double.
/// Jacobi in double-double, each entry of the result summed relative to its own largest term: relative error
/// below 16 u (of double) at any spread. Never NaN for finite input. Some microseconds, less for diagonal
/// matrices.
void exp_by_jacobi(const double* in, double* out);
void exp_by_jacobi(const float* in, float* out);

/// exp'(S)[E]: six numbers of S and six of E to six. Error <= 16 u (of double) |E| e^(largest eigenvalue);
/// otherwise as exp_by_jacobi.
void exp_derivative_by_jacobi(const double* in, double* out);
void exp_derivative_by_jacobi(const float* in, float* out);

// Jacobi in double for both types, in double-double if eigenvalues differ by more than a factor of about 8 to
// 16. Relative error, Frobenius norm: <= 24 u in double, even for small log S, <= 1.5 u in float, at any gap
// and for conditions up to 1e15. Some 0.5 us, 2.5 us in double-double. NaN as specified in log.h.
void log_by_jacobi(const double* in, double* out);
void log_by_jacobi(const float* in, float* out);
void sqrt_by_jacobi(const double* in, double* out);
void sqrt_by_jacobi(const float* in, float* out);
void inv_sqrt_by_jacobi(const double* in, double* out);
void inv_sqrt_by_jacobi(const float* in, float* out);

/// The functions that have derivatives.
enum class Of : int { exp, log, sqrt, pow };

/// f'(S)[E] for any f but exp: six numbers of S and six of E to six; p: the exponent of pow. Jacobi in
/// double-double, some 3 us. NaN as specified in derivative.h.
void spectral_derivative_by_jacobi(Of f, double p, const double* in, double* out);
void spectral_derivative_by_jacobi(Of f, double p, const float* in, float* out);

/// Three numbers, ascending, with the error bound of eigenvalues.h.
void eigenvalues_by_jacobi(const double* in, double* out);
void eigenvalues_by_jacobi(const float* in, float* out);

/// The nearest rotation of a general matrix, nine numbers each, by the largest eigenvector of Horn's 4x4
/// matrix; see polar.h.
void polar_by_jacobi(const double* in, double* out);
void polar_by_jacobi(const float* in, float* out);

/// cos(|w| / 2) and sin(|w| / 2) / |w| for a finite w of any length, three numbers; otherwise NaN.
void half_angle(const double* w, double* cosine_and_sine);
void half_angle(const float* w, float* cosine_and_sine);

}  // namespace viete::sym3
