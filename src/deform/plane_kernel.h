// Small matrices of a block of triangles, plane by plane, in vector code. Internal.
#pragma once

#include <cstddef>

#include "sym3/kernel.h"

namespace viete::deform {

/// Numbers of a plane, one a triangle, and from one plane to the next: a cache line more, so that planes do
/// not lie 4096 bytes apart. All are computed, also those of no triangle.
inline constexpr std::size_t plane_size = 64, plane_stride = 72;
using Plane = double[plane_stride];

/// General matrices have nine planes by rows, symmetric ones six as Sym3, vectors three. Products and sums
/// are rounded one by one, so that the first four give the same bits on every machine; the others on every
/// one with fused multiply-add.
struct PlaneKernel {
  /// product = m s, s symmetric.
  void (*times_symmetric)(const Plane* m, const Plane* s, Plane* product);
  /// m = r m, r one matrix by rows.
  void (*turn)(const double* r, Plane* m);
  /// pulls_k = weight_k (m - I) side_k, of three sides.
  void (*pull)(const Plane* m, const Plane* sides, const Plane* weights, Plane* pulls);
  /// m = sum over three sides of weight_k posed_k side_k^T.
  void (*spread)(const Plane* posed, const Plane* sides, const Plane* weights, Plane* m);
  /// m' += [J v]x m with J v = v + a y x v + b y x (y x v): y and v vectors, a and b the planes of `ab`.
  void (*add_turning)(const Plane* y, const Plane* v, const Plane* ab, const Plane* m, Plane* changed);
  /// sums[3 n ..] += the sum over all triangles of m q_n; q [n][3][plane_size].
  void (*add_products)(const Plane* m, const double* q, std::size_t count, double* sums);
};

/// That of the same instruction set.
const PlaneKernel& plane_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
