/* Functions of many symmetric 3x3 matrices for C and for languages that can call C: Rust, Julia, C#, Fortran.
 *
 * A batch is a pointer to numbers, the number of matrices, and a layout:
 *   entry_stride   distance between two entries of a matrix, in numbers
 *   matrix_stride  distance between two matrices, in numbers
 * Examples:
 *   {1, 6}  symmetric matrices as their upper triangle by rows: xx xy xz yy yz zz
 *   {n, 1}  planes of n numbers, one plane for each entry
 *   {1, 9}  general matrices or rotations: nine entries by rows
 *   {0, n}  symmetric matrices with all nine entries, n >= 9; the upper triangle is read
 * Strides must be positive, except entry_stride 0 of symmetric matrices. Packed and planar layouts and {0, 9}
 * need no copies; other layouts are copied block by block. If input and output have equal layouts, the output
 * may be the input. In all other cases the output must not overlap the input.
 *
 * Undefined results, such as the log of a matrix that is not positive definite, are NaN. The C++ headers, for
 * example <viete/sym3/exp.h>, document errors and ranges. All functions are thread-safe. If a pointer is null
 * or a stride is invalid, a function does nothing and returns -1. Otherwise it returns 0.
 *
 * Link with the C++ library: cc example.c -lviete_sym3 -lstdc++ -lm. Before 1.0 a new minor version may
 * change this interface. */
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
/* The derivatives of exp, log and sqrt at matrix i of `in`, in the direction of matrix i of `direction`. */
int viete_exp_derivative(const double* in, viete_layout in_layout, const double* direction,
                         viete_layout direction_layout, double* out, viete_layout out_layout, size_t count);
int viete_log_derivative(const double* in, viete_layout in_layout, const double* direction,
                         viete_layout direction_layout, double* out, viete_layout out_layout, size_t count);
int viete_sqrt_derivative(const double* in, viete_layout in_layout, const double* direction,
                          viete_layout direction_layout, double* out, viete_layout out_layout, size_t count);
/* M = R U: `in` has general matrices M (9 entries), `rotations` has R (9 entries), `stretches` has U (6). */
int viete_polar(const double* in, viete_layout in_layout, double* rotations, viete_layout rotation_layout,
                double* stretches, viete_layout stretch_layout, size_t count);
/* S = V diag(values) V^T: eigenvalues in ascending order (3 entries) and a rotation V (9 entries), whose
 * column k belongs to value k. */
int viete_eigh(const double* in, viete_layout in_layout, double* values, viete_layout value_layout,
               double* vectors, viete_layout vector_layout, size_t count);
/* M = U diag(values) V^T: rotations U and V (9 entries) and singular values in descending order (3 entries),
 * the last with the sign of the determinant of M. */
int viete_svd(const double* in, viete_layout in_layout, double* u, viete_layout u_layout, double* values,
              viete_layout value_layout, double* v, viete_layout v_layout, size_t count);

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
int viete_eigh_f(const float* in, viete_layout in_layout, float* values, viete_layout value_layout,
                 float* vectors, viete_layout vector_layout, size_t count);
int viete_svd_f(const float* in, viete_layout in_layout, float* u, viete_layout u_layout, float* values,
                viete_layout value_layout, float* v, viete_layout v_layout, size_t count);

/* Returns the active instruction set, for example "avx512". The result is never null. */
const char* viete_kernel(void);

#ifdef __cplusplus
}
#endif

#endif
