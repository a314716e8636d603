// The rotation R nearest to a general matrix M = R U, in vector registers. Internal.
//
// The trace x of U is the largest root of x^4 - 2 N x^2 - 8 det(M) x + N^2 - 4 Q, where N and Q are the
// squared norms of M and of its cofactors. R = (x M + cof M)(M^T M + y I)^-1 with y = (x^2 - N) / 2. Rounding
// errors of x and of the inverse make R inexact. One step R (3 I - R^T R) / 2 makes R orthogonal.
#if defined(VIETE_SYM3_POLAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_POLAR_INL_H
#undef VIETE_SYM3_POLAR_INL_H
#else
#define VIETE_SYM3_POLAR_INL_H
#endif

#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

template <class V>
static HWY_INLINE Nine<V> cofactors(const Nine<V>& m) {
  return {difference_of_products(m.yy, m.zz, m.yz, m.zy), difference_of_products(m.yz, m.zx, m.yx, m.zz),
          difference_of_products(m.yx, m.zy, m.yy, m.zx), difference_of_products(m.xz, m.zy, m.xy, m.zz),
          difference_of_products(m.xx, m.zz, m.xz, m.zx), difference_of_products(m.xy, m.zx, m.xx, m.zy),
          difference_of_products(m.xy, m.yz, m.xz, m.yy), difference_of_products(m.xz, m.yx, m.xx, m.yz),
          difference_of_products(m.xx, m.yy, m.xy, m.yx)};
}

template <class V>
static HWY_INLINE Six<V> gram(const Nine<V>& m) {
  return {sum_of_products(m.xx, m.xx, m.yx, m.yx, m.zx, m.zx),
          sum_of_products(m.xx, m.xy, m.yx, m.yy, m.zx, m.zy),
          sum_of_products(m.xx, m.xz, m.yx, m.yz, m.zx, m.zz),
          sum_of_products(m.xy, m.xy, m.yy, m.yy, m.zy, m.zy),
          sum_of_products(m.xy, m.xz, m.yy, m.yz, m.zy, m.zz),
          sum_of_products(m.xz, m.xz, m.yz, m.yz, m.zz, m.zz)};
}

template <class V>
static HWY_INLINE Nine<V> product(const Nine<V>& m, const Six<V>& s) {
  return {sum_of_products(m.xx, s.xx, m.xy, s.xy, m.xz, s.xz),
          sum_of_products(m.xx, s.xy, m.xy, s.yy, m.xz, s.yz),
          sum_of_products(m.xx, s.xz, m.xy, s.yz, m.xz, s.zz),
          sum_of_products(m.yx, s.xx, m.yy, s.xy, m.yz, s.xz),
          sum_of_products(m.yx, s.xy, m.yy, s.yy, m.yz, s.yz),
          sum_of_products(m.yx, s.xz, m.yy, s.yz, m.yz, s.zz),
          sum_of_products(m.zx, s.xx, m.zy, s.xy, m.zz, s.xz),
          sum_of_products(m.zx, s.xy, m.zy, s.yy, m.zz, s.yz),
          sum_of_products(m.zx, s.xz, m.zy, s.yz, m.zz, s.zz)};
}

template <class V>
static HWY_INLINE Nine<V> multiply_add(const Nine<V>& a, V x, const Nine<V>& b) {
  return {hn::MulAdd(a.xx, x, b.xx), hn::MulAdd(a.xy, x, b.xy), hn::MulAdd(a.xz, x, b.xz),
          hn::MulAdd(a.yx, x, b.yx), hn::MulAdd(a.yy, x, b.yy), hn::MulAdd(a.yz, x, b.yz),
          hn::MulAdd(a.zx, x, b.zx), hn::MulAdd(a.zy, x, b.zy), hn::MulAdd(a.zz, x, b.zz)};
}

template <class V>
static HWY_INLINE V squared_norm(const Nine<V>& m) {
  return hn::Add(hn::Add(sum_of_products(m.xx, m.xx, m.xy, m.xy, m.xz, m.xz),
                         sum_of_products(m.yx, m.yx, m.yy, m.yy, m.yz, m.yz)),
                 sum_of_products(m.zx, m.zx, m.zy, m.zy, m.zz, m.zz));
}

/// Computes the traces x (see the top of this file) by Newton's method, from above the largest root.
/// Processes G registers at once, because divisions take long.
template <int G, class D, class V>
static HWY_INLINE void traces_of_stretch(D d, const V (&n)[G], const V (&det)[G], const V (&q)[G],
                                         V (&x)[G]) {
  using T = hn::TFromD<D>;
  constexpr int steps = sizeof(T) == 8 ? 7 : 6;
  const V three = hn::Set(d, T(3)), four = hn::Set(d, T(4)), eight = hn::Set(d, T(8));
  V det8[G], constant[G];
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) {
    det8[g] = hn::Mul(det[g], eight);
    constant[g] = hn::NegMulAdd(q[g], four, hn::Mul(n[g], n[g]));
    x[g] = hn::Sqrt(hn::Mul(n[g], three));
  }
#pragma GCC unroll 8
  for (int k = 0; k < steps; ++k) {
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) {
      const V below = hn::MulSub(x[g], x[g], n[g]);  // x^2 - N
      const V value = hn::MulAdd(x[g], hn::MulSub(hn::Sub(below, n[g]), x[g], det8[g]), constant[g]);
      const V slope = hn::MulSub(hn::Mul(four, x[g]), below, det8[g]);
      x[g] = hn::Sub(x[g], hn::Div(value, slope));
    }
  }
}

/// `r` is valid in lanes of `ok`. In these lanes, s2 + s3 (polar.h) is not small relative to s1.
template <class D, class V = hn::Vec<D>>
struct Rotations {
  Nine<V> r;
  hn::Mask<D> ok;
};

/// Returns the rotation of `m` from its cofactors `k`, its squared norm `n` and the trace `x` of its stretch.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Rotations<D> rotation_from_trace(D d, const Nine<V>& m, const Nine<V>& k, V n, V x) {
  using T = hn::TFromD<D>;
  const V one = hn::Set(d, T(1)), half = hn::Set(d, T(0.5));
  const V y = hn::Mul(hn::MulSub(x, x, n), half);
  Six<V> w = gram(m);
  w.xx = hn::Add(w.xx, y);
  w.yy = hn::Add(w.yy, y);
  w.zz = hn::Add(w.zz, y);
  const Six<V> c = adjugate(w);
  const V det_w = sum_of_products(w.xx, c.xx, w.xy, c.xy, w.xz, c.xz);  // ((s1 + s2)(s1 + s3)(s2 + s3))^2
  const V inverse = hn::Div(one, det_w);
  const Nine<V> r = product(multiply_add(m, x, k), times(c, inverse));
  Six<V> g = gram(r);  // below, g becomes (3 I - g) / 2
  const V off = hn::Add(hn::Abs(g.xy), hn::Add(hn::Abs(g.xz), hn::Abs(g.yz)));
  const V on =
      hn::Add(hn::Abs(hn::Sub(g.xx, one)), hn::Add(hn::Abs(hn::Sub(g.yy, one)), hn::Abs(hn::Sub(g.zz, one))));
  const V three_halves = hn::Set(d, T(1.5)), minus_half = hn::Neg(half);
  g = times(g, minus_half);
  g.xx = hn::Add(g.xx, three_halves);
  g.yy = hn::Add(g.yy, three_halves);
  g.zz = hn::Add(g.zz, three_halves);
  const auto settled = hn::Le(hn::Add(on, off), hn::Set(d, T(sizeof(T) == 8 ? 1e-9 : 2e-5)));
  const auto in_range = hn::And(hn::Ge(n, hn::Set(d, T(sizeof(T) == 8 ? 1e-60 : 1e-8))),
                                hn::Le(n, hn::Set(d, T(sizeof(T) == 8 ? 1e60 : 1e8))));
  const V least = hn::Mul(hn::Mul(n, hn::Mul(n, n)), hn::Set(d, T(1e-3)));
  const auto well = hn::And(hn::Ge(det_w, least), in_range);
  return {product(r, g), hn::And(settled, well)};
}

template <int G, class D, class V = hn::Vec<D>>
static HWY_INLINE void polar_quick(D d, const Nine<V> (&m)[G], Rotations<D> (&out)[G]) {
  Nine<V> k[G];
  V n[G], det[G], q[G], x[G];
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) {
    k[g] = cofactors(m[g]);
    n[g] = squared_norm(m[g]);
    q[g] = squared_norm(k[g]);
    det[g] = sum_of_products(m[g].xx, k[g].xx, m[g].xy, k[g].xy, m[g].xz, k[g].xz);
  }
  traces_of_stretch<G>(d, n, det, q, x);
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) out[g] = rotation_from_trace(d, m[g], k[g], n[g], x[g]);
}

/// Returns the symmetric part of R^T M. Halves terms before adding them: large entries do not overflow.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> stretch(D d, const Nine<V>& r, const Nine<V>& m) {
  const V half = hn::Set(d, hn::TFromD<D>(0.5));
  const V xy = sum_of_products(r.xx, m.xy, r.yx, m.yy, r.zx, m.zy),
          yx = sum_of_products(r.xy, m.xx, r.yy, m.yx, r.zy, m.zx);
  const V xz = sum_of_products(r.xx, m.xz, r.yx, m.yz, r.zx, m.zz),
          zx = sum_of_products(r.xz, m.xx, r.yz, m.yx, r.zz, m.zx);
  const V yz = sum_of_products(r.xy, m.xz, r.yy, m.yz, r.zy, m.zz),
          zy = sum_of_products(r.xz, m.xy, r.yz, m.yy, r.zz, m.zy);
  return {sum_of_products(r.xx, m.xx, r.yx, m.yx, r.zx, m.zx),
          hn::MulAdd(xy, half, hn::Mul(yx, half)),
          hn::MulAdd(xz, half, hn::Mul(zx, half)),
          sum_of_products(r.xy, m.xy, r.yy, m.yy, r.zy, m.zy),
          hn::MulAdd(yz, half, hn::Mul(zy, half)),
          sum_of_products(r.xz, m.xz, r.yz, m.yz, r.zz, m.zz)};
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
