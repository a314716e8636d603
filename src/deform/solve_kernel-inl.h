// Triangular solves of many right-hand sides in vector registers: included by bind_kernel.cpp for each
// instruction set. Internal. (No #pragma once: see sym3/exp-inl.h.)
#if defined(VIETE_DEFORM_SOLVE_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_DEFORM_SOLVE_KERNEL_INL_H
#undef VIETE_DEFORM_SOLVE_KERNEL_INL_H
#else
#define VIETE_DEFORM_SOLVE_KERNEL_INL_H
#endif

#include "deform/bind_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

using ColumnTag = hn::CappedTag<double, solved_columns>;
using ColumnV = hn::Vec<ColumnTag>;
inline constexpr std::size_t column_lanes = hn::MaxLanes(ColumnTag()),
                             column_vectors = solved_columns / column_lanes;

/// The columns of one row of a block, in registers.
struct ColumnRow {
  ColumnV v[column_vectors];
};

static HWY_INLINE ColumnRow load_row(const double* block, std::size_t row) {
  ColumnRow r;
  for (std::size_t c = 0; c < column_vectors; ++c)
    r.v[c] = hn::Load(ColumnTag(), block + row * solved_columns + c * column_lanes);
  return r;
}

static HWY_INLINE void store_row(const ColumnRow& r, double* block, std::size_t row) {
  for (std::size_t c = 0; c < column_vectors; ++c)
    hn::Store(r.v[c], ColumnTag(), block + row * solved_columns + c * column_lanes);
}

// a - factor b.
static HWY_INLINE ColumnRow subtracted(const ColumnRow& a, double factor, const ColumnRow& b) {
  ColumnRow r;
  for (std::size_t c = 0; c < column_vectors; ++c)
    r.v[c] = hn::NegMulAdd(hn::Set(ColumnTag(), factor), b.v[c], a.v[c]);
  return r;
}

static HWY_INLINE ColumnRow scaled_row(double factor, const ColumnRow& a) {
  ColumnRow r;
  for (std::size_t c = 0; c < column_vectors; ++c) r.v[c] = hn::Mul(hn::Set(ColumnTag(), factor), a.v[c]);
  return r;
}

static void solve_columns(const TriangularFactor& f, double* block) {
  for (std::size_t j = 0; j < f.size; ++j) {
    const ColumnRow x = load_row(block, j);
    for (std::uint32_t p = f.starts[j]; p < f.starts[j + 1]; ++p)
      store_row(subtracted(load_row(block, f.rows[p]), f.values[p], x), block, f.rows[p]);
  }
  for (std::size_t j = f.size; j-- > 0;) {
    ColumnRow x = scaled_row(f.inverse_diagonal[j], load_row(block, j));
    for (std::uint32_t p = f.starts[j]; p < f.starts[j + 1]; ++p)
      x = subtracted(x, f.values[p], load_row(block, f.rows[p]));
    store_row(x, block, j);
  }
}

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
