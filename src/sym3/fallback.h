// Functions of one matrix for input that the vector code cannot process: badly conditioned, huge, tiny or not
// finite. Internal.
#pragma once

namespace viete::sym3 {

// All kernels include this file, so this file must not have inline functions. The linker would keep only one
// copy of an inline function, possibly for instructions that this processor lacks. Arrays are contiguous;
// in == out is allowed. u is 2^-53.

/// Computes exp(S) for large spreads, overflow, NaN, infinities and entries near the largest double. Uses
/// Jacobi's method in double-double. The relative error is below 16 u for any spread. Finite input never
/// gives NaN. Takes some microseconds, less for diagonal matrices.
void exp_by_jacobi(const double* in, double* out);
void exp_by_jacobi(const float* in, float* out);

/// Computes exp'(S)[E]. `in` has six numbers of S, then six of E. The error is at most 16 u |E| e^x, where x
/// is the largest eigenvalue. For special values and time see exp_by_jacobi().
void exp_derivative_by_jacobi(const double* in, double* out);
void exp_derivative_by_jacobi(const float* in, float* out);

// log, sqrt and inv_sqrt by Jacobi's method, in about 0.5 us. If the condition number is above about 8 to 16,
// the functions use double-double, in 2.5 us. The relative error in the Frobenius norm is at most 24 u in
// double, and at most 1.5 * 2^-24 in float. These bounds hold for condition numbers up to 1e15 and any gaps
// between eigenvalues. For NaN see log.h.
void log_by_jacobi(const double* in, double* out);
void log_by_jacobi(const float* in, float* out);
void sqrt_by_jacobi(const double* in, double* out);
void sqrt_by_jacobi(const float* in, float* out);
void inv_sqrt_by_jacobi(const double* in, double* out);
void inv_sqrt_by_jacobi(const float* in, float* out);

/// The functions that have derivatives.
enum class Of : int { exp, log, sqrt, pow };

/// Computes f'(S)[E] for every f except exp. `in` has six numbers of S, then six of E. p is the exponent of
/// pow. Uses Jacobi's method in double-double, in about 3 us. For NaN see derivative.h.
void spectral_derivative_by_jacobi(Of f, double p, const double* in, double* out);
void spectral_derivative_by_jacobi(Of f, double p, const float* in, float* out);

/// Computes three eigenvalues in ascending order, with the error bound of eigenvalues.h.
void eigenvalues_by_jacobi(const double* in, double* out);
void eigenvalues_by_jacobi(const float* in, float* out);

/// Computes three eigenvalues in ascending order and the matrix of their eigenvectors, see decomposition.h.
void eigh_by_jacobi(const double* in, double* out);
void eigh_by_jacobi(const float* in, float* out);

/// Computes U, the singular values and V of a general matrix, see decomposition.h. For any lengths of
/// columns.
void svd_by_jacobi(const double* in, double* out);
void svd_by_jacobi(const float* in, float* out);

/// Computes the rotation nearest to a general matrix from the largest eigenvector of Horn's 4x4 matrix, see
/// polar.h. Each matrix has nine numbers.
void polar_by_jacobi(const double* in, double* out);
void polar_by_jacobi(const float* in, float* out);

/// Computes cos(|w| / 2) and sin(|w| / 2) / |w| for any finite w except 0. If w is not finite, gives NaN.
void half_angle(const double* w, double* cosine_and_sine);
void half_angle(const float* w, float* cosine_and_sine);

}  // namespace viete::sym3
