#include "sparse/sparse_kernel.h"

#include "sym3/highway_targets.h"

#define HWY_TARGET_INCLUDE "sparse/sparse_kernel.cpp"
#include <hwy/foreach_target.h>

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

// Vector code of sparse factors, compiled once per instruction set.

static const SparseKernel sparse = {solve_forward<solved_columns>,
                                    solve_backward<solved_columns>,
                                    solve_forward<4>,
                                    solve_backward<4>,
                                    eliminate,
                                    subtract_product};

}  // namespace viete::sparse::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace viete::sparse {

const SparseKernel& sparse_kernel(const sym3::Kernel& kernel) {
  VIETE_RETURN_COMPILED(sparse, kernel.highway_target);
}

}  // namespace viete::sparse

#endif
