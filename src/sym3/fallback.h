// Functions of one matrix for input that the vector code cannot process: badly conditioned, huge, tiny or not
// finite. Internal.
#pragma once

namespace viete::sym3 {

// All kernels include this file, so it must not have inline functions. The linker keeps one copy of an inline
// function, and that copy may need newer hardware. Arrays are contiguous; in == out is allowed. u is 2^-53.

/// exp(S) for large spreads, overflow, NaN, infinities and entries near the largest double. Uses Jacobi's
/// method in double-double and sums each entry relative to its largest term. The relative error is below 16 u
/// for any spread. Finite input never gives NaN. Takes some microseconds, less for diagonal matrices.
void exp_by_jacobi(const double* in, double* out);
void exp_by_jacobi(const float* in, float* out);

/// exp'(S)[E] from six numbers of S and six of E. The error is at most 16 u |E| e^(largest eigenvalue).
/// Otherwise as exp_by_jacobi().
void exp_derivative_by_jacobi(const double* in, double* out);
void exp_derivative_by_jacobi(const float* in, float* out);

// Jacobi's method in double, in about 0.5 us. If eigenvalues differ by more than a factor of about 8 to 16,
// in double-double, in 2.5 us. For conditions up to 1e15 and any distance of eigenvalues, the relative error
// in the Frobenius norm is at most 24 u in double, even for small log S. In float it is at most 1.5 u with u
// = 2^-24. NaN as in log.h.
void log_by_jacobi(const double* in, double* out);
void log_by_jacobi(const float* in, float* out);
void sqrt_by_jacobi(const double* in, double* out);
void sqrt_by_jacobi(const float* in, float* out);
void inv_sqrt_by_jacobi(const double* in, double* out);
void inv_sqrt_by_jacobi(const float* in, float* out);

/// The functions that have derivatives.
enum class Of : int { exp, log, sqrt, pow };

/// f'(S)[E] for every f except exp, from six numbers of S and six of E. p is the exponent of pow. Jacobi's
/// method in double-double, in about 3 us. NaN as in derivative.h.
void spectral_derivative_by_jacobi(Of f, double p, const double* in, double* out);
void spectral_derivative_by_jacobi(Of f, double p, const float* in, float* out);

/// Three eigenvalues in ascending order, with the error bound of eigenvalues.h.
void eigenvalues_by_jacobi(const double* in, double* out);
void eigenvalues_by_jacobi(const float* in, float* out);

/// The rotation nearest to a general matrix, by the largest eigenvector of Horn's 4x4 matrix, see polar.h.
/// Both have nine numbers.
void polar_by_jacobi(const double* in, double* out);
void polar_by_jacobi(const float* in, float* out);

/// cos(|w| / 2) and sin(|w| / 2) / |w| of a vector w of any finite length. NaN if w is not finite.
void half_angle(const double* w, double* cosine_and_sine);
void half_angle(const float* w, float* cosine_and_sine);

}  // namespace viete::sym3
