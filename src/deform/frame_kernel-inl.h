// From weights and logs to positions in vector registers: included by frame_kernel.cpp for each instruction
// set. Internal. (No #pragma once: see sym3/exp-inl.h.)
#if defined(VIETE_DEFORM_FRAME_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_DEFORM_FRAME_KERNEL_INL_H
#undef VIETE_DEFORM_FRAME_KERNEL_INL_H
#else
#define VIETE_DEFORM_FRAME_KERNEL_INL_H
#endif

#include "deform/frame_kernel.h"
#include "sym3/exp-inl.h"
#include "sym3/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = viete::sym3::HWY_NAMESPACE;

// How many vectors are blended at once: their sums and what feeds them must fit the registers.
#if HWY_TARGET <= HWY_AVX3
constexpr int vectors_at_once = 2;
#else
constexpr int vectors_at_once = 1;
#endif

template <class T>
using Tag = hn::CappedTag<T, tile_lanes<T>>;

template <class T, std::size_t Columns>
using Sums = hn::Vec<Tag<T>>[vectors_at_once][Columns];

// Where lane group g of a run lies in an array of tiles with `rows` lines each: tiles are cut into vectors.
template <class T>
static HWY_INLINE std::size_t place(std::size_t group, std::size_t rows) {
  const std::size_t lane = group * hn::Lanes(Tag<T>());
  return lane / tile_lanes<T> * rows * tile_lanes<T> + lane % tile_lanes<T>;
}

template <class T, std::size_t Columns>
static HWY_INLINE void load_base(const TileRun<T>& run, std::size_t group, Sums<T, Columns>& s) {
  const Tag<T> d;
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
    const T* base = run.base ? run.base + place<T>(group + v, Columns) : nullptr;
#pragma GCC unroll 12
    for (std::size_t c = 0; c < Columns; ++c) {
      s[v][c] = base ? hn::Load(d, base + c * tile_lanes<T>) : hn::Zero(d);
    }
  }
}

// The product of the frame: sums += weights * table, the sums held in registers.
template <bool Listed, class T, std::size_t Columns>
static HWY_INLINE void blend_rows(const TileRun<T>& run, std::size_t group, Sums<T, Columns>& sums) {
  const Tag<T> d;
  using V = hn::Vec<Tag<T>>;
  constexpr std::size_t ahead = 1024 / sizeof(T);
  load_base<T, Columns>(run, group, sums);
  V s[vectors_at_once][Columns];
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
#pragma GCC unroll 12
    for (std::size_t c = 0; c < Columns; ++c) s[v][c] = sums[v][c];
  }
  const T* weights[vectors_at_once];
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) weights[v] = run.weights + place<T>(group + v, run.rows);
  for (std::size_t j = 0; j < run.rows; ++j) {
    const T* entry = run.table + Columns * (Listed ? run.listed[j] : j);
    V w[vectors_at_once];
#pragma GCC unroll 2
    for (int v = 0; v < vectors_at_once; ++v) {
      hwy::Prefetch(weights[v] + j * tile_lanes<T> + ahead);
      w[v] = hn::Load(d, weights[v] + j * tile_lanes<T>);
    }
#pragma GCC unroll 12
    for (std::size_t c = 0; c < Columns; ++c) {
      const V t = hn::Set(d, entry[c]);
#pragma GCC unroll 2
      for (int v = 0; v < vectors_at_once; ++v) s[v][c] = hn::MulAdd(w[v], t, s[v][c]);
    }
  }
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
#pragma GCC unroll 12
    for (std::size_t c = 0; c < Columns; ++c) sums[v][c] = s[v][c];
  }
}

template <class T, std::size_t Columns>
static HWY_INLINE void blend_group(const TileRun<T>& run, std::size_t group, Sums<T, Columns>& sums) {
  if (run.listed) return blend_rows<true, T, Columns>(run, group, sums);
  blend_rows<false, T, Columns>(run, group, sums);
}

template <class T>
static HWY_INLINE std::size_t group_count(const TileRun<T>& run) {
  return run.tiles * tile_lanes<T> / hn::Lanes(Tag<T>());
}

template <class T>
static void blend_tiles(const TileRun<T>& run, T* sums) {
  const Tag<T> d;
  for (std::size_t g = 0; g < group_count(run); g += vectors_at_once) {
    Sums<T, log_size> s;
    blend_group<T, log_size>(run, g, s);
    for (int v = 0; v < vectors_at_once; ++v) {
      T* out = sums + place<T>(g + v, log_size);
#pragma GCC unroll 12
      for (std::size_t c = 0; c < log_size; ++c) hn::Store(s[v][c], d, out + c * tile_lanes<T>);
    }
  }
}

template <class T>
using Vector3 = lanes::Three<hn::Vec<Tag<T>>>;

template <class T>
static HWY_INLINE Vector3<T> load_offset(const T* offsets, std::size_t group) {
  const Tag<T> d;
  const T* at = offsets + place<T>(group, position_size);
  return {hn::Load(d, at), hn::Load(d, at + tile_lanes<T>), hn::Load(d, at + 2 * tile_lanes<T>)};
}

template <class T>
static HWY_INLINE void store_position(const Vector3<T>& p, std::size_t group, T* out) {
#if HWY_TARGET == HWY_SCALAR
  T* at = out + 4 * group;
  at[0] = hn::GetLane(p.x), at[1] = hn::GetLane(p.y), at[2] = hn::GetLane(p.z), at[3] = at[0];
#else
  const Tag<T> d;
  hn::StoreInterleaved4(p.x, p.y, p.z, p.x, d, out + 4 * group * hn::Lanes(d));
#endif
}

template <class T, class Nine>
static HWY_INLINE Vector3<T> rotated(const Nine& r, const Vector3<T>& u) {
  return {lanes::sum_of_products(r.xx, u.x, r.xy, u.y, r.xz, u.z),
          lanes::sum_of_products(r.yx, u.x, r.yy, u.y, r.yz, u.z),
          lanes::sum_of_products(r.zx, u.x, r.zy, u.y, r.zz, u.z)};
}

template <class T, class Six>
static HWY_INLINE Vector3<T> stretched(const Six& m, const Vector3<T>& u) {
  return {lanes::sum_of_products(m.xx, u.x, m.xy, u.y, m.xz, u.z),
          lanes::sum_of_products(m.xy, u.x, m.yy, u.y, m.yz, u.z),
          lanes::sum_of_products(m.xz, u.x, m.yz, u.y, m.zz, u.z)};
}

template <class T>
static HWY_INLINE void add_mean(const TileRun<T>& run, Sums<T, log_size>& s) {
  if (!run.mean) return;
  const Tag<T> d;
#pragma GCC unroll 12
  for (std::size_t c = 0; c < centre_column; ++c) {
    const auto mean = hn::Set(d, run.mean[c]);
#pragma GCC unroll 2
    for (int v = 0; v < vectors_at_once; ++v) s[v][c] = hn::Add(s[v][c], mean);
  }
}

// Two vectors go through the same steps in turn: that hides the latency of each.
template <class T, int G, class V = hn::Vec<Tag<T>>>
static HWY_INLINE void exp_at_once(const lanes::Six<V> (&log)[G], lanes::Six<V> (&out)[G]) {
  const Tag<T> d;
  if constexpr (G == 2) {
    const auto both = lanes::exp_lanes(d, lanes::together(log[0], log[1]));
    out[0] = lanes::first(both), out[1] = lanes::second(both);
  } else {
    for (int v = 0; v < G; ++v) out[v] = lanes::exp_lanes(d, log[v]);
  }
}

template <class T>
static void deform_tiles(const TileRun<T>& run, const T* offsets, T* out) {
  const Tag<T> d;
  using V = hn::Vec<Tag<T>>;
  for (std::size_t g = 0; g < group_count(run); g += vectors_at_once) {
    Sums<T, log_size> s;
    blend_group<T, log_size>(run, g, s);
    add_mean<T>(run, s);
    lanes::Six<V> log[vectors_at_once], stretch[vectors_at_once];
#pragma GCC unroll 2
    for (int v = 0; v < vectors_at_once; ++v) log[v] = {s[v][0], s[v][1], s[v][2], s[v][3], s[v][4], s[v][5]};
    exp_at_once<T>(log, stretch);
#pragma GCC unroll 2
    for (int v = 0; v < vectors_at_once; ++v) {
      const Vector3<T> u = stretched<T>(stretch[v], load_offset(offsets, g + v));
      const Vector3<T> turn{s[v][6], s[v][7], s[v][8]};
      const Vector3<T> p = rotated<T>(lanes::exp_rotation_lanes(d, turn), u);
      store_position<T>({hn::Add(p.x, s[v][9]), hn::Add(p.y, s[v][10]), hn::Add(p.z, s[v][11])}, g + v, out);
    }
  }
}

template <class T>
static void move_tiles(const TileRun<T>& run, const T* offsets, T* out) {
  for (std::size_t g = 0; g < group_count(run); g += vectors_at_once) {
    Sums<T, position_size> s;
    blend_group<T, position_size>(run, g, s);
    for (int v = 0; v < vectors_at_once; ++v) {
      const Vector3<T> offset = load_offset(offsets, g + v);
      store_position<T>({hn::Add(s[v][0], offset.x), hn::Add(s[v][1], offset.y), hn::Add(s[v][2], offset.z)},
                        g + v, out);
    }
  }
}

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
