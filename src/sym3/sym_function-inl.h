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

// F is a function of symmetric matrices: F::quick(d, six) -> {e, ok}, right in the lanes of ok, and
// F::general(d, six, quick) -> six, right in all.

/// The general way of copies: what is passed on by reference lives in memory, and would be stored and loaded again on the
/// quick way too.
template <class F, class D, class V, class Quick>
static HWY_INLINE Six<V> generally(D d, Six<V> s, Quick quick) {
  return F::general(d, s, quick);
}

template <class F, class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> apply(D d, const Six<V>& s) {
  const Six<V> in[1] = {s};
  typename F::template Quick<D> quick[1];
  F::template quick<1>(d, in, quick);
  if (HWY_LIKELY(hn::AllTrue(d, quick[0].ok))) return quick[0].e;
  return generally<F>(d, s, quick[0]);
}

/// Fewer matrices than lanes, through a register's worth of zeros.
template <class F, class D, class T>
static HWY_NOINLINE void apply_rest(D d, const View<const T, 6>& in, const View<T, 6>& out, std::size_t i,
                                    std::size_t count) {
  constexpr std::size_t lanes = hn::MaxLanes(D());
  HWY_ALIGN T rows[6 * lanes] = {};
  gather(in, i, count, rows, lanes);
  const auto at = [&](int k) HWY_ATTR { return rows + k * lanes; };
  store_six<false>(d, apply<F>(d, load_six(d, at)), at);
  scatter(rows, lanes, count, out, i);
}

/// Two registers' worth at a time: independent work hides the latencies. All of an input group is read before
/// any of its output is written, so in == out is fine.
template <class F, class From, class To, bool streaming, class D, class T>
static HWY_INLINE void apply_groups(D d, View<const T, 6> in, View<T, 6> out, std::size_t begin,
                                    std::size_t end) {
  const std::size_t lanes = hn::Lanes(d);
  constexpr int G = 2;
  std::size_t i = begin;
  for (; i + G * lanes <= end; i += G * lanes) {
    if constexpr (streaming) From::prefetch(in, i);
    Six<hn::Vec<D>> s[G];
    typename F::template Quick<D> quick[G];
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) s[g] = From::load(d, in, i + g * lanes);
    F::template quick<G>(d, s, quick);
    hn::Mask<D> ok = quick[0].ok;
#pragma GCC unroll 4
    for (int g = 1; g < G; ++g) ok = hn::And(ok, quick[g].ok);
    if (HWY_UNLIKELY(!hn::AllTrue(d, ok))) {
      for (int g = 0; g < G; ++g) quick[g].e = F::general(d, From::load(d, in, i + g * lanes), quick[g]);
    }
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) To::template store<streaming>(d, quick[g].e, out, i + g * lanes);
  }
  while (i + lanes <= end) {
    To::template store<streaming>(d, apply<F>(d, From::load(d, in, i)), out, i);
    i += lanes;
  }
  if (i < end) apply_rest<F>(d, in, out, i, end - i);
}

template <class F, class Way, class D, class T>
static HWY_NOINLINE void apply_direct(D d, const View<const T, 6>& in, const View<T, 6>& out,
                                      const Range& range, bool aligned) {
  if constexpr (Way::can_stream && hn::MaxLanes(D()) > 1) {
    if (range.stream && aligned) {
      apply_groups<F, Way, Way, true>(d, in, out, range.begin, range.end);
      return hwy::FlushStream();
    }
  }
  apply_groups<F, Way, Way, false>(d, in, out, range.begin, range.end);
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
    gather(in, i, count, rows, stride);
    apply_groups<F, InPlanes, InPlanes, false>(d, same, planes, 0, count);
    scatter(rows, stride, count, out, i);
  }
}

template <class T, int N>
static HWY_INLINE bool is_aligned(const View<T, N>& v) {
  std::size_t bits = reinterpret_cast<std::size_t>(v.plane[0]);
  if (v.layout == Layout::planes) {
    for (int k = 1; k < N; ++k) bits |= reinterpret_cast<std::size_t>(v.plane[k]);
  }
  return bits % 64 == 0;
}

template <class F, class T>
struct Batched {
  static void one(const T* in, T* out) {
    const hn::CappedTag<T, 1> d;
    const auto e = apply<F>(d, load_six(d, [=](int k) HWY_ATTR { return in + k; }));
    store_six<false>(d, e, [=](int k) HWY_ATTR { return out + k; });
  }

  static void many(const View<const T, 6>& in, const View<T, 6>& out, const Range& range) {
    const hn::ScalableTag<T> d;
    if (in.layout != out.layout || in.layout == Layout::full) return apply_tiles<F>(d, in, out, range);
    const bool aligned = is_aligned(out);
    if (in.layout == Layout::planes) return apply_direct<F, InPlanes>(d, in, out, range, aligned);
    if (in.layout == Layout::blocks) return apply_direct<F, InBlocks>(d, in, out, range, aligned);
    return apply_direct<F, InPacked>(d, in, out, range, aligned);
  }
};

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
