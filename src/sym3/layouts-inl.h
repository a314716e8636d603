// From the layouts of view.h to registers and back. Included once per instruction set. Internal.
// (No #pragma once: Highway's foreach_target includes this text again for each target.)
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

/// Entry k of matrices i, i + 1, ... at from(k) on.
template <class D, class From, class V = hn::Vec<D>>
static HWY_INLINE Six<V> load_six(D d, From from) {
  return {hn::LoadU(d, from(0)), hn::LoadU(d, from(1)), hn::LoadU(d, from(2)),
          hn::LoadU(d, from(3)), hn::LoadU(d, from(4)), hn::LoadU(d, from(5))};
}

template <bool streaming, class D, class To, class V>
static HWY_INLINE void store_six(D d, const Six<V>& m, To to) {
  put<streaming>(d, m.xx, to(0)), put<streaming>(d, m.xy, to(1)), put<streaming>(d, m.xz, to(2));
  put<streaming>(d, m.yy, to(3)), put<streaming>(d, m.yz, to(4)), put<streaming>(d, m.zz, to(5));
}

/// How matrices [i, i + lanes) come and go, i a multiple of the lanes.
struct InPlanes {
  static constexpr bool can_stream = true;

  template <class D, class T>
  static HWY_INLINE Six<hn::Vec<D>> load(D d, const View<const T, 6>& v, std::size_t i) {
    return load_six(d, [&](int k) HWY_ATTR { return v.plane[k] + i; });
  }
  template <bool streaming, class D, class T, class V>
  static HWY_INLINE void store(D d, const Six<V>& m, const View<T, 6>& v, std::size_t i) {
    store_six<streaming>(d, m, [&](int k) HWY_ATTR { return v.plane[k] + i; });
  }
  template <class D, class T>
  static HWY_INLINE void prefetch(D, const View<const T, 6>&, std::size_t) {}
};

/// The cache lines of `bytes` bytes that are read a little later than those at p.
static HWY_INLINE void prefetch_beyond(const void* p, std::size_t bytes) {
  constexpr std::size_t distance = 2048;
  for (std::size_t k = 0; k < bytes; k += 64) hwy::Prefetch(static_cast<const char*>(p) + distance + k);
}

struct InBlocks {
  static constexpr bool can_stream = true;

  template <class T>
  static HWY_INLINE std::size_t offset(std::size_t i) {
    constexpr std::size_t line = 64 / sizeof(T);
    return i / line * (6 * line) + i % line;
  }
  template <class D, class T>
  static HWY_INLINE Six<hn::Vec<D>> load(D d, const View<const T, 6>& v, std::size_t i) {
    const T* data = v.plane[0] + offset<T>(i);
    return load_six(d, [=](int k) HWY_ATTR { return data + k * (64 / sizeof(T)); });
  }
  template <bool streaming, class D, class T, class V>
  static HWY_INLINE void store(D d, const Six<V>& m, const View<T, 6>& v, std::size_t i) {
    T* data = v.plane[0] + offset<T>(i);
    store_six<streaming>(d, m, [=](int k) HWY_ATTR { return data + k * (64 / sizeof(T)); });
  }
  template <class D, class T>
  static HWY_INLINE void prefetch(D, const View<const T, 6>& v, std::size_t i) {
    prefetch_beyond(v.plane[0] + offset<T>(i), 2 * 6 * sizeof(hn::Vec<D>));
  }
};

/// Two matrices' entries 0 and 3, alternating in a register, from and to one register for each entry.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE void transpose_pairs(D, [[maybe_unused]] V& a, [[maybe_unused]] V& b) {
#if HWY_TARGET != HWY_SCALAR
  const V even = hn::OddEven(hn::DupEven(b), a), odd = hn::OddEven(b, hn::DupOdd(a));
  a = even, b = odd;
#endif
}

/// `count` registers from where they were just put together, past the caches.
template <class D, class T>
static HWY_INLINE void stream(D d, const T* from, T* to, std::size_t count) {
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t k = 0; k < count; ++k) hn::Stream(hn::Load(d, from + k * lanes), d, to + k * lanes);
}

/// Six numbers are two triples: three-way interleaving gives entries 0, 1, 2 alternating with 3, 4, 5.
struct InPacked {
  static constexpr bool can_stream = true;

  template <class D, class T>
  static HWY_INLINE Six<hn::Vec<D>> load(D d, const View<const T, 6>& v, std::size_t i) {
    const T* data = v.plane[0] + 6 * i;
    Six<hn::Vec<D>> m;
    hn::LoadInterleaved3(d, data, m.xx, m.xy, m.xz);
    hn::LoadInterleaved3(d, data + 3 * hn::Lanes(d), m.yy, m.yz, m.zz);
    transpose_pairs(d, m.xx, m.yy), transpose_pairs(d, m.xy, m.yz), transpose_pairs(d, m.xz, m.zz);
    return m;
  }
  template <bool streaming, class D, class T, class V>
  static HWY_INLINE void store(D d, Six<V> m, const View<T, 6>& v, std::size_t i) {
    HWY_ALIGN T here[6 * hn::MaxLanes(D())];
    T* const there = v.plane[0] + 6 * i;
    T* data = streaming ? here : there;
    transpose_pairs(d, m.xx, m.yy), transpose_pairs(d, m.xy, m.yz), transpose_pairs(d, m.xz, m.zz);
    hn::StoreInterleaved3(m.xx, m.xy, m.xz, d, data);
    hn::StoreInterleaved3(m.yy, m.yz, m.zz, d, data + 3 * hn::Lanes(d));
    if constexpr (streaming) stream(d, here, there, 6);
  }
  template <class D, class T>
  static HWY_INLINE void prefetch(D, const View<const T, 6>& v, std::size_t i) {
    prefetch_beyond(v.plane[0] + 6 * i, 2 * 6 * sizeof(hn::Vec<D>));
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

struct InFull {
  static constexpr bool can_stream = true;

  template <class D, class T>
  static HWY_INLINE Six<hn::Vec<D>> load(D d, const View<const T, 6>& v, std::size_t i) {
    hn::Vec<D> e[9];
    load_nine(d, v.plane[0] + 9 * i, e);
    return {e[0], e[1], e[2], e[4], e[5], e[8]};
  }
  template <bool streaming, class D, class T, class V>
  static HWY_INLINE void store(D d, const Six<V>& m, const View<T, 6>& v, std::size_t i) {
    const V e[9] = {m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz};
    HWY_ALIGN T here[9 * hn::MaxLanes(D())];
    T* const there = v.plane[0] + 9 * i;
    store_nine(d, e, streaming ? here : there);
    if constexpr (streaming) stream(d, here, there, 9);
  }
  template <class D, class T>
  static HWY_INLINE void prefetch(D, const View<const T, 6>& v, std::size_t i) {
    prefetch_beyond(v.plane[0] + 9 * i, 2 * 9 * sizeof(hn::Vec<D>));
  }
};

/// Moves one number; the layouts below know where from and where to.
template <class T>
struct Into {
  static HWY_INLINE void move(const T* item, T* row) { *row = *item; }
};
template <class T>
struct OutOf {
  static HWY_INLINE void move(T* item, const T* row) { *item = *row; }
};

/// Where the entries of Sym3 are among all nine.
inline constexpr int entry_in_nine[9] = {0, 1, 2, 4, 5, 8};

/// Items [i, i + count) one by one between a view and rows of `stride` numbers.
template <class Way, class T, int N, class Row>
static HWY_INLINE void transfer(const View<T, N>& v, std::size_t i, std::size_t count, Row* rows,
                                std::size_t stride) {
  constexpr std::size_t line = 64 / sizeof(T);
  if (v.layout == Layout::planes) {
    for (int k = 0; k < N; ++k) {
      for (std::size_t j = 0; j < count; ++j) Way::move(v.plane[k] + i + j, rows + k * stride + j);
    }
  } else if (v.layout == Layout::blocks) {
    for (std::size_t j = 0; j < count; ++j) {
      T* item = v.plane[0] + (i + j) / line * N * line + (i + j) % line;
      for (int k = 0; k < N; ++k) Way::move(item + k * line, rows + k * stride + j);
    }
  } else if (v.layout == Layout::packed) {
    for (std::size_t j = 0; j < count; ++j) {
      T* item = v.plane[0] + N * (i + j);
#pragma GCC unroll 16
      for (int k = 0; k < N; ++k) Way::move(item + k, rows + k * stride + j);
    }
  } else {
    for (std::size_t j = 0; j < count; ++j) {
      T* item = v.plane[0] + 9 * (i + j);
#pragma GCC unroll 16
      for (int k = 0; k < N; ++k) Way::move(item + entry_in_nine[k], rows + k * stride + j);
    }
  }
}

/// Whether items of a view are nine numbers in a row.
template <class T, int N>
static HWY_INLINE bool is_nine(const View<T, N>& v) {
  return v.layout == Layout::full || (N == 9 && v.layout == Layout::packed);
}

/// Items [i, i + count) to rows of `stride` numbers.
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
  transfer<Into<T>>(v, i + j, count - j, rows + j, stride);
}

/// And back.
template <class D, class T, int N>
static HWY_NOINLINE void scatter(D d, const T* rows, std::size_t stride, std::size_t count,
                                 const View<T, N>& v, std::size_t i) {
  constexpr std::size_t lanes = hn::MaxLanes(D());
  constexpr int entry_of_six[] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  std::size_t j = 0;
  if (is_nine(v)) {
    for (; j + lanes <= count; j += lanes) {
      hn::Vec<D> e[9];
      for (int k = 0; k < 9; ++k) e[k] = hn::Load(d, rows + (N == 9 ? k : entry_of_six[k]) * stride + j);
      store_nine(d, e, v.plane[0] + 9 * (i + j));
    }
  }
  transfer<OutOf<T>>(v, i + j, count - j, rows + j, stride);
  if (v.layout != Layout::full) return;
  for (; j < count; ++j) {
    T* m = v.plane[0] + 9 * (i + j);
    m[3] = m[1], m[6] = m[2], m[7] = m[5];
  }
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
