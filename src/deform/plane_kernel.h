// Small matrices of a block of triangles, plane by plane, in vector code. Internal.
#pragma once

#include <cstddef>

#include "sym3/kernel.h"

namespace viete::deform {

/// Numbers per plane, one per triangle, and the distance between planes: one cache line more, so that planes
/// are not 4096 bytes apart. All numbers are computed, including padding.
inline constexpr std::size_t plane_size = 64, plane_stride = 72;
using Plane = double[plane_stride];

/// Triangles that are adjacent in memory and summed separately, independent of the register width, so that
/// all machines add in the same order.
inline constexpr std::size_t group_size = 8;

struct ScaledRows {
  const double* numbers;
  double factor;
};

/// General matrices have nine planes by rows, symmetric ones six as Sym3, vectors three. The first four
/// functions round products and sums separately and give the same bits on every machine; the others give the
/// same bits on every machine with fused multiply-add.
struct PlaneKernel {
  /// sums += factor_k rows_k, in order, n numbers each.
  void (*add_rows)(const ScaledRows* rows, std::size_t count, std::size_t n, double* sums);
  /// product = m s, s symmetric.
  void (*times_symmetric)(const Plane* m, const Plane* s, Plane* product);
  /// pulls_k = weight_k (m - I) side_k, for three sides.
  void (*pull)(const Plane* m, const Plane* sides, const Plane* weights, Plane* pulls);
  /// m = sum over three sides of weight_k posed_k side_k^T.
  void (*spread)(const Plane* posed, const Plane* sides, const Plane* weights, Plane* m);
  /// m = r exp(Y) s, s = exp(X), for logs X and Y; r is one matrix by rows, or null. Prefetches the twelve
  /// planes of `next`.
  void (*map)(const Plane* logs, const double* r, const Plane* next, Plane* s, Plane* m);
  /// Images of two directions u and v under the maps exp(Y) exp(X) of weighted sums of logs, and their
  /// derivatives by the weights. group [number][group_size]: u, v, then for each of `count` logs X in the
  /// axes u, v, u x v, and Y. changes [log, last the map itself][3 of u, 3 of v][plane_stride]; only the
  /// first group_size are written.
  void (*derive)(const double* group, const double* weights, std::size_t count, double* changes);
  /// sums [map][column][3][group_size] += the sums over groups of `count` maps applied to columns of such
  /// directions: columns [n][2][plane_size].
  void (*add_products)(const double* maps, std::size_t count, const double* columns, std::size_t n,
                       double* sums);
};

/// The kernel for the same instruction set.
const PlaneKernel& plane_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
