#include "deform/frame_kernel.h"

#include "sym3/highway_targets.h"

#define HWY_TARGET_INCLUDE "deform/frame_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>

#include "deform/ring_kernel-inl.h"
#include "sym3/exp-inl.h"
#include "sym3/fallback.h"
#include "sym3/polar-inl.h"
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

// Moving least squares: positions from weights and rows of moments. The sums are in float, relative to a
// point near the vertex's mean m (see RestMoment) to avoid cancellation. Maps are computed from these sums in
// double, because nearly flat or collinear points lose digits.

// Sums of a vertex: the nine entries of B' by rows, then sum w * p'. See moments.h.
inline constexpr std::size_t moment_sums = 12;

template <bool Listed, class V>
static HWY_INLINE void add_moments(const TileRun& run, std::size_t group, V (&s)[moment_sums]) {
  const Tag d;
  const V zero = hn::Zero(d);
  const float* rest = run.rest_moments + index_of(group, rest_moment_lines);
  const V near[3] = {hn::Load(d, rest), hn::Load(d, rest + line_lanes), hn::Load(d, rest + 2 * line_lanes)};
  const float* weights = run.weights + index_of(group, run.rows);
  for (std::size_t j = 0; j < run.rows; ++j) {
    const float* row = run.table + pose::moment_shape.columns * (Listed ? run.listed[j] : j);
    const float *map = row + 3, *posed = row + 12;
    hwy::Prefetch(weights + (j + lines_ahead) * line_lanes);
    const V w = hn::Load(d, weights + j * line_lanes);
    const V v = hn::Max(w, zero);
    V arm[3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) arm[c] = hn::Mul(v, hn::Sub(hn::Set(d, row[c]), near[c]));
#pragma GCC unroll 3
    for (int r = 0; r < 3; ++r) {
      const V to = hn::Set(d, posed[r]);
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c)
        s[3 * r + c] = hn::MulAdd(to, arm[c], hn::MulAdd(v, hn::Set(d, map[3 * r + c]), s[3 * r + c]));
      s[9 + r] = hn::MulAdd(w, to, s[9 + r]);
    }
  }
}

// Writes sums[tile][moment_sums][lane].
static void sum_moments(const TileRun& run, float* sums) {
  const Tag d;
  using V = hn::Vec<Tag>;
  for (std::size_t g = 0; g < group_count(run); ++g) {
    const std::size_t at = index_of(g, moment_sums);
    V s[moment_sums];
#pragma GCC unroll 12
    for (std::size_t c = 0; c < moment_sums; ++c)
      s[c] = run.base ? hn::Load(d, run.base + at + c * line_lanes) : hn::Zero(d);
    run.listed ? add_moments<true>(run, g, s) : add_moments<false>(run, g, s);
#pragma GCC unroll 12
    for (std::size_t c = 0; c < moment_sums; ++c) hn::Store(s[c], d, sums + at + c * line_lanes);
  }
}

// The input for a vertex's map, see RestMoment. If Fit::rotates, `rotation` is the rotation nearest to b.
template <class V>
struct FitInput {
  lanes::Nine<V> b, rotation;
  lanes::Three<V> dual, offset;
  V scale;
};

template <class V>
static HWY_INLINE lanes::Three<V> times(const lanes::Nine<V>& m, const lanes::Three<V>& u) {
  return {lanes::sum_of_products(m.xx, u.x, m.xy, u.y, m.xz, u.z),
          lanes::sum_of_products(m.yx, u.x, m.yy, u.y, m.yz, u.z),
          lanes::sum_of_products(m.zx, u.x, m.zy, u.y, m.zz, u.z)};
}

// Each form of the map M has a functor that returns M * o for the offset o.
struct AffineFit {
  static constexpr bool rotates = false;
  template <class V>
  HWY_INLINE lanes::Three<V> operator()(const FitInput<V>& in) const {
    return times(in.b, in.dual);
  }
};

struct RigidFit {
  static constexpr bool rotates = true;
  template <class V>
  HWY_INLINE lanes::Three<V> operator()(const FitInput<V>& in) const {
    return times(in.rotation, in.offset);
  }
};

struct SimilarFit {
  static constexpr bool rotates = true;
  template <class V>
  HWY_INLINE lanes::Three<V> operator()(const FitInput<V>& in) const {
    const auto &r = in.rotation, &b = in.b;
    const V trace = hn::Add(hn::Add(lanes::sum_of_products(r.xx, b.xx, r.xy, b.xy, r.xz, b.xz),
                                    lanes::sum_of_products(r.yx, b.yx, r.yy, b.yy, r.yz, b.yz)),
                            lanes::sum_of_products(r.zx, b.zx, r.zy, b.zy, r.zz, b.zz));
    const lanes::Three<V> turned = times(r, in.offset);
    const V s = hn::Mul(trace, in.scale);
    return {hn::Mul(s, turned.x), hn::Mul(s, turned.y), hn::Mul(s, turned.z)};
  }
};

// Recomputes r, the rotation nearest to m, in the lanes that are not `certain`.
template <class D, class V>
static HWY_NOINLINE void refine_rotation(D d, const lanes::Nine<V>& m, hn::Mask<D> certain,
                                         lanes::Nine<V>& r) {
  const V in[9] = {m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz};
  V out[9] = {r.xx, r.xy, r.xz, r.yx, r.yy, r.yz, r.zx, r.zy, r.zz};
  lanes::replace_lanes(d, hn::Not(certain), in, out,
                       [](const auto* one, auto* rotation) { sym3::polar_by_jacobi(one, rotation); });
  r = {out[0], out[1], out[2], out[3], out[4], out[5], out[6], out[7], out[8]};
}

// The number of registers for which maps are fitted at the same time. Two hide the latency of divisions.
inline constexpr int fits_at_once = 2;

// Returns m + a * cof(m) with a = |m| / |cof(m)|, or I if m = 0. The result has the same nearest rotation R
// as m = R * S, because cof(m) = R * cof(S). But it determines R better: if points are nearly on a line, S
// has two small stretches, and cof(S) has two large stretches.
template <class D, class V>
static HWY_INLINE lanes::Nine<V> evened(D d, const lanes::Nine<V>& m) {
  const lanes::Nine<V> k = lanes::cofactors(m);
  const V n = lanes::squared_norm(m), q = lanes::squared_norm(k);
  const V least = hn::Max(hn::Mul(hn::Set(d, 1e-24), hn::Mul(n, n)), hn::Set(d, 1e-300));
  lanes::Nine<V> even = lanes::multiply_add(k, hn::Sqrt(hn::Div(n, hn::Max(q, least))), m);
  const V one_if_zero = hn::IfThenElseZero(hn::Eq(n, hn::Zero(d)), hn::Set(d, 1.0));
  even.xx = hn::Add(even.xx, one_if_zero);
  even.yy = hn::Add(even.yy, one_if_zero);
  even.zz = hn::Add(even.zz, one_if_zero);
  return even;
}

template <class D, class V>
static HWY_INLINE void find_rotations(D d, FitInput<V> (&in)[fits_at_once]) {
  lanes::Nine<V> even[fits_at_once];
  lanes::Rotations<D> quick[fits_at_once];
  for (int g = 0; g < fits_at_once; ++g) even[g] = evened(d, in[g].b);
  lanes::polar_quick<fits_at_once>(d, even, quick);
  for (int g = 0; g < fits_at_once; ++g) {
    in[g].rotation = quick[g].r;
    if (HWY_UNLIKELY(!hn::AllTrue(d, quick[g].ok))) refine_rotation(d, in[g].b, quick[g].ok, in[g].rotation);
  }
}

// Reads and writes lines of one tile as vectors of doubles, starting at `lane`. Tiles store floats.
struct TileLanes {
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  std::size_t lane;

  HWY_INLINE V line(const float* tile, std::size_t number) const {
    const hn::Rebind<float, D> narrow;
    return hn::PromoteTo(D(), hn::LoadU(narrow, tile + number * line_lanes + lane));
  }
  HWY_INLINE lanes::Three<V> three(const float* tile, std::size_t first) const {
    return {line(tile, first), line(tile, first + 1), line(tile, first + 2)};
  }
  HWY_INLINE void store(V value, float* tile, std::size_t number) const {
    const hn::Rebind<float, D> narrow;
    hn::StoreU(hn::DemoteTo(narrow, value), narrow, tile + number * line_lanes + lane);
  }
};

// Returns B = B' - center * sum^T, see RestMoment: `center` is m' or near it, and `sum` is s.
template <class V>
static HWY_INLINE lanes::Nine<V> about_mean(const TileLanes& at, const float* sums,
                                            const lanes::Three<V>& center, const lanes::Three<V>& sum) {
  const auto less = [&](std::size_t c, V a, V b) HWY_ATTR { return hn::NegMulAdd(a, b, at.line(sums, c)); };
  return {less(0, center.x, sum.x), less(1, center.x, sum.y), less(2, center.x, sum.z),
          less(3, center.y, sum.x), less(4, center.y, sum.y), less(5, center.y, sum.z),
          less(6, center.z, sum.x), less(7, center.z, sum.y), less(8, center.z, sum.z)};
}

// Writes the positions of one tile as lines x, y, z.
template <class Fit>
static HWY_INLINE void fit_tile(const float* sums, const float* rest, const float* offsets, float* moved) {
  const TileLanes::D d;
  using V = TileLanes::V;
  static_assert(fits_at_once * hn::MaxLanes(TileLanes::D()) <= line_lanes);
  for (std::size_t lane = 0; lane < line_lanes; lane += fits_at_once * hn::Lanes(d)) {
    FitInput<V> in[fits_at_once];
    for (int g = 0; g < fits_at_once; ++g) {
      const TileLanes at{lane + g * hn::Lanes(d)};
      in[g].b = about_mean(at, sums, at.three(sums, 9), at.three(rest, 3));
      in[g].dual = at.three(rest, 6);
      in[g].scale = at.line(rest, 9);
      in[g].offset = at.three(offsets, 0);
    }
    if constexpr (Fit::rotates) find_rotations(d, in);
    for (int g = 0; g < fits_at_once; ++g) {
      const TileLanes at{lane + g * hn::Lanes(d)};
      const lanes::Three<V> center = at.three(sums, 9), way = Fit()(in[g]);
      at.store(hn::Add(center.x, way.x), moved, 0);
      at.store(hn::Add(center.y, way.y), moved, 1);
      at.store(hn::Add(center.z, way.z), moved, 2);
    }
  }
}

// Scales the displacement of each vertex from rest by the vertex's share.
static HWY_INLINE void keep_shares(const float* shares, const float* rest, float* moved) {
  const Tag d;
  for (std::size_t lane = 0; lane < line_lanes; lane += hn::Lanes(d)) {
    const auto share = hn::Load(d, shares + lane);
    for (std::size_t c = 0; c < 3; ++c) {
      float* at = moved + c * line_lanes + lane;
      const auto x = hn::Load(d, rest + c * line_lanes + lane);
      hn::Store(hn::MulAdd(share, hn::Sub(hn::Load(d, at), x), x), d, at);
    }
  }
}

template <class Fit>
static void apply_moment_tiles(const TileRun& run, const float* rest, const float* offsets, float* out) {
  HWY_ALIGN float sums[moment_sums * line_lanes], moved[3 * line_lanes];
  for (std::size_t t = 0; t < run.tiles; ++t) {
    TileRun one = run;
    one.tiles = 1;
    one.weights += t * run.rows * line_lanes;
    one.rest_moments += t * rest_moment_lines * line_lanes;
    if (run.base) one.base += t * moment_sums * line_lanes;
    sum_moments(one, sums);
    fit_tile<Fit>(sums, one.rest_moments, offsets + t * 3 * line_lanes, moved);
    if (run.shares) keep_shares(run.shares + t * line_lanes, rest + t * 3 * line_lanes, moved);
    for (std::size_t g = 0; g < group_count(one); ++g)
      store_position(load_rest(moved, g), g, out + t * 4 * line_lanes);
  }
}

template <class Fit>
static constexpr TileKernel moment_kernel() {
  return {moment_sums, sum_moments, apply_moment_tiles<Fit>};
}

static constexpr TileKernel kernel_of(pose::RowForm form) {
  switch (form) {
    case pose::RowForm::logs: return tile_kernel<ByLogs>();
    case pose::RowForm::maps: return tile_kernel<ByMaps>();
    case pose::RowForm::positions: return tile_kernel<ByPositions>();
    case pose::RowForm::affine_moments: return moment_kernel<AffineFit>();
    case pose::RowForm::similar_moments: return moment_kernel<SimilarFit>();
    case pose::RowForm::rigid_moments: return moment_kernel<RigidFit>();
  }
  return {};
}

static constexpr FrameKernel make_frame() {
  FrameKernel made{{}, ring_vertices, ring_high_valence};
  for (std::size_t form = 0; form < pose::row_forms; ++form)
    made.forms[form] = kernel_of(pose::RowForm(form));
  return made;
}
static constexpr FrameKernel frame = make_frame();
static_assert(pose::row_forms == std::size_t(pose::RowForm::rigid_moments) + 1);

}  // namespace viete::deform::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace viete::deform {

const FrameKernel& frame_kernel(const sym3::Kernel& kernel) {
  VIETE_RETURN_COMPILED(frame, kernel.highway_target);
}

}  // namespace viete::deform

#endif
