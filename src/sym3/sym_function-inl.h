// From a function of registers to a function of batches, in every layout. Included once per instruction set.
// (No #pragma once: Highway's foreach_target includes this text again for each target.) Internal.
#if defined(VIETE_SYM3_SYM_FUNCTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_SYM_FUNCTION_INL_H
#undef VIETE_SYM3_SYM_FUNCTION_INL_H
#else
#define VIETE_SYM3_SYM_FUNCTION_INL_H
#endif

#include "sym3/layouts-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

// F is a function of symmetric matrices: F::quick(d, s, e), of one register or of Two, answers whether it
// found e in every lane; F::general(d, s) always does.

template <class F, class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> apply(D d, const Six<V>& s) {
  Six<V> e;
  if (HWY_LIKELY(F::quick(d, s, e))) return e;
  const Six<V> matrix = s;  // a copy: what is passed by reference lives in memory, on the quick way too
  return F::general(d, matrix);
}

/// Fewer matrices than lanes, through a register's worth of zeros.
template <class F, class D, class T>
static HWY_NOINLINE void apply_rest(D d, const View<const T, 6>& in, const View<T, 6>& out, std::size_t i,
                                    std::size_t count) {
  constexpr std::size_t lanes = hn::MaxLanes(D());
  HWY_ALIGN T rows[6 * lanes] = {};
  gather(d, in, i, count, rows, lanes);
  const auto at = [&](int k) HWY_ATTR { return rows + k * lanes; };
  store_six<false>(d, apply<F>(d, load_six(d, at)), at);
  scatter(d, rows, lanes, count, out, i);
}

/// Two registers' worth at a time. Both are read before any output is written, so in == out is fine. Returns
/// where it stopped. (A function of its own: a second loop over the same constants would take their
/// registers.)
template <class F, class From, class To, bool streaming, class D, class T>
static HWY_NOINLINE std::size_t apply_pairs(D d, View<const T, 6> in, View<T, 6> out, std::size_t i,
                                            std::size_t end) {
  const std::size_t lanes = hn::Lanes(d);
  for (; i + 2 * lanes <= end; i += 2 * lanes) {
    if constexpr (streaming) From::prefetch(d, in, i);
    Six<Two<hn::Vec<D>>> e;
    if (HWY_UNLIKELY(!F::quick(d, together(From::load(d, in, i), From::load(d, in, i + lanes)), e))) {
      To::template store<streaming>(d, F::general(d, From::load(d, in, i)), out, i);
      To::template store<streaming>(d, F::general(d, From::load(d, in, i + lanes)), out, i + lanes);
      continue;
    }
    To::template store<streaming>(d, first(e), out, i);
    To::template store<streaming>(d, second(e), out, i + lanes);
  }
  return i;
}

template <class F, class From, class To, bool streaming, class D, class T>
static HWY_INLINE void apply_all(D d, const View<const T, 6>& in, const View<T, 6>& out, std::size_t begin,
                                 std::size_t end) {
  std::size_t i = apply_pairs<F, From, To, streaming>(d, in, out, begin, end);
  if (i + hn::Lanes(d) <= end) {
    To::template store<streaming>(d, apply<F>(d, From::load(d, in, i)), out, i);
    i += hn::Lanes(d);
  }
  if (i < end) apply_rest<F>(d, in, out, i, end - i);
}

template <class F, class Way, class D, class T>
static HWY_INLINE void apply_direct(D d, const View<const T, 6>& in, const View<T, 6>& out,
                                    const Range& range, bool aligned) {
  if constexpr (Way::can_stream && hn::MaxLanes(D()) > 1) {
    if (range.stream && aligned) {
      apply_all<F, Way, Way, true>(d, in, out, range.begin, range.end);
      return hwy::FlushStream();
    }
  }
  apply_all<F, Way, Way, false>(d, in, out, range.begin, range.end);
}

template <class T, int N>
static HWY_INLINE bool is_aligned(const View<T, N>& v) {
  std::size_t bits = reinterpret_cast<std::size_t>(v.plane[0]);
  if (v.layout == Layout::planes) {
    for (int k = 1; k < N; ++k) bits |= reinterpret_cast<std::size_t>(v.plane[k]);
  }
  return bits % 64 == 0;
}

/// Any layout to any other, through a tile of planes that stays in the first cache.
template <class F, class D, class T>
static HWY_NOINLINE void apply_tiles(D d, const View<const T, 6>& in, const View<T, 6>& out,
                                     const Range& range) {
  constexpr std::size_t tile = 64, stride = tile + 64 / sizeof(T);
  alignas(64) T rows[6 * stride];
  View<T, 6> planes;
  planes.layout = Layout::planes;
  for (int k = 0; k < 6; ++k) planes.plane[k] = rows + k * stride;
  View<const T, 6> same;
  same.layout = Layout::planes;
  for (int k = 0; k < 6; ++k) same.plane[k] = rows + k * stride;
  for (std::size_t i = range.begin; i < range.end; i += tile) {
    const std::size_t count = range.end - i < tile ? range.end - i : tile;
    gather(d, in, i, count, rows, stride);
    apply_all<F, InPlanes, InPlanes, false>(d, same, planes, 0, count);
    scatter(d, rows, stride, count, out, i);
  }
}

/// One matrix as six numbers in a row, in stores of 16 bytes: what the caller copies by 16 it would wait for
/// if it came by 8.
template <class D, class T, class V>
static HWY_INLINE void store_row([[maybe_unused]] D d, const Six<V>& m, T* out) {
#if HWY_TARGET == HWY_SCALAR
  store_six<false>(d, m, [=](int k) HWY_ATTR { return out + k; });
#else
  const hn::Twice<D> two;
  const auto a = hn::Combine(two, m.xy, m.xx), b = hn::Combine(two, m.yy, m.xz),
             c = hn::Combine(two, m.zz, m.yz);
  if constexpr (sizeof(T) == 8) {
    hn::StoreU(a, two, out), hn::StoreU(b, two, out + 2);
  } else {
    const hn::Twice<decltype(two)> four;
    hn::StoreU(hn::Combine(four, b, a), four, out);
  }
  hn::StoreU(c, two, out + 4);
#endif
}

template <class F, class T>
struct Batched {
  static void one(const T* in, T* out) {
    const hn::CappedTag<T, 1> d;
    store_row(d, apply<F>(d, load_six(d, [=](int k) HWY_ATTR { return in + k; })), out);
  }

  static void many(const View<const T, 6>& in, const View<T, 6>& out, const Range& range) {
    const hn::ScalableTag<T> d;
    if (in.layout != out.layout) return apply_tiles<F>(d, in, out, range);
    const bool aligned = is_aligned(out);
    if (in.layout == Layout::planes) return apply_direct<F, InPlanes>(d, in, out, range, aligned);
    if (in.layout == Layout::blocks) return apply_direct<F, InBlocks>(d, in, out, range, aligned);
    if (in.layout == Layout::full) return apply_direct<F, InFull>(d, in, out, range, aligned);
    return apply_direct<F, InPacked>(d, in, out, range, aligned);
  }
};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
