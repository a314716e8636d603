// Vector code for the dense steps of a sparse factorisation. sparse_kernel.cpp includes this file once per
// instruction set. Internal. (No #pragma once: see sym3/exp-inl.h.)
#if defined(VIETE_SPARSE_FRONT_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SPARSE_FRONT_KERNEL_INL_H
#undef VIETE_SPARSE_FRONT_KERNEL_INL_H
#else
#define VIETE_SPARSE_FRONT_KERNEL_INL_H
#endif

#include "sparse/sparse_jobs.h"
#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sparse::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FrontTag = hn::CappedTag<double, front_lanes>;
using FrontV = hn::Vec<FrontTag>;
inline constexpr std::size_t most_eliminated = 64;  // columns per call

// Subtracts the updates by columns [begin, c) from column c, and divides column c by its pivot.
static HWY_INLINE void eliminate_column(const Front& front, std::size_t begin, std::size_t c,
                                        double* pivots) {
  const FrontTag d;
  double weighted[most_eliminated];
  const double* const left = front.values + begin * front.stride;
  double* const column = front.values + c * front.stride;
  const std::size_t depth = c - begin;
  double pivot = column[c];
  for (std::size_t p = 0; p < depth; ++p) {
    const double l = left[p * front.stride + c];
    weighted[p] = l * pivots[begin + p];
    pivot -= l * weighted[p];
  }
  pivots[c] = pivot;
  const FrontV share = hn::Set(d, 1 / pivot);
  for (std::size_t r = c / front_lanes * front_lanes; r < front.stride; r += hn::Lanes(d)) {
    FrontV x = hn::Load(d, column + r);
    for (std::size_t p = 0; p < depth; ++p)
      x = hn::NegMulAdd(hn::Load(d, left + p * front.stride + r), hn::Set(d, weighted[p]), x);
    hn::Store(hn::Mul(share, x), d, column + r);
  }
}

static void eliminate(const Front& front, std::size_t begin, std::size_t end, double* pivots) {
  for (std::size_t c = begin; c < end; ++c) eliminate_column(front, begin, c, pivots);
}

// Runs the job for one tile of the result, which begins at `into`. A tile is column_group columns wide and
// `Vectors` vectors high, so that its sums stay in registers.
template <std::size_t Vectors>
static HWY_INLINE void subtract_tile(const ProductJob& job, const double* right, std::size_t row,
                                     double* into) {
  const FrontTag d;
  const std::size_t n = hn::Lanes(d);
  FrontV sum[column_group][Vectors];
#pragma GCC unroll 4
  for (std::size_t j = 0; j < column_group; ++j) {
#pragma GCC unroll 4
    for (std::size_t v = 0; v < Vectors; ++v) sum[j][v] = hn::Load(d, into + j * job.into.stride + v * n);
  }
  const double* left = job.left.values + row;
  for (std::size_t p = 0; p < job.depth; ++p, left += job.left.stride, right += column_group) {
    FrontV l[Vectors];
#pragma GCC unroll 4
    for (std::size_t v = 0; v < Vectors; ++v) l[v] = hn::Load(d, left + v * n);
#pragma GCC unroll 4
    for (std::size_t j = 0; j < column_group; ++j) {
      const FrontV r = hn::Set(d, right[j]);
#pragma GCC unroll 4
      for (std::size_t v = 0; v < Vectors; ++v) sum[j][v] = hn::NegMulAdd(l[v], r, sum[j][v]);
    }
  }
#pragma GCC unroll 4
  for (std::size_t j = 0; j < column_group; ++j) {
#pragma GCC unroll 4
    for (std::size_t v = 0; v < Vectors; ++v) hn::Store(sum[j][v], d, into + j * job.into.stride + v * n);
  }
}

static void subtract_product(const ProductJob& job, std::size_t begin, std::size_t end) {
  const std::size_t n = hn::Lanes(FrontTag());
  for (std::size_t g = begin; g < end; ++g) {
    const double* right = job.right + g * job.depth * column_group;
    double* into = job.into.values + g * column_group * job.into.stride;
    std::size_t row = g * column_group / front_lanes * front_lanes;
    for (; row + 2 * n <= job.rows; row += 2 * n) subtract_tile<2>(job, right, row, into + row);
    for (; row < job.rows; row += n) subtract_tile<1>(job, right, row, into + row);
  }
}

}  // namespace viete::sparse::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
