// Vector code for triangular solves of many right-hand sides. sparse_kernel.cpp includes this file once per
// instruction set. Internal. (No #pragma once: see sym3/exp-inl.h.)
#if defined(VIETE_SPARSE_SOLVE_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SPARSE_SOLVE_KERNEL_INL_H
#undef VIETE_SPARSE_SOLVE_KERNEL_INL_H
#else
#define VIETE_SPARSE_SOLVE_KERNEL_INL_H
#endif

#include "sparse/sparse_jobs.h"
#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sparse::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// N numbers of one row of a block, in registers.
template <std::size_t N>
struct SolvedRow {
  using Tag = hn::CappedTag<double, N>;
  static constexpr std::size_t lanes = hn::MaxLanes(Tag()), vectors = N / lanes;

  hn::Vec<Tag> v[vectors];

  static HWY_INLINE SolvedRow load(const double* row) {
    SolvedRow r;
    for (std::size_t c = 0; c < vectors; ++c) r.v[c] = hn::Load(Tag(), row + c * lanes);
    return r;
  }
  static HWY_INLINE SolvedRow zero() {
    SolvedRow r;
    for (std::size_t c = 0; c < vectors; ++c) r.v[c] = hn::Zero(Tag());
    return r;
  }
  HWY_INLINE void store(double* row) const {
    for (std::size_t c = 0; c < vectors; ++c) hn::Store(v[c], Tag(), row + c * lanes);
  }
  HWY_INLINE void subtract(double factor, const SolvedRow& b) {
    for (std::size_t c = 0; c < vectors; ++c) v[c] = hn::NegMulAdd(hn::Set(Tag(), factor), b.v[c], v[c]);
  }
  HWY_INLINE void add(const SolvedRow& b) {
    for (std::size_t c = 0; c < vectors; ++c) v[c] = hn::Add(v[c], b.v[c]);
  }
  static HWY_INLINE bool all_zero(const SolvedRow* rows, std::size_t count) {
    auto any = hn::Ne(rows[0].v[0], hn::Zero(Tag()));
    for (std::size_t k = 0; k < count; ++k)
      for (const auto& part : rows[k].v) any = hn::Or(any, hn::Ne(part, hn::Zero(Tag())));
    return hn::AllFalse(Tag(), any);
  }
  HWY_INLINE void scale(double factor) {
    for (std::size_t c = 0; c < vectors; ++c) v[c] = hn::Mul(hn::Set(Tag(), factor), v[c]);
  }
};

template <std::size_t N, std::size_t K>
static HWY_INLINE void subtract_known(const double* values, const SolvedRow<N>* known, double* row) {
  auto sum = SolvedRow<N>::load(row);
#pragma GCC unroll 4
  for (std::size_t k = 0; k < K; ++k) sum.subtract(values[k], known[k]);
  sum.store(row);
}

// Does the forward step of the columns [c, c + K) of a supernode. Returns the end of these columns' values.
template <std::size_t N, std::size_t K>
static HWY_INLINE const double* solve_forward(const Supernode& node, const std::uint32_t* rows, std::size_t c,
                                              const double* values, double* block) {
  double* own = block + node.first * N;
  SolvedRow<N> known[K];
#pragma GCC unroll 4
  for (std::size_t k = 0; k < K; ++k) {
    known[k] = SolvedRow<N>::load(own + (c + k) * N);
#pragma GCC unroll 4
    for (std::size_t l = 0; l < k; ++l) known[k].subtract(*values++, known[l]);
    known[k].store(own + (c + k) * N);
  }
  if (SolvedRow<N>::all_zero(known, K)) return values + K * (node.columns - c - K + node.below);
  for (std::size_t r = c + K; r < node.columns; ++r, values += K)
    subtract_known<N, K>(values, known, own + r * N);
  for (std::size_t i = 0; i < node.below; ++i, values += K)
    subtract_known<N, K>(values, known, block + rows[i] * N);
  return values;
}

template <std::size_t N, std::size_t K>
static HWY_INLINE void subtract_row(const double* values, const double* row, SolvedRow<N>* sums) {
  const auto known = SolvedRow<N>::load(row);
#pragma GCC unroll 4
  for (std::size_t k = 0; k < K; ++k) sums[k].subtract(values[k], known);
}

// Does the backward step of the columns [c, c + K), whose values end at `end`. Returns the start of these
// values. Goes from the last row to the first, which suits prefetching. Several sums per column hide latency.
template <std::size_t N, std::size_t K>
static HWY_INLINE const double* solve_backward(const Supernode& node, const std::uint32_t* rows,
                                               std::size_t c, const double* inverse, const double* end,
                                               double* block) {
  constexpr std::size_t chains = K * SolvedRow<N>::vectors, parts = chains >= 4 ? 1 : chains == 1 ? 4 : 2;
  double* own = block + node.first * N;
  SolvedRow<N> sums[parts][K];
#pragma GCC unroll 4
  for (std::size_t k = 0; k < K; ++k) {
    sums[0][k] = SolvedRow<N>::load(own + (c + k) * N);
    sums[0][k].scale(inverse[node.first + c + k]);
  }
#pragma GCC unroll 4
  for (std::size_t p = 1; p < parts; ++p) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < K; ++k) sums[p][k] = SolvedRow<N>::zero();
  }
  std::size_t i = node.below;
  for (; i >= parts; i -= parts, end -= parts * K) {
#pragma GCC unroll 4
    for (std::size_t p = 0; p < parts; ++p)
      subtract_row<N, K>(end - (p + 1) * K, block + rows[i - 1 - p] * N, sums[p]);
  }
  for (; i-- > 0; end -= K) subtract_row<N, K>(end - K, block + rows[i] * N, sums[0]);
  for (std::size_t r = node.columns; r-- > c + K; end -= K) subtract_row<N, K>(end - K, own + r * N, sums[0]);
#pragma GCC unroll 4
  for (std::size_t p = 1; p < parts; ++p) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < K; ++k) sums[0][k].add(sums[p][k]);
  }
  SolvedRow<N>* x = sums[0];
#pragma GCC unroll 4
  for (std::size_t j = 0; j < K; ++j) {
    const std::size_t k = K - 1 - j;
    x[k].store(own + (c + k) * N);
    end -= k;
    for (std::size_t l = 0; l < k; ++l) x[l].subtract(end[l], x[k]);
  }
  return end;
}

template <std::size_t N>
static HWY_INLINE void solve_forward(const TriangularFactor& f, const Supernode& s, double* block) {
  const std::uint32_t* rows = f.rows + s.rows;
  const double* values = f.values + s.values;
  for (std::size_t c = 0; c < s.columns; c += column_group) {
    switch (s.columns - c) {
      case 1: values = solve_forward<N, 1>(s, rows, c, values, block); break;
      case 2: values = solve_forward<N, 2>(s, rows, c, values, block); break;
      case 3: values = solve_forward<N, 3>(s, rows, c, values, block); break;
      default: values = solve_forward<N, 4>(s, rows, c, values, block);
    }
  }
}

template <std::size_t N>
static HWY_INLINE void solve_backward(const TriangularFactor& f, const Supernode& s, double* block) {
  const std::uint32_t* rows = f.rows + s.rows;
  const double* end = f.values + s.values + s.entries();
  for (std::size_t c = (s.columns - 1) / column_group * column_group + column_group; c > 0;) {
    c -= column_group;
    switch (s.columns - c) {
      case 1: end = solve_backward<N, 1>(s, rows, c, f.inverse, end, block); break;
      case 2: end = solve_backward<N, 2>(s, rows, c, f.inverse, end, block); break;
      case 3: end = solve_backward<N, 3>(s, rows, c, f.inverse, end, block); break;
      default: end = solve_backward<N, 4>(s, rows, c, f.inverse, end, block);
    }
  }
}

template <std::size_t N>
static void solve_forward(const TriangularFactor& f, double* block) {
  for (std::size_t s = 0; s < f.count; ++s) solve_forward<N>(f, f.supernodes[s], block);
}

template <std::size_t N>
static void solve_backward(const TriangularFactor& f, double* block) {
  for (std::size_t s = f.count; s-- > 0;) solve_backward<N>(f, f.supernodes[s], block);
}

}  // namespace viete::sparse::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
