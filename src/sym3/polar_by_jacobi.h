// The nearest rotation of one matrix, however it is: the way out of the kernels. Internal; no inline
// functions.
#pragma once

namespace viete::sym3 {

/// Nine numbers each; see polar.h.
void polar_by_jacobi(const double* m, double* rotation);
void polar_by_jacobi(const float* m, float* rotation);

}  // namespace viete::sym3
