/* Functions of many symmetric 3x3 matrices for C and languages that can call C: Rust, Julia, C#, Fortran.
 *
 * A batch is a pointer to numbers, the number of matrices, and a layout:
 *   entry_stride   numbers from one entry of a matrix to its next one
 *   matrix_stride  numbers from one matrix to the next one
 * {1, 6} is an array of matrices, each stored as its upper triangle by rows: xx xy xz yy yz zz; {n, 1} is six
 * planes of n numbers. General matrices and rotations have nine entries, by rows: {1, 9}. {0, n}, n >= 9, is
 * an array of symmetric matrices with all nine entries, of which the upper triangle is read; other strides
 * must be positive. Packed and planar layouts are processed in place; others are copied through blocks.
 * Results may overwrite the matrices with the same strides; otherwise they must not overlap them.
 *
 * Undefined results (the log of a matrix that is not positive definite) are NaN. Errors and ranges are those
 * of the C++ headers <viete/sym3/exp.h> and so on. Thread-safe; no global state. Every function returns 0;
 * if a pointer is null or a stride is invalid, it does nothing and returns -1.
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

/* Double precision. */
int viete_exp(const double* in, viete_layout in_layout, double* out, viete_layout out_layout, size_t count);
int viete_log(const double* in, viete_layout in_layout, double* out, viete_layout out_layout, size_t count);
int viete_sqrt(const double* in, viete_layout in_layout, double* out, viete_layout out_layout, size_t count);
int viete_inv_sqrt(const double* in, viete_layout in_layout, double* out, viete_layout out_layout,
                   size_t count);
int viete_pow(const double* in, viete_layout in_layout, double p, double* out, viete_layout out_layout,
              size_t count);
/* Derivatives of exp, log and sqrt at each matrix in a symmetric direction. */
int viete_exp_derivative(const double* in, viete_layout in_layout, const double* direction,
                         viete_layout direction_layout, double* out, viete_layout out_layout, size_t count);
int viete_log_derivative(const double* in, viete_layout in_layout, const double* direction,
                         viete_layout direction_layout, double* out, viete_layout out_layout, size_t count);
int viete_sqrt_derivative(const double* in, viete_layout in_layout, const double* direction,
                          viete_layout direction_layout, double* out, viete_layout out_layout, size_t count);
/* m = r u: general matrices (nine entries) to rotations (nine) and symmetric stretches (six). */
int viete_polar(const double* in, viete_layout in_layout, double* rotations, viete_layout rotation_layout,
                double* stretches, viete_layout stretch_layout, size_t count);

/* Single precision. */
int viete_exp_f(const float* in, viete_layout in_layout, float* out, viete_layout out_layout, size_t count);
int viete_log_f(const float* in, viete_layout in_layout, float* out, viete_layout out_layout, size_t count);
int viete_sqrt_f(const float* in, viete_layout in_layout, float* out, viete_layout out_layout, size_t count);
int viete_inv_sqrt_f(const float* in, viete_layout in_layout, float* out, viete_layout out_layout,
                     size_t count);
int viete_pow_f(const float* in, viete_layout in_layout, double p, float* out, viete_layout out_layout,
                size_t count);
int viete_polar_f(const float* in, viete_layout in_layout, float* rotations, viete_layout rotation_layout,
                  float* stretches, viete_layout stretch_layout, size_t count);

/* The active instruction set, for example "avx512"; never null. */
const char* viete_kernel(void);

#ifdef __cplusplus
}
#endif

#endif
