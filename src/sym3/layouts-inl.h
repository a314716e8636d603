// Conversion between the layouts of view.h and registers. Included once per instruction set. Internal. (No
// #pragma once: Highway's foreach_target includes this file again for each target.)
#if defined(VIETE_SYM3_LAYOUTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_LAYOUTS_INL_H
#undef VIETE_SYM3_LAYOUTS_INL_H
#else
#define VIETE_SYM3_LAYOUTS_INL_H
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

/// Loads and stores one register per entry: entry k of items i, i + 1, ... of a view is in e[k]; i must be a
/// multiple of the lane count. prefetch() fetches later items into the cache, `bytes` bytes per entry.
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

struct InBlocks {
  template <class T>
  static HWY_INLINE std::size_t offset(std::size_t i) {
    constexpr std::size_t line = 64 / sizeof(T);
    return i / line * (6 * line) + i % line;
  }
  template <class D, class T, class V>
  static HWY_INLINE void load(D d, const View<const T, 6>& v, std::size_t i, V (&e)[6]) {
    const T* data = v.plane[0] + offset<T>(i);
#pragma GCC unroll 16
    for (int k = 0; k < 6; ++k) e[k] = hn::LoadU(d, data + k * (64 / sizeof(T)));
  }
  template <bool streaming, class D, class T, class V>
  static HWY_INLINE void store(D d, const V (&e)[6], const View<T, 6>& v, std::size_t i) {
    T* data = v.plane[0] + offset<T>(i);
#pragma GCC unroll 16
    for (int k = 0; k < 6; ++k) put<streaming>(d, e[k], data + k * (64 / sizeof(T)));
  }
  template <class T>
  static HWY_INLINE void prefetch(const View<const T, 6>& v, std::size_t i, std::size_t bytes) {
    prefetch_beyond(v.plane[0] + offset<T>(i), 6 * bytes);
  }
};

/// Entries 0 and 3 of two matrices, alternating in a register, from and to one register per entry.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE void transpose_pairs(D, [[maybe_unused]] V& a, [[maybe_unused]] V& b) {
#if HWY_TARGET != HWY_SCALAR
  const V even = hn::OddEven(hn::DupEven(b), a), odd = hn::OddEven(b, hn::DupOdd(a));
  a = even, b = odd;
#endif
}

/// Non-temporal stores of `count` registers from a buffer.
template <class D, class T>
static HWY_INLINE void stream(D d, const T* from, T* to, std::size_t count) {
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t k = 0; k < count; ++k) hn::Stream(hn::Load(d, from + k * lanes), d, to + k * lanes);
}

/// Six numbers are two triples: three-way interleaving gives entries 0, 1, 2 alternating with 3, 4, 5.
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

/// Nine numbers are three triples of numbers, and three triples are one of triples: three-way interleaving
/// twice.
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

/// The positions of Sym3's entries among all nine, and of the nine entries among those.
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

/// Copies one number from an item of a view to a row, or back.
template <class T>
struct ToRow {
  static HWY_INLINE void move(const T* item, T* row) { *row = *item; }
};
template <class T>
struct FromRow {
  static HWY_INLINE void move(T* item, const T* row) { *item = *row; }
};

/// Copies items [i, i + count) one by one between a view and rows of `stride` numbers.
template <class Direction, class T, int N, class Row>
static HWY_INLINE void transfer(const View<T, N>& v, std::size_t i, std::size_t count, Row* rows,
                                std::size_t stride) {
  constexpr std::size_t line = 64 / sizeof(T);
  if (v.layout == Layout::planes) {
    for (int k = 0; k < N; ++k) {
      for (std::size_t j = 0; j < count; ++j) Direction::move(v.plane[k] + i + j, rows + k * stride + j);
    }
  } else if (v.layout == Layout::blocks) {
    for (std::size_t j = 0; j < count; ++j) {
      T* item = v.plane[0] + (i + j) / line * N * line + (i + j) % line;
      for (int k = 0; k < N; ++k) Direction::move(item + k * line, rows + k * stride + j);
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

/// True if items of a view are contiguous rows of nine numbers.
template <class T, int N>
static HWY_INLINE bool is_nine(const View<T, N>& v) {
  return v.layout == Layout::full || (N == 9 && v.layout == Layout::packed);
}

/// Copies items [i, i + count) to rows of `stride` numbers.
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

/// Copies them back.
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
    m[3] = m[1], m[6] = m[2], m[7] = m[5];
  }
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
