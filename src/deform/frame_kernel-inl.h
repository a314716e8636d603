// Vector code of the frame. frame_kernel.cpp includes this file once per instruction set, see sym3/exp-inl.h.
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

// The number of vectors blended at once. The sums and inputs of these vectors must fit into the registers.
#if HWY_TARGET <= HWY_AVX3
constexpr int vectors_at_once = 2;
#else
constexpr int vectors_at_once = 1;
#endif

inline constexpr std::size_t line_lanes = weights::tile_lanes<float>;
using Tag = hn::CappedTag<float, line_lanes>;

// Prefetch distance of weights, in cache lines. A row takes about 12 cycles, a memory access about 300.
constexpr std::size_t lines_ahead = HWY_TARGET <= HWY_AVX3 ? 32 : 16;

template <std::size_t Columns>
using Sums = hn::Vec<Tag>[vectors_at_once][Columns];

// Returns the index at which vector `group` begins in an array of tiles with `rows` cache lines each.
static HWY_INLINE std::size_t index_of(std::size_t group, std::size_t rows) {
  const std::size_t lane = group * hn::Lanes(Tag());
  return lane / line_lanes * rows * line_lanes + lane % line_lanes;
}

static HWY_INLINE void prefetch_next(const float* array, std::size_t vector, std::size_t rows) {
  // `next` is an integer, because a pointer must not point beyond the array.
  const auto next = reinterpret_cast<std::uintptr_t>(array + index_of(vector, rows));
  const std::size_t ahead = index_of(vector + vectors_at_once, rows) - index_of(vector, rows);
#pragma GCC unroll 24
  for (std::size_t c = 0; c < rows; ++c)
    hwy::Prefetch(reinterpret_cast<const float*>(next + sizeof(float) * (ahead + c * line_lanes)));
}

template <std::size_t Columns>
static HWY_INLINE void load_base(const TileRun& run, std::size_t group, Sums<Columns>& s) {
  const Tag d;
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
    const float* base = run.base ? run.base + index_of(group + v, Columns) : nullptr;
    if (base) prefetch_next(run.base, group + v, Columns);
#pragma GCC unroll 24
    for (std::size_t c = 0; c < Columns; ++c) {
      s[v][c] = base ? hn::Load(d, base + c * line_lanes) : hn::Zero(d);
    }
  }
}

// Computes sums += weights * table, with the sums in registers.
template <bool Listed, std::size_t Columns>
static HWY_INLINE void blend_rows(const TileRun& run, std::size_t group, Sums<Columns>& sums) {
  const Tag d;
  using V = hn::Vec<Tag>;
  V s[vectors_at_once][Columns];
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
#pragma GCC unroll 24
    for (std::size_t c = 0; c < Columns; ++c) s[v][c] = sums[v][c];
  }
  const float *weights[vectors_at_once], *next[vectors_at_once];
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
    weights[v] = run.weights + index_of(group + v, run.rows);
    next[v] = run.weights + index_of(group + vectors_at_once + v, run.rows);
  }
  const auto add_row = [&](std::size_t j, const float* const(&soon)[vectors_at_once], std::size_t line)
      HWY_ATTR __attribute__((always_inline)) {
    const float* entry = run.table + Columns * (Listed ? run.listed[j] : j);
    V w[vectors_at_once];
#pragma GCC unroll 2
    for (int v = 0; v < vectors_at_once; ++v) {
      hwy::Prefetch(soon[v] + line * line_lanes);
      w[v] = hn::Load(d, weights[v] + j * line_lanes);
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

template <std::size_t Columns>
static HWY_INLINE void blend_group(const TileRun& run, std::size_t group, Sums<Columns>& sums) {
  load_base<Columns>(run, group, sums);
  if (run.listed) return blend_rows<true, Columns>(run, group, sums);
  blend_rows<false, Columns>(run, group, sums);
}

static HWY_INLINE std::size_t group_count(const TileRun& run) {
  return run.tiles * line_lanes / hn::Lanes(Tag());
}

template <std::size_t Columns>
static void blend_tiles(const TileRun& run, float* sums) {
  const Tag d;
  for (std::size_t g = 0; g < group_count(run); g += vectors_at_once) {
    Sums<Columns> s;
    blend_group<Columns>(run, g, s);
    for (int v = 0; v < vectors_at_once; ++v) {
      float* out = sums + index_of(g + v, Columns);
#pragma GCC unroll 24
      for (std::size_t c = 0; c < Columns; ++c) hn::Store(s[v][c], d, out + c * line_lanes);
    }
  }
}

using Vector3 = lanes::Three<hn::Vec<Tag>>;

static HWY_INLINE Vector3 load_rest(const float* rest, std::size_t group) {
  const Tag d;
  const float* at = rest + index_of(group, 3);
  prefetch_next(rest, group, 3);
  return {hn::Load(d, at), hn::Load(d, at + line_lanes), hn::Load(d, at + 2 * line_lanes)};
}

static HWY_INLINE void store_position(const Vector3& p, std::size_t group, float* out) {
#if HWY_TARGET == HWY_SCALAR
  float* at = out + 4 * group;
  at[0] = hn::GetLane(p.x);
  at[1] = hn::GetLane(p.y);
  at[2] = hn::GetLane(p.z);
  at[3] = at[0];
#else
  const Tag d;
  hn::StoreInterleaved4(p.x, p.y, p.z, p.x, d, out + 4 * group * hn::Lanes(d));
#endif
}

template <std::size_t WithMean, std::size_t Columns>
static HWY_INLINE void add_mean(const TileRun& run, Sums<Columns>& s) {
  if (!run.mean) return;
  const Tag d;
#pragma GCC unroll 24
  for (std::size_t c = 0; c < WithMean; ++c) {
    const auto mean = hn::Set(d, run.mean[c]);
#pragma GCC unroll 2
    for (int v = 0; v < vectors_at_once; ++v) s[v][c] = hn::Add(s[v][c], mean);
  }
}

template <std::size_t Center, std::size_t Columns>
static HWY_INLINE void share_sums(const TileRun& run, const float* rest, std::size_t group,
                                  Sums<Columns>& s) {
  const Tag d;
#pragma GCC unroll 2
  for (int v = 0; v < vectors_at_once; ++v) {
    const auto share = hn::Load(d, run.shares + index_of(group + v, 1));
    const auto kept = hn::Sub(hn::Set(d, 1), share);
    const float* x = rest + index_of(group + v, 3);
#pragma GCC unroll 24
    for (std::size_t c = 0; c < Columns; ++c) {
      s[v][c] = hn::Mul(s[v][c], share);
      if (c >= Center) s[v][c] = hn::MulAdd(kept, hn::Load(d, x + (c - Center) * line_lanes), s[v][c]);
    }
  }
}

static HWY_INLINE Vector3 load_offset(const TileRun& run, const float* offsets, std::size_t group) {
  const Vector3 o = load_rest(offsets, group);
  if (!run.shares) return o;
  const auto share = hn::Load(Tag(), run.shares + index_of(group, 1));
  return {hn::Mul(o.x, share), hn::Mul(o.y, share), hn::Mul(o.z, share)};
}

// A batch has vectors_at_once vectors. Each operation runs for the whole batch, to hide latency.
#if HWY_TARGET <= HWY_AVX3
using Batch = lanes::Two<hn::Vec<Tag>>;

template <std::size_t Columns>
static HWY_INLINE Batch column(const Sums<Columns>& s, std::size_t c) {
  return {s[0][c], s[1][c]};
}
static HWY_INLINE lanes::Three<Batch> load_rests(const float* rest, std::size_t group) {
  return lanes::together(load_rest(rest, group), load_rest(rest, group + 1));
}
static HWY_INLINE lanes::Three<Batch> load_offsets(const TileRun& run, const float* offsets,
                                                   std::size_t group) {
  return lanes::together(load_offset(run, offsets, group), load_offset(run, offsets, group + 1));
}
static HWY_INLINE void store_positions(const lanes::Three<Batch>& p, std::size_t group, float* out) {
  store_position(lanes::first(p), group, out);
  store_position(lanes::second(p), group + 1, out);
}
#else
using Batch = hn::Vec<Tag>;

template <std::size_t Columns>
static HWY_INLINE Batch column(const Sums<Columns>& s, std::size_t c) {
  return s[0][c];
}
static HWY_INLINE Vector3 load_rests(const float* rest, std::size_t group) {
  return load_rest(rest, group);
}
static HWY_INLINE Vector3 load_offsets(const TileRun& run, const float* offsets, std::size_t group) {
  return load_offset(run, offsets, group);
}
static HWY_INLINE void store_positions(const Vector3& p, std::size_t group, float* out) {
  store_position(p, group, out);
}
#endif

// For each RowForm without moments, a functor that computes positions from the sums and from x or o of
// RowForm.
struct ByLogs {
  static constexpr pose::RowShape shape = pose::log_shape;

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
  static constexpr pose::RowShape shape = pose::map_shape;

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
  static constexpr pose::RowShape shape = pose::position_shape;

  template <class D, class Column, class Rest, class Offset>
  HWY_INLINE auto operator()(D, const Column& at, const Rest&, const Offset& offset) const {
    const lanes::Three o = offset();
    return lanes::Three{Add(at(0), o.x), Add(at(1), o.y), Add(at(2), o.z)};
  }
};

template <class Move>
static void apply_tiles(const TileRun& run, const float* rest, const float* offsets, float* out) {
  constexpr pose::RowShape shape = Move::shape;
  const Tag d;
  for (std::size_t g = 0; g < group_count(run); g += vectors_at_once) {
    Sums<shape.columns> s;
    blend_group<shape.columns>(run, g, s);
    add_mean<shape.with_mean, shape.columns>(run, s);
    if (run.shares) share_sums<shape.center, shape.columns>(run, rest, g, s);
    const auto sum = [&](std::size_t c) HWY_ATTR { return column<shape.columns>(s, c); };
    const auto at_rest = [&]() HWY_ATTR { return load_rests(rest, g); };
    const auto offset = [&]() HWY_ATTR { return load_offsets(run, offsets, g); };
    store_positions(Move()(d, sum, at_rest, offset), g, out);
  }
}

template <class Move>
static constexpr TileKernel tile_kernel() {
  return {Move::shape.columns, blend_tiles<Move::shape.columns>, apply_tiles<Move>};
}

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
