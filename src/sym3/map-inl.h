// From a function of registers, some entries in and some out, to a function of batches. Included once per
// instruction set. (No #pragma once: Highway's foreach_target includes this text again for each target.)
// Internal.
#if defined(VIETE_SYM3_MAP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_MAP_INL_H
#undef VIETE_SYM3_MAP_INL_H
#else
#define VIETE_SYM3_MAP_INL_H
#endif

#include "sym3/layouts-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

// F has the numbers of entries F::in and F::out, and f.run<G>(d, in, out) on arrays of G times
// so many registers; F::group is the G to use.

/// G registers' worth of items from the i-th on, of planes.
template <int G, class F, class D, class T>
static HWY_INLINE void map_registers(D d, const F& f, const View<const T, F::in>& in,
                                     const View<T, F::out>& out, std::size_t i) {
  hn::Vec<D> from[G][F::in], to[G][F::out];
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) {
#pragma GCC unroll 16
    for (int k = 0; k < F::in; ++k) from[g][k] = hn::LoadU(d, in.plane[k] + i + g * hn::Lanes(d));
  }
  f.template run<G>(d, from, to);
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) {
#pragma GCC unroll 16
    for (int k = 0; k < F::out; ++k) hn::StoreU(to[g][k], d, out.plane[k] + i + g * hn::Lanes(d));
  }
}

/// One item: numbers in a row.
template <class F, class T>
static HWY_INLINE void map_one(const F& f, const T* in, T* out) {
  const hn::CappedTag<T, 1> d;
  View<const T, F::in> from;
  View<T, F::out> to;
  for (int k = 0; k < F::in; ++k) from.plane[k] = in + k;
  for (int k = 0; k < F::out; ++k) to.plane[k] = out + k;
  map_registers<1>(d, f, from, to, 0);
}

/// Planes that are rows of a tile.
template <class T, int N>
static HWY_INLINE View<T, N> rows_of(T* rows, std::size_t stride) {
  View<T, N> v;
  v.layout = Layout::planes;
  for (int k = 0; k < N; ++k) v.plane[k] = rows + k * stride;
  return v;
}

/// What is not whole registers of planes goes through a tile that stays in the first cache; its end is padded
/// with zeros.
template <class F, class D, class T>
static HWY_NOINLINE void map_tiles(D d, const F& f, const View<const T, F::in>& in,
                                   const View<T, F::out>& out, std::size_t begin, std::size_t end) {
  constexpr std::size_t tile = 64, stride = tile + 64 / sizeof(T);
  alignas(64) T from[F::in * stride] = {}, to[F::out * stride];
  const auto from_rows = rows_of<const T, F::in>(from, stride);
  const auto to_rows = rows_of<T, F::out>(to, stride);
  for (std::size_t i = begin; i < end; i += tile) {
    const std::size_t count = end - i < tile ? end - i : tile;
    gather(d, in, i, count, from, stride);
    for (std::size_t j = 0; j < count; j += hn::Lanes(d)) map_registers<1>(d, f, from_rows, to_rows, j);
    scatter(d, to, stride, count, out, i);
  }
}

template <class F, class T>
static HWY_INLINE void map_many(const F& f, const View<const T, F::in>& in, const View<T, F::out>& out,
                                const Range& range) {
  const hn::ScalableTag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = range.begin;
  if (in.layout == Layout::planes && out.layout == Layout::planes) {
    const View<const T, F::in> from = in;
    const View<T, F::out> to = out;
    constexpr int G = F::group;
    for (; i + G * lanes <= range.end; i += G * lanes) map_registers<G>(d, f, from, to, i);
    for (; i + lanes <= range.end; i += lanes) map_registers<1>(d, f, from, to, i);
  }
  if (i < range.end) map_tiles(d, f, in, out, i, range.end);
}

/// For functions without parameters.
template <class F, class T>
struct Mapped {
  static void one(const T* in, T* out) { map_one(F{}, in, out); }
  static void many(const View<const T, F::in>& in, const View<T, F::out>& out, const Range& range) {
    map_many(F{}, in, out, range);
  }
};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
