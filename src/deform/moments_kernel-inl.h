// Moving least squares in vector registers: computes positions from weights and rows of moments.
// frame_kernel.cpp includes this file once per instruction set. (No #pragma once: see sym3/exp-inl.h.) The
// sums are in float, relative to a point near the vertex's mean m (see RestMoment) to avoid cancellation.
// Maps are computed from these sums in double, because nearly flat or collinear points lose digits.
#if defined(VIETE_DEFORM_MOMENTS_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_DEFORM_MOMENTS_KERNEL_INL_H
#undef VIETE_DEFORM_MOMENTS_KERNEL_INL_H
#else
#define VIETE_DEFORM_MOMENTS_KERNEL_INL_H
#endif

#include "deform/frame_kernel-inl.h"
#include "sym3/fallback.h"
#include "sym3/polar-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

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

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
