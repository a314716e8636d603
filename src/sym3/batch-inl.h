// Applies functions of vector registers to batches in every layout of view.h. Internal.
#if defined(VIETE_SYM3_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_BATCH_INL_H
#undef VIETE_SYM3_BATCH_INL_H
#else
#define VIETE_SYM3_BATCH_INL_H
#endif

#include <hwy/cache_control.h>

#include "sym3/kernel_table.h"
#include "sym3/lanes-inl.h"
#include "sym3/view.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

template <bool streaming, class D, class V, class T>
static HWY_INLINE void put(D d, V v, T* p) {
  if constexpr (streaming) {
    hn::Stream(v, d, p);
  } else {
    hn::StoreU(v, d, p);
  }
}

/// Access to a view with the layout `planes`; InPacked and InFull have the same functions for other layouts.
/// load() and store() process items i, i + 1, ... with one item in each lane: e[k] has entry k of these
/// items. `i` must be a multiple of the number of lanes. prefetch() loads later items into the cache.
struct InPlanes {
  template <class D, class T, int N, class V>
  static HWY_INLINE void load(D d, const View<const T, N>& v, std::size_t i, V (&e)[N]) {
#pragma GCC unroll 16
    for (int k = 0; k < N; ++k) e[k] = hn::LoadU(d, v.plane[k] + i);
  }
  template <bool streaming, class D, class T, int N, class V>
  static HWY_INLINE void store(D d, const V (&e)[N], const View<T, N>& v, std::size_t i) {
#pragma GCC unroll 16
    for (int k = 0; k < N; ++k) put<streaming>(d, e[k], v.plane[k] + i);
  }
  template <class T>
  static HWY_INLINE void prefetch(const View<const T, 6>&, std::size_t, std::size_t) {}  // done by hardware
};

static HWY_INLINE void prefetch_beyond(const void* p, std::size_t bytes) {
  constexpr std::size_t distance = 2048;
  for (std::size_t k = 0; k < bytes; k += 64) hwy::Prefetch(static_cast<const char*>(p) + distance + k);
}

/// Exchanges the odd lanes of `a` with the even lanes of `b`. If two sequences alternate in `a` and `b`, `a`
/// gets the first sequence and `b` the second. A second call restores `a` and `b`.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE void transpose_pairs(D, [[maybe_unused]] V& a, [[maybe_unused]] V& b) {
#if HWY_TARGET != HWY_SCALAR
  const V even = hn::OddEven(hn::DupEven(b), a), odd = hn::OddEven(b, hn::DupOdd(a));
  a = even;
  b = odd;
#endif
}

template <class D, class T>
static HWY_INLINE void stream(D d, const T* from, T* to, std::size_t count) {
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t k = 0; k < count; ++k) hn::Stream(hn::Load(d, from + k * lanes), d, to + k * lanes);
}

/// Access to a view with the layout `packed`. Loads each matrix into two adjacent lanes: first its entries 0
/// to 2, then its entries 3 to 5. transpose_pairs() separates these two groups.
struct InPacked {
  template <class D, class T, class V>
  static HWY_INLINE void load(D d, const View<const T, 6>& v, std::size_t i, V (&e)[6]) {
    const T* data = v.plane[0] + 6 * i;
    hn::LoadInterleaved3(d, data, e[0], e[1], e[2]);
    hn::LoadInterleaved3(d, data + 3 * hn::Lanes(d), e[3], e[4], e[5]);
#pragma GCC unroll 16
    for (int k = 0; k < 3; ++k) transpose_pairs(d, e[k], e[k + 3]);
  }
  template <bool streaming, class D, class T, class V>
  static HWY_INLINE void store(D d, const V (&m)[6], const View<T, 6>& v, std::size_t i) {
    HWY_ALIGN T here[6 * hn::MaxLanes(D())];
    T* const there = v.plane[0] + 6 * i;
    T* data = streaming ? here : there;
    V e[6] = {m[0], m[1], m[2], m[3], m[4], m[5]};
#pragma GCC unroll 16
    for (int k = 0; k < 3; ++k) transpose_pairs(d, e[k], e[k + 3]);
    hn::StoreInterleaved3(e[0], e[1], e[2], d, data);
    hn::StoreInterleaved3(e[3], e[4], e[5], d, data + 3 * hn::Lanes(d));
    if constexpr (streaming) stream(d, here, there, 6);
  }
  template <class T>
  static HWY_INLINE void prefetch(const View<const T, 6>& v, std::size_t i, std::size_t bytes) {
    prefetch_beyond(v.plane[0] + 6 * i, 6 * bytes);
  }
};

/// Loads consecutive matrices of nine entries, in two steps. Highway has no function for nine entries.
template <class D, class T, class V = hn::Vec<D>>
static HWY_INLINE void load_nine(D d, const T* data, V (&e)[9]) {
  constexpr std::size_t lanes = hn::MaxLanes(D());
  HWY_ALIGN T third[3][3 * lanes];
  for (std::size_t r = 0; r < 3; ++r) {
    V a, b, c;
    hn::LoadInterleaved3(d, data + 3 * r * lanes, a, b, c);
    hn::Store(a, d, third[0] + r * lanes);
    hn::Store(b, d, third[1] + r * lanes);
    hn::Store(c, d, third[2] + r * lanes);
  }
  for (int k = 0; k < 3; ++k) hn::LoadInterleaved3(d, third[k], e[k], e[3 + k], e[6 + k]);
}

template <class D, class T, class V>
static HWY_INLINE void store_nine(D d, const V (&e)[9], T* data) {
  constexpr std::size_t lanes = hn::MaxLanes(D());
  HWY_ALIGN T third[3][3 * lanes];
  for (int k = 0; k < 3; ++k) hn::StoreInterleaved3(e[k], e[3 + k], e[6 + k], d, third[k]);
  for (std::size_t r = 0; r < 3; ++r) {
    hn::StoreInterleaved3(hn::Load(d, third[0] + r * lanes), hn::Load(d, third[1] + r * lanes),
                          hn::Load(d, third[2] + r * lanes), d, data + 3 * r * lanes);
  }
}

/// Entry k of Sym3 is entry entry_in_nine[k] of the full matrix. Entry j of the full matrix is entry
/// nine_of_entries[j] of Sym3.
inline constexpr int entry_in_nine[6] = {0, 1, 2, 4, 5, 8};
inline constexpr int nine_of_entries[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};

struct InFull {
  template <class D, class T, class V>
  static HWY_INLINE void load(D d, const View<const T, 6>& v, std::size_t i, V (&e)[6]) {
    V all[9];
    load_nine(d, v.plane[0] + 9 * i, all);
#pragma GCC unroll 16
    for (int k = 0; k < 6; ++k) e[k] = all[entry_in_nine[k]];
  }
  template <bool streaming, class D, class T, class V>
  static HWY_INLINE void store(D d, const V (&e)[6], const View<T, 6>& v, std::size_t i) {
    const V all[9] = {e[0], e[1], e[2], e[1], e[3], e[4], e[2], e[4], e[5]};
    HWY_ALIGN T here[9 * hn::MaxLanes(D())];
    T* const there = v.plane[0] + 9 * i;
    store_nine(d, all, streaming ? here : there);
    if constexpr (streaming) stream(d, here, there, 9);
  }
  template <class T>
  static HWY_INLINE void prefetch(const View<const T, 6>& v, std::size_t i, std::size_t bytes) {
    prefetch_beyond(v.plane[0] + 9 * i, 9 * bytes);
  }
};

/// The two directions of transfer(): from an item of a view to a row, or from a row to an item.
template <class T>
struct ToRow {
  static HWY_INLINE void move(const T* item, T* row) { *row = *item; }
};
template <class T>
struct FromRow {
  static HWY_INLINE void move(T* item, const T* row) { *item = *row; }
};

/// Copies items [i, i + count) one by one between a view and `rows`. rows[k * stride + j] is entry k of item
/// i + j.
template <class Direction, class T, int N, class Row>
static HWY_INLINE void transfer(const View<T, N>& v, std::size_t i, std::size_t count, Row* rows,
                                std::size_t stride) {
  if (v.layout == Layout::planes) {
    for (int k = 0; k < N; ++k) {
      for (std::size_t j = 0; j < count; ++j) Direction::move(v.plane[k] + i + j, rows + k * stride + j);
    }
  } else if (v.layout == Layout::packed) {
    for (std::size_t j = 0; j < count; ++j) {
      T* item = v.plane[0] + N * (i + j);
#pragma GCC unroll 16
      for (int k = 0; k < N; ++k) Direction::move(item + k, rows + k * stride + j);
    }
  } else if constexpr (N == 6) {
    for (std::size_t j = 0; j < count; ++j) {
      T* item = v.plane[0] + 9 * (i + j);
#pragma GCC unroll 16
      for (int k = 0; k < N; ++k) Direction::move(item + entry_in_nine[k], rows + k * stride + j);
    }
  }
}

template <class T, int N>
static HWY_INLINE bool is_nine(const View<T, N>& v) {
  return v.layout == Layout::full || (N == 9 && v.layout == Layout::packed);
}

/// Copies items [i, i + count) of a view to `rows`, like transfer(). scatter() copies in the other direction.
template <class D, class T, int N>
static HWY_NOINLINE void gather(D d, const View<const T, N>& v, std::size_t i, std::size_t count, T* rows,
                                std::size_t stride) {
  constexpr std::size_t lanes = hn::MaxLanes(D());
  std::size_t j = 0;
  if (is_nine(v)) {
    for (; j + lanes <= count; j += lanes) {
      hn::Vec<D> e[9];
      load_nine(d, v.plane[0] + 9 * (i + j), e);
      for (int k = 0; k < N; ++k) hn::Store(e[N == 9 ? k : entry_in_nine[k]], d, rows + k * stride + j);
    }
  }
  transfer<ToRow<T>>(v, i + j, count - j, rows + j, stride);
}

template <class D, class T, int N>
static HWY_NOINLINE void scatter(D d, const T* rows, std::size_t stride, std::size_t count,
                                 const View<T, N>& v, std::size_t i) {
  constexpr std::size_t lanes = hn::MaxLanes(D());
  std::size_t j = 0;
  if (is_nine(v)) {
    for (; j + lanes <= count; j += lanes) {
      hn::Vec<D> e[9];
      for (int k = 0; k < 9; ++k) e[k] = hn::Load(d, rows + (N == 9 ? k : nine_of_entries[k]) * stride + j);
      store_nine(d, e, v.plane[0] + 9 * (i + j));
    }
  }
  transfer<FromRow<T>>(v, i + j, count - j, rows + j, stride);
  if (v.layout != Layout::full) return;
  for (; j < count; ++j) {
    T* m = v.plane[0] + 9 * (i + j);
    m[3] = m[1];
    m[6] = m[2];
    m[7] = m[5];
  }
}

// A function type F for small matrices or vectors has these members:
//   in, out                        number of entries of an input item and of an output item
//   group                          number of registers that are processed together
//   memory_bound                   true if loads and stores take as long as the arithmetic. Then stores may
//                                  bypass the caches, and equal layouts need no tiles.
//   f.quick<G>(d, from, to)        for V from[G][in], to[G][out]; returns true if `to` is valid in all lanes
//   f.general(d, from, to)         for V from[in], to[out]; valid for any input. Not needed if quick() always
//                                  returns true.

/// Processes G registers of items, starting at item i. Reads the items before it writes results, so in == out
/// is allowed. The slow path reads the items again, because keeping them would occupy registers.
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

/// Processes as many whole groups as possible. Returns the index after the last processed item. This function
/// is not inline, so that the compiler can use all registers for its constants.
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

/// A buffer of planes that fits the first-level cache, for layouts that are not processed directly. With this
/// stride, the planes use different cache sets.
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

/// Copies items [i, i + count) to a tile, and fills the last register with copies of the first item. Returns
/// the number of items including these copies.
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

/// Processes items [begin, end) of any layout in tiles. put(numbers, i, count) must store the results of
/// items [i, i + count).
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

/// Processes items without tiles. The input and the output must have the layout that `Access` accesses. If
/// the last items do not fill a register, they are processed in a tile.
template <class Access, class F, class D, class T>
static HWY_INLINE void map_directly(D d, const F& f, const View<const T, F::in>& in,
                                    const View<T, F::out>& out, const Range& range) {
  std::size_t i = range.begin;
  if constexpr (F::memory_bound && hn::MaxLanes(D()) > 1) {
    if (range.stream && is_aligned(out)) {
      i = map_whole<Access, Access, true>(d, f, in, out, i, range.end);
      hwy::FlushStream();
      if (i < range.end) map_to_layout(d, f, in, out, i, range.end);
      return;
    }
  }
  i = map_whole<Access, Access, false>(d, f, in, out, i, range.end);
  if (i < range.end) map_to_layout(d, f, in, out, i, range.end);
}

template <class F, class T>
static HWY_INLINE void map_many(const F& f, const View<const T, F::in>& in, const View<T, F::out>& out,
                                const Range& range) {
  const hn::ScalableTag<T> d;
  if (in.layout == out.layout) {
    if (in.layout == Layout::planes) return map_directly<InPlanes>(d, f, in, out, range);
    if constexpr (F::memory_bound) {
      if (in.layout == Layout::packed) return map_directly<InPacked>(d, f, in, out, range);
      return map_directly<InFull>(d, f, in, out, range);
    }
  }
  map_to_layout(d, f, in, out, range.begin, range.end);
}

/// Stores the only lane of N registers as N contiguous numbers. Stores 16 bytes at a time, because a later
/// load of 16 bytes is slow if several smaller stores have written them.
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

/// A function type whose lanes are not all valid: F::lanes(d, from, to) returns the valid lanes, and
/// F::by_jacobi(from, to) computes each other lane.
template <class F>
struct WithFallback {
  static constexpr int in = F::in, out = F::out, group = 1;
  static constexpr bool memory_bound = false;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&from)[G][in], V (&to)[G][out]) const {
    return hn::AllTrue(d, F::lanes(d, from[0], to[0]));
  }
  template <class D, class V>
  HWY_INLINE void general(D d, const V (&from)[in], V (&to)[out]) const {
    const auto ok = F::lanes(d, from, to);
    replace_lanes(d, hn::Not(ok), from, to, F::by_jacobi);
  }
};

/// The functions of F for the kernel table. `More` are the types of F's parameters.
template <class F, class T, class... More>
struct Mapped {
  static void one(const T* in, T* out, More... more) { map_one(F{more...}, in, out); }
  static void many(const View<const T, F::in>& in, const View<T, F::out>& out, More... more,
                   const Range& range) {
    map_many(F{more...}, in, out, range);
  }
};

/// VIETE_DEFINE_FUNCTION(pow, Pow, double) defines pow_double and pow_float of kernel.cpp from the function
/// type Pow, which has a parameter of type double.
#define VIETE_DEFINE_FUNCTION_OF(T, name, F, ...)                                \
  extern const Function<T, F::in, F::out __VA_OPT__(, ) __VA_ARGS__> name##_##T; \
  const Function<T, F::in, F::out __VA_OPT__(, ) __VA_ARGS__> name##_##T = {     \
      Mapped<F, T __VA_OPT__(, ) __VA_ARGS__>::one, Mapped<F, T __VA_OPT__(, ) __VA_ARGS__>::many};
#define VIETE_DEFINE_FUNCTION(name, F, ...)                            \
  VIETE_DEFINE_FUNCTION_OF(double, name, F __VA_OPT__(, ) __VA_ARGS__) \
  VIETE_DEFINE_FUNCTION_OF(float, name, F __VA_OPT__(, ) __VA_ARGS__)

template <class V>
static HWY_INLINE Six<V> six(const V (&s)[6]) {
  return {s[0], s[1], s[2], s[3], s[4], s[5]};
}
template <class V>
static HWY_INLINE void put_six(const Six<V>& m, V (&out)[6]) {
  out[0] = m.xx;
  out[1] = m.xy;
  out[2] = m.xz;
  out[3] = m.yy;
  out[4] = m.yz;
  out[5] = m.zz;
}
template <class V>
static HWY_INLINE Nine<V> nine(const V (&m)[9]) {
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
}
template <class V>
static HWY_INLINE void put_nine(const Nine<V>& m, V* out) {
  out[0] = m.xx;
  out[1] = m.xy;
  out[2] = m.xz;
  out[3] = m.yx;
  out[4] = m.yy;
  out[5] = m.yz;
  out[6] = m.zx;
  out[7] = m.zy;
  out[8] = m.zz;
}
template <class V>
static HWY_INLINE void put_three(const Three<V>& u, V (&out)[3]) {
  out[0] = u.x;
  out[1] = u.y;
  out[2] = u.z;
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
