// Vector code for blocks of triangles with one small matrix each. A plane has one entry of all matrices.
#pragma once

#include <cstddef>

#include "sym3/kernel.h"

namespace viete::deform {

/// A plane has one number per triangle, and one cache line of padding so that no two planes are 4096 bytes
/// apart. The functions always compute plane_size numbers, even for fewer triangles.
inline constexpr std::size_t plane_size = 64, plane_stride = 72;
using Plane = double[plane_stride];

/// Sums over triangles consist of this number of partial sums, so that all computers add in one order.
inline constexpr std::size_t group_size = 8;

struct ScaledRows {
  const double* numbers;
  double factor;
};

/// General matrices have nine planes by rows, symmetric matrices six in the order of Sym3, and vectors three.
/// The first four functions round products and sums separately and give equal bits on all computers. The
/// other functions give equal bits on all computers with fused multiply-add.
struct PlaneKernel {
  /// Adds factor_k rows_k to sums, in the order of k. Rows have n numbers.
  void (*add_rows)(const ScaledRows* rows, std::size_t count, std::size_t n, double* sums);
  /// product = m s, where s is symmetric.
  void (*times_symmetric)(const Plane* m, const Plane* s, Plane* product);
  /// pulls_k = weight_k (m - I) side_k, for three sides.
  void (*pull)(const Plane* m, const Plane* sides, const Plane* weights, Plane* pulls);
  /// m = the sum over three sides of weight_k posed_k side_k^T.
  void (*spread)(const Plane* posed, const Plane* sides, const Plane* weights, Plane* m);
  /// s = exp(X) and m = r exp(Y) s for logs X and Y. r is a matrix by rows; null means I. Prefetches `next`.
  void (*map)(const Plane* logs, const double* r, const Plane* next, Plane* s, Plane* m);
  /// Computes the images of two directions u and v under exp(Y) exp(X), and their derivatives by the weights.
  /// X and Y are weighted sums of `count` logs. group[number][group_size] contains u, v, and for each log X
  /// (in the axes u, v, u x v) and Y. Writes changes[log][3 of u, 3 of v][plane_stride]: the derivatives by
  /// the weights, and the images as the last entry. Writes only the first group_size numbers of each plane.
  void (*derive)(const double* group, const double* weights, std::size_t count, double* changes);
  /// Applies the first two columns of `count` maps to columns[n][2][plane_size]. Adds the results, summed
  /// over groups, to sums[map][column][3][group_size].
  void (*add_products)(const double* maps, std::size_t count, const double* columns, std::size_t n,
                       double* sums);
};

/// Returns the functions for the instruction set of `kernel`.
const PlaneKernel& plane_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
