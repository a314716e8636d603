// Vector code for blocks of triangles with one matrix each. A plane contains one entry of all matrices.
#pragma once

#include <cstddef>

#include "sym3/kernel.h"

namespace viete::shapes {

/// A plane has one number per triangle, and one cache line of padding. Planes 4096 bytes apart would be slow.
/// The functions always compute plane_size numbers, even if a block has fewer triangles.
inline constexpr std::size_t plane_size = 64, plane_stride = 72;
using Plane = double[plane_stride];

/// Number of partial sums in a sum over triangles. It is fixed, so that all computers add in the same order.
inline constexpr std::size_t group_size = 8;

struct ScaledRows {
  const double* numbers;
  double factor;
};

/// A general matrix has nine planes by rows, a symmetric matrix has six in the order of Sym3, and a vector
/// has three. The first four functions round products and sums separately and give equal bits on all
/// computers. The other functions give equal bits on all computers with fused multiply-add.
struct PlaneKernel {
  /// Adds rows[k].factor * rows[k].numbers to sums, in the order of k. `numbers` and `sums` have n entries.
  void (*add_rows)(const ScaledRows* rows, std::size_t count, std::size_t n, double* sums);
  /// product = m * s, where s is symmetric.
  void (*times_symmetric)(const Plane* m, const Plane* s, Plane* product);
  /// pull_k = weight_k * (m - I) * side_k for the three sides k of each triangle.
  void (*pull)(const Plane* m, const Plane* sides, const Plane* weights, Plane* pulls);
  /// m = sum of weight_k * posed_k * side_k^T over the three sides k.
  void (*spread)(const Plane* posed, const Plane* sides, const Plane* weights, Plane* m);
  /// s = exp(X), m = r * exp(Y) * s for logs X, Y. r is one matrix by rows, or null for I. Prefetches `next`.
  void (*map)(const Plane* logs, const double* r, const Plane* next, Plane* s, Plane* m);
  /// Blends `count` logs with `weights` to X and Y. Computes the images of two directions u and v under
  /// exp(Y) * exp(X), and their derivatives by the weights. `group` [number][group_size] contains u, v, and
  /// for each log X (in the axes u, v, u x v) and Y. Writes the derivatives by each log's weight, and
  /// then the images, to `changes` [log][6][plane_stride]. Writes only group_size numbers per plane.
  void (*derive)(const double* group, const double* weights, std::size_t count, double* changes);
  /// For each of `count` maps and each k < n, adds u * q_0 + v * q_1 to sums[map][k][3][group_size], for all
  /// triangles of the block. u and v are the map's images (see derive), and q = columns[k][2][plane_size].
  /// Triangle i is added to partial sum i % group_size.
  void (*add_products)(const double* maps, std::size_t count, const double* columns, std::size_t n,
                       double* sums);
};

const PlaneKernel& plane_kernel(const sym3::Kernel& kernel);

}  // namespace viete::shapes
