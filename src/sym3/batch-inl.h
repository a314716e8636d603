// From functions of registers to functions of batches, in every layout, and of single items. Included once
// per instruction set. (No #pragma once: Highway's foreach_target includes this file again for each target.)
// Internal.
#if defined(VIETE_SYM3_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_BATCH_INL_H
#undef VIETE_SYM3_BATCH_INL_H
#else
#define VIETE_SYM3_BATCH_INL_H
#endif

#include "sym3/layouts-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

// A function F of small matrices or vectors has
//   in, out                        numbers per item of input and output
//   group                          number of registers processed together
//   memory_bound                   true if loads and stores take as long as the arithmetic: then every layout
//                                  is read and written in place, and stores may bypass the caches
//   f.quick<G>(d, from, to)        V from[G][in], to[G][out]: true if `to` is valid in every lane
//   f.general(d, from, to)         V from[in], to[out], valid for any input; unused if quick always succeeds

/// Processes G registers of items from the i-th on. Reads all before it writes any, so in == out is allowed.
/// The general path reads them again: keeping them would occupy registers of the quick path.
template <int G, class From, class To, bool streaming, class F, class D, class T>
static HWY_INLINE void map_registers(D d, const F& f, const View<const T, F::in>& in,
                                     const View<T, F::out>& out, std::size_t i) {
  const std::size_t lanes = hn::Lanes(d);
  hn::Vec<D> from[G][F::in], to[G][F::out];
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) From::load(d, in, i + g * lanes, from[g]);
  const bool done = f.template quick<G>(d, from, to);
  if constexpr (requires { f.general(d, from[0], to[0]); }) {
    if (HWY_UNLIKELY(!done)) {
      for (int g = 0; g < G; ++g) {
        hn::Vec<D> again[F::in], answer[F::out];
        From::load(d, in, i + g * lanes, again);
        f.general(d, again, answer);
        To::template store<streaming>(d, answer, out, i + g * lanes);
      }
      return;
    }
  }
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) To::template store<streaming>(d, to[g], out, i + g * lanes);
}

/// Processes as many whole groups as possible; returns the end. (A separate function: a second loop over the
/// same constants would take their registers.)
template <class From, class To, bool streaming, class F, class D, class T>
static HWY_NOINLINE std::size_t map_groups(D d, const F& f, View<const T, F::in> in, View<T, F::out> out,
                                           std::size_t i, std::size_t end) {
  const std::size_t step = F::group * hn::Lanes(d);
  for (; i + step <= end; i += step) {
    if constexpr (streaming) From::prefetch(in, i, F::group * sizeof(hn::Vec<D>));
    map_registers<F::group, From, To, streaming>(d, f, in, out, i);
  }
  return i;
}

/// Processes as many whole registers as possible; returns the end.
template <class From, class To, bool streaming, class F, class D, class T>
static HWY_INLINE std::size_t map_whole(D d, const F& f, const View<const T, F::in>& in,
                                        const View<T, F::out>& out, std::size_t i, std::size_t end) {
  i = map_groups<From, To, streaming>(d, f, in, out, i, end);
  if constexpr (F::group > 1) {
    for (; i + hn::Lanes(d) <= end; i += hn::Lanes(d)) {
      map_registers<1, From, To, streaming>(d, f, in, out, i);
    }
  }
  return i;
}

/// Contiguous planes of numbers that stay in the first-level cache, for conversion between layouts and
/// registers. The stride places planes in different cache sets.
template <class T>
struct Tile {
  static constexpr std::size_t items = 64, stride = items + 64 / sizeof(T);

  template <int N, class U>
  static HWY_INLINE View<U, N> view(U* numbers) {
    View<U, N> v;
    v.layout = Layout::planes;
    for (int k = 0; k < N; ++k) v.plane[k] = numbers + k * stride;
    return v;
  }
};

/// Loads items [i, i + count) into a tile. Pads the last register with copies of an item, whose results are
/// ignored; returns the padded number of items.
template <class D, class T, int N>
static HWY_INLINE std::size_t fill_tile(D d, const View<const T, N>& in, std::size_t i, std::size_t count,
                                        T* tile) {
  constexpr std::size_t stride = Tile<T>::stride;
  gather(d, in, i, count, tile, stride);
  const std::size_t filled = (count + hn::Lanes(d) - 1) / hn::Lanes(d) * hn::Lanes(d);
  for (int k = 0; k < N; ++k) {
    for (std::size_t j = count; j < filled; ++j) tile[k * stride + j] = tile[k * stride];
  }
  return filled;
}

/// Processes items [begin, end) of any layout by tiles; put(numbers, i, count) stores the results of items
/// [i, i + count) from a tile.
template <class F, class D, class T, class Put>
static HWY_NOINLINE void map_tiles(D d, const F& f, const View<const T, F::in>& in, std::size_t begin,
                                   std::size_t end, const Put& put) {
  constexpr std::size_t stride = Tile<T>::stride;
  alignas(64) T from[F::in * stride], to[F::out * stride];
  const auto from_view = Tile<T>::template view<F::in, const T>(from);
  const auto to_view = Tile<T>::template view<F::out, T>(to);
  for (std::size_t i = begin; i < end; i += Tile<T>::items) {
    const std::size_t count = end - i < Tile<T>::items ? end - i : Tile<T>::items;
    const std::size_t filled = fill_tile(d, in, i, count, from);
    map_whole<InPlanes, InPlanes, false>(d, f, from_view, to_view, 0, filled);
    put(to, i, count);
  }
}

template <class F, class D, class T>
static HWY_INLINE void map_to_layout(D d, const F& f, const View<const T, F::in>& in,
                                     const View<T, F::out>& out, std::size_t begin, std::size_t end) {
  map_tiles(d, f, in, begin, end, [&](const T* numbers, std::size_t i, std::size_t count) HWY_ATTR {
    scatter(d, numbers, Tile<T>::stride, count, out, i);
  });
}

template <class T, int N>
static HWY_INLINE bool is_aligned(const View<T, N>& v) {
  std::size_t bits = reinterpret_cast<std::size_t>(v.plane[0]);
  if (v.layout == Layout::planes) {
    for (int k = 1; k < N; ++k) bits |= reinterpret_cast<std::size_t>(v.plane[k]);
  }
  return bits % 64 == 0;
}

/// Within one layout, using tiles only for the remainder.
template <class Way, class F, class D, class T>
static HWY_INLINE void map_directly(D d, const F& f, const View<const T, F::in>& in,
                                    const View<T, F::out>& out, const Range& range) {
  std::size_t i = range.begin;
  if constexpr (F::memory_bound && hn::MaxLanes(D()) > 1) {
    if (range.stream && is_aligned(out)) {
      i = map_whole<Way, Way, true>(d, f, in, out, i, range.end);
      hwy::FlushStream();
      if (i < range.end) map_to_layout(d, f, in, out, i, range.end);
      return;
    }
  }
  i = map_whole<Way, Way, false>(d, f, in, out, i, range.end);
  if (i < range.end) map_to_layout(d, f, in, out, i, range.end);
}

template <class F, class T>
static HWY_INLINE void map_many(const F& f, const View<const T, F::in>& in, const View<T, F::out>& out,
                                const Range& range) {
  const hn::ScalableTag<T> d;
  if (in.layout == out.layout) {
    if (in.layout == Layout::planes) return map_directly<InPlanes>(d, f, in, out, range);
    if constexpr (F::memory_bound) {
      if (in.layout == Layout::blocks) return map_directly<InBlocks>(d, f, in, out, range);
      if (in.layout == Layout::packed) return map_directly<InPacked>(d, f, in, out, range);
      return map_directly<InFull>(d, f, in, out, range);
    }
  }
  map_to_layout(d, f, in, out, range.begin, range.end);
}

/// Stores N contiguous numbers from registers of one lane in 16-byte stores: a caller that copies the result
/// in 16-byte loads would stall on 8-byte stores.
template <class D, class T, class V, int N>
static HWY_INLINE void store_row(D d, const V (&v)[N], T* out) {
  int k = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::Twice<D> two;
  if constexpr (sizeof(T) == 4) {
    const hn::Twice<decltype(two)> four;
#pragma GCC unroll 16
    for (; k + 4 <= N; k += 4) {
      const auto low = hn::Combine(two, v[k + 1], v[k]), high = hn::Combine(two, v[k + 3], v[k + 2]);
      hn::StoreU(hn::Combine(four, high, low), four, out + k);
    }
  }
#pragma GCC unroll 16
  for (; k + 2 <= N; k += 2) hn::StoreU(hn::Combine(two, v[k + 1], v[k]), two, out + k);
#endif
#pragma GCC unroll 16
  for (; k < N; ++k) hn::StoreU(v[k], d, out + k);
}

template <class F, class T>
static HWY_INLINE void map_one(const F& f, const T* in, T* out) {
  const hn::CappedTag<T, 1> d;
  hn::Vec<decltype(d)> from[1][F::in], to[1][F::out];
#pragma GCC unroll 16
  for (int k = 0; k < F::in; ++k) from[0][k] = hn::LoadU(d, in + k);
  const bool done = f.template quick<1>(d, from, to);
  if constexpr (requires { f.general(d, from[0], to[0]); }) {
    if (HWY_UNLIKELY(!done)) f.general(d, from[0], to[0]);
  }
  store_row(d, to[0], out);
}

/// The entry of the kernel table. More: the parameters of F.
template <class F, class T, class... More>
struct Mapped {
  static void one(const T* in, T* out, More... more) { map_one(F{more...}, in, out); }
  static void many(const View<const T, F::in>& in, const View<T, F::out>& out, More... more,
                   const Range& range) {
    map_many(F{more...}, in, out, range);
  }
};

/// VIETE_DEFINE_FUNCTION(pow, Pow, double) defines pow_double and pow_float of kernel.cpp, from F = Pow with
/// a parameter of type double.
#define VIETE_DEFINE_FUNCTION_OF(T, name, F, ...)                                \
  extern const Function<T, F::in, F::out __VA_OPT__(, ) __VA_ARGS__> name##_##T; \
  const Function<T, F::in, F::out __VA_OPT__(, ) __VA_ARGS__> name##_##T = {     \
      Mapped<F, T __VA_OPT__(, ) __VA_ARGS__>::one, Mapped<F, T __VA_OPT__(, ) __VA_ARGS__>::many};
#define VIETE_DEFINE_FUNCTION(name, F, ...)                            \
  VIETE_DEFINE_FUNCTION_OF(double, name, F __VA_OPT__(, ) __VA_ARGS__) \
  VIETE_DEFINE_FUNCTION_OF(float, name, F __VA_OPT__(, ) __VA_ARGS__)

// Conversions between arrays of registers and Six, Nine and Three.

template <class V>
static HWY_INLINE Six<V> six(const V (&s)[6]) {
  return {s[0], s[1], s[2], s[3], s[4], s[5]};
}
template <class V>
static HWY_INLINE void put_six(const Six<V>& m, V (&out)[6]) {
  out[0] = m.xx, out[1] = m.xy, out[2] = m.xz, out[3] = m.yy, out[4] = m.yz, out[5] = m.zz;
}
template <class V>
static HWY_INLINE Nine<V> nine(const V (&m)[9]) {
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
}
template <class V>
static HWY_INLINE void put_nine(const Nine<V>& m, V* out) {
  out[0] = m.xx, out[1] = m.xy, out[2] = m.xz;
  out[3] = m.yx, out[4] = m.yy, out[5] = m.yz;
  out[6] = m.zx, out[7] = m.zy, out[8] = m.zz;
}
template <class V>
static HWY_INLINE void put_three(const Three<V>& u, V (&out)[3]) {
  out[0] = u.x, out[1] = u.y, out[2] = u.z;
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
