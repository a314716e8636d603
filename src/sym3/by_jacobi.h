// Functions of one matrix by Jacobi's eigenvectors: the way out of the kernels. Internal.
#pragma once

namespace viete::sym3 {

// Included by the kernels; holds no inline function: the linker keeps one copy of those, and may keep one
// that needs newer hardware. Six numbers in; six out, of eigenvalues three. in == out allowed. Bounds: log.h.

void log_by_jacobi(const double* in, double* out);
void log_by_jacobi(const float* in, float* out);
void sqrt_by_jacobi(const double* in, double* out);
void sqrt_by_jacobi(const float* in, float* out);
void inv_sqrt_by_jacobi(const double* in, double* out);
void inv_sqrt_by_jacobi(const float* in, float* out);
/// Ascending.
void eigenvalues_by_jacobi(const double* in, double* out);
void eigenvalues_by_jacobi(const float* in, float* out);

}  // namespace viete::sym3
