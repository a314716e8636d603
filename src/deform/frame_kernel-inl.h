// From weights and logs to positions in vector registers: included by frame_kernel.cpp for each instruction
// set. Internal. (No #pragma once: see sym3/exp-inl.h.)
#if defined(VIETE_DEFORM_FRAME_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_DEFORM_FRAME_KERNEL_INL_H
#undef VIETE_DEFORM_FRAME_KERNEL_INL_H
#else
#define VIETE_DEFORM_FRAME_KERNEL_INL_H
#endif

#include "deform/frame_jobs.h"
#include "sym3/exp-inl.h"
#include "sym3/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = viete::sym3::HWY_NAMESPACE;

// Number of vectors blended at once: sums and inputs must fit the registers.
#if HWY_TARGET <= HWY_AVX3
constexpr int vectors_at_once = 2;
#else
constexpr int vectors_at_once = 1;
#endif

template <class T>
using Tag = hn::CappedTag<T, tile_lanes<T>>;

// Prefetch distance of weights in lines: a row takes 12 cycles at two multiply-adds of 16 lanes per cycle,
// memory access some 300.
constexpr std::size_t lines_ahead = HWY_TARGET <= HWY_AVX3 ? 32 : 16;

template <class T, std::size_t Columns>
using Sums = hn::Vec<Tag<T>>[vectors_at_once][Columns];

// Index of lane group g of a run in an array of tiles with `rows` lines each: tiles are cut into vectors.
template <class T>
static HWY_INLINE std::size_t index_of(std::size_t group, std::size_t rows) {
  const std::size_t lane = group * hn::Lanes(Tag<T>());
  return lane / tile_lanes<T> * rows * tile_lanes<T> + lane % tile_lanes<T>;
}

// Prefetches, in an array with `rows` lines per tile, the data of the vector that follows this one.
template <class T>
static HWY_INLINE void prefetch_next(const T* array, std::size_t vector, std::size_t rows) {
  const T* next = array + index_of<T>(vector + vectors_at_once, rows);
#pragma GCC unroll 24
  for (std::size_t c = 0; c < rows; ++c) hwy::Prefetch(next + c * tile_lanes<T>);
}

template <class T, std::size_t Columns>
static HWY_INLINE void load_base(const TileRun<T>& run, std::size_t group, Sums<T, Columns>& s) {
  const Tag<T> d;
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
    const T* base = run.base ? run.base + index_of<T>(group + v, Columns) : nullptr;
    if (base) prefetch_next<T>(run.base, group + v, Columns);
#pragma GCC unroll 24
    for (std::size_t c = 0; c < Columns; ++c) {
      s[v][c] = base ? hn::Load(d, base + c * tile_lanes<T>) : hn::Zero(d);
    }
  }
}

// The product of the frame: sums += weights * table, with the sums in registers.
template <bool Listed, class T, std::size_t Columns>
static HWY_INLINE void blend_rows(const TileRun<T>& run, std::size_t group, Sums<T, Columns>& sums) {
  const Tag<T> d;
  using V = hn::Vec<Tag<T>>;
  V s[vectors_at_once][Columns];
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
#pragma GCC unroll 24
    for (std::size_t c = 0; c < Columns; ++c) s[v][c] = sums[v][c];
  }
  const T *weights[vectors_at_once], *next[vectors_at_once];
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
    weights[v] = run.weights + index_of<T>(group + v, run.rows);
    next[v] = run.weights + index_of<T>(group + vectors_at_once + v, run.rows);
  }
  const auto add_row = [&](std::size_t j, const T* const(&soon)[vectors_at_once], std::size_t line) HWY_ATTR
      __attribute__((always_inline)) {
    const T* entry = run.table + Columns * (Listed ? run.listed[j] : j);
    V w[vectors_at_once];
#pragma GCC unroll 2
    for (int v = 0; v < vectors_at_once; ++v) {
      hwy::Prefetch(soon[v] + line * tile_lanes<T>);
      w[v] = hn::Load(d, weights[v] + j * tile_lanes<T>);
    }
#pragma GCC unroll 24
    for (std::size_t c = 0; c < Columns; ++c) {
      const V t = hn::Set(d, entry[c]);
#pragma GCC unroll 2
      for (int v = 0; v < vectors_at_once; ++v) s[v][c] = hn::MulAdd(w[v], t, s[v][c]);
    }
  };
  std::size_t j = 0;
  for (; j + lines_ahead < run.rows; ++j) add_row(j, weights, j + lines_ahead);
  for (std::size_t line = 0; j < run.rows; ++j, ++line) add_row(j, next, line);
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
#pragma GCC unroll 24
    for (std::size_t c = 0; c < Columns; ++c) sums[v][c] = s[v][c];
  }
}

template <class T, std::size_t Columns>
static HWY_INLINE void blend_group(const TileRun<T>& run, std::size_t group, Sums<T, Columns>& sums) {
  load_base<T, Columns>(run, group, sums);
  if (run.listed) return blend_rows<true, T, Columns>(run, group, sums);
  blend_rows<false, T, Columns>(run, group, sums);
}

template <class T>
static HWY_INLINE std::size_t group_count(const TileRun<T>& run) {
  return run.tiles * tile_lanes<T> / hn::Lanes(Tag<T>());
}

template <class T, std::size_t Columns>
static void blend_tiles(const TileRun<T>& run, T* sums) {
  const Tag<T> d;
  for (std::size_t g = 0; g < group_count(run); g += vectors_at_once) {
    Sums<T, Columns> s;
    blend_group<T, Columns>(run, g, s);
    for (int v = 0; v < vectors_at_once; ++v) {
      T* out = sums + index_of<T>(g + v, Columns);
#pragma GCC unroll 24
      for (std::size_t c = 0; c < Columns; ++c) hn::Store(s[v][c], d, out + c * tile_lanes<T>);
    }
  }
}

template <class T>
using Vector3 = lanes::Three<hn::Vec<Tag<T>>>;

template <class T>
static HWY_INLINE Vector3<T> load_rest(const T* rest, std::size_t group) {
  const Tag<T> d;
  const T* at = rest + index_of<T>(group, 3);
  prefetch_next(rest, group, 3);
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

template <std::size_t WithMean, class T, std::size_t Columns>
static HWY_INLINE void add_mean(const TileRun<T>& run, Sums<T, Columns>& s) {
  if (!run.mean) return;
  const Tag<T> d;
#pragma GCC unroll 24
  for (std::size_t c = 0; c < WithMean; ++c) {
    const auto mean = hn::Set(d, run.mean[c]);
#pragma GCC unroll 2
    for (int v = 0; v < vectors_at_once; ++v) s[v][c] = hn::Add(s[v][c], mean);
  }
}

template <std::size_t Center, class T, std::size_t Columns>
static HWY_INLINE void share_sums(const TileRun<T>& run, const T* rest, std::size_t group,
                                  Sums<T, Columns>& s) {
  const Tag<T> d;
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
    const auto share = hn::Load(d, run.shares + index_of<T>(group + v, 1));
    const auto kept = hn::Sub(hn::Set(d, 1), share);
    const T* x = rest + index_of<T>(group + v, 3);
#pragma GCC unroll 24
    for (std::size_t c = 0; c < Columns; ++c) {
      s[v][c] = hn::Mul(s[v][c], share);
      if (c >= Center) s[v][c] = hn::MulAdd(kept, hn::Load(d, x + (c - Center) * tile_lanes<T>), s[v][c]);
    }
  }
}

template <class T>
static HWY_INLINE Vector3<T> load_offset(const TileRun<T>& run, const T* offsets, std::size_t group) {
  const Vector3<T> o = load_rest(offsets, group);
  if (!run.shares) return o;
  const auto share = hn::Load(Tag<T>(), run.shares + index_of<T>(group, 1));
  return {hn::Mul(o.x, share), hn::Mul(o.y, share), hn::Mul(o.z, share)};
}

// Each step processes all vectors of a batch before the next step starts, which hides latency.
#if HWY_TARGET <= HWY_AVX3
template <class T>
using Batch = lanes::Two<hn::Vec<Tag<T>>>;

template <class T, std::size_t Columns>
static HWY_INLINE Batch<T> column(const Sums<T, Columns>& s, std::size_t c) {
  return {s[0][c], s[1][c]};
}
template <class T>
static HWY_INLINE lanes::Three<Batch<T>> load_rests(const T* rest, std::size_t group) {
  return lanes::together(load_rest(rest, group), load_rest(rest, group + 1));
}
template <class T>
static HWY_INLINE lanes::Three<Batch<T>> load_offsets(const TileRun<T>& run, const T* offsets,
                                                      std::size_t group) {
  return lanes::together(load_offset(run, offsets, group), load_offset(run, offsets, group + 1));
}
template <class T>
static HWY_INLINE void store_positions(const lanes::Three<Batch<T>>& p, std::size_t group, T* out) {
  store_position(lanes::first(p), group, out), store_position(lanes::second(p), group + 1, out);
}
#else
template <class T>
using Batch = hn::Vec<Tag<T>>;

template <class T, std::size_t Columns>
static HWY_INLINE Batch<T> column(const Sums<T, Columns>& s, std::size_t c) {
  return s[0][c];
}
template <class T>
static HWY_INLINE Vector3<T> load_rests(const T* rest, std::size_t group) {
  return load_rest(rest, group);
}
template <class T>
static HWY_INLINE Vector3<T> load_offsets(const TileRun<T>& run, const T* offsets, std::size_t group) {
  return load_offset(run, offsets, group);
}
template <class T>
static HWY_INLINE void store_positions(const Vector3<T>& p, std::size_t group, T* out) {
  store_position(p, group, out);
}
#endif

// How sums of rows, by column, move vertices from their rest position x, or from their offset o: one per
// RowForm.
struct ByLogs {
  static constexpr RowShape shape = log_shape;

  template <class D, class Column, class Rest, class Offset>
  HWY_INLINE auto operator()(D d, const Column& at, const Rest&, const Offset& offset) const {
    const lanes::Six log{at(0), at(1), at(2), at(3), at(4), at(5)};
    const lanes::Three u = lanes::times(lanes::exp_lanes(d, log), offset());
    const lanes::Three turn{at(6), at(7), at(8)};
    const lanes::Three p = lanes::rotate_lanes(d, turn, u);
    return lanes::Three{Add(p.x, at(9)), Add(p.y, at(10)), Add(p.z, at(11))};
  }
};

struct ByMaps {
  static constexpr RowShape shape = map_shape;

  template <class D, class Column, class Rest, class Offset>
  HWY_INLINE auto operator()(D, const Column& at, const Rest& rest, const Offset&) const {
    const lanes::Three x = rest();
    const auto moved = [&](auto from, std::size_t r) HWY_ATTR {
      const auto turned = lanes::sum_of_products(at(3 * r), x.x, at(3 * r + 1), x.y, at(3 * r + 2), x.z);
      return Add(from, Add(turned, at(9 + r)));
    };
    return lanes::Three{moved(x.x, 0), moved(x.y, 1), moved(x.z, 2)};
  }
};

struct ByPositions {
  static constexpr RowShape shape = position_shape;

  template <class D, class Column, class Rest, class Offset>
  HWY_INLINE auto operator()(D, const Column& at, const Rest&, const Offset& offset) const {
    const lanes::Three o = offset();
    return lanes::Three{Add(at(0), o.x), Add(at(1), o.y), Add(at(2), o.z)};
  }
};

template <class T, class Move>
static void place_tiles(const TileRun<T>& run, const T* rest, const T* offsets, T* out) {
  constexpr RowShape shape = Move::shape;
  const Tag<T> d;
  for (std::size_t g = 0; g < group_count(run); g += vectors_at_once) {
    Sums<T, shape.columns> s;
    blend_group<T, shape.columns>(run, g, s);
    add_mean<shape.with_mean, T, shape.columns>(run, s);
    if (run.shares) share_sums<shape.center, T, shape.columns>(run, rest, g, s);
    const auto sum = [&](std::size_t c) HWY_ATTR { return column<T, shape.columns>(s, c); };
    const auto at_rest = [&]() HWY_ATTR { return load_rests(rest, g); };
    const auto offset = [&]() HWY_ATTR { return load_offsets(run, offsets, g); };
    store_positions<T>(Move()(d, sum, at_rest, offset), g, out);
  }
}

template <class Move>
static constexpr TileKernel tile_kernel() {
  return {Move::shape.columns, blend_tiles<float, Move::shape.columns>, place_tiles<float, Move>};
}

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
