/* The functions of many symmetric 3x3 matrices for C, and for all that calls C: Rust, Julia, C#, Fortran.
 *
 * A batch is a pointer to numbers, how many matrices there are, and where they lie:
 *   entry_stride   numbers from one entry of a matrix to its next one
 *   matrix_stride  numbers from one matrix to the next one
 * so that {1, 6} are matrices one after the other, each its upper triangle by rows: xx xy xz yy yz zz, and
 * {n, 1} are six planes of n numbers. General matrices and rotations have nine entries, by rows: {1, 9};
 * and {0, n} are symmetric ones with all nine, n >= 9, of which the upper triangle is read. Strides are above
 * 0 but for that. Those two forms are computed where they lie; others are copied through blocks. Answers
 * may lie where the matrices do, with the same strides; else they share no memory.
 *
 * Where there is no real answer (the log of what is not positive definite) it is NaN. Errors and ranges are
 * those of the C++ headers <viete/sym3/exp.h> and so on. Thread-safe; nothing is kept. Every function returns
 * 0, or -1 where a pointer is null or a stride is 0 that must not be, and then does nothing.
 *
 * Link with the C++ library: cc example.c -lviete_sym3 -lstdc++ -lm. Before 1.0 a new minor version may
 * change this. */
#ifndef VIETE_SYM3_C_H
#define VIETE_SYM3_C_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  size_t entry_stride, matrix_stride;
} viete_layout;

/* Of float64. */
int viete_exp(const double* in, viete_layout in_layout, double* out, viete_layout out_layout, size_t count);
int viete_log(const double* in, viete_layout in_layout, double* out, viete_layout out_layout, size_t count);
int viete_sqrt(const double* in, viete_layout in_layout, double* out, viete_layout out_layout, size_t count);
int viete_inv_sqrt(const double* in, viete_layout in_layout, double* out, viete_layout out_layout,
                   size_t count);
int viete_pow(const double* in, viete_layout in_layout, double p, double* out, viete_layout out_layout,
              size_t count);
/* The derivative of exp at each matrix in a symmetric direction; so of log and sqrt. */
int viete_exp_derivative(const double* in, viete_layout in_layout, const double* direction,
                         viete_layout direction_layout, double* out, viete_layout out_layout, size_t count);
int viete_log_derivative(const double* in, viete_layout in_layout, const double* direction,
                         viete_layout direction_layout, double* out, viete_layout out_layout, size_t count);
int viete_sqrt_derivative(const double* in, viete_layout in_layout, const double* direction,
                          viete_layout direction_layout, double* out, viete_layout out_layout, size_t count);
/* m = r u: general matrices (nine entries) to rotations (nine) and symmetric stretches (six). */
int viete_polar(const double* in, viete_layout in_layout, double* rotations, viete_layout rotation_layout,
                double* stretches, viete_layout stretch_layout, size_t count);

/* Of float32. */
int viete_exp_f(const float* in, viete_layout in_layout, float* out, viete_layout out_layout, size_t count);
int viete_log_f(const float* in, viete_layout in_layout, float* out, viete_layout out_layout, size_t count);
int viete_sqrt_f(const float* in, viete_layout in_layout, float* out, viete_layout out_layout, size_t count);
int viete_inv_sqrt_f(const float* in, viete_layout in_layout, float* out, viete_layout out_layout,
                     size_t count);
int viete_pow_f(const float* in, viete_layout in_layout, double p, float* out, viete_layout out_layout,
                size_t count);
int viete_polar_f(const float* in, viete_layout in_layout, float* rotations, viete_layout rotation_layout,
                  float* stretches, viete_layout stretch_layout, size_t count);

/* The instruction set that runs: "avx512"; never null. */
const char* viete_kernel(void);

#ifdef __cplusplus
}
#endif

#endif
