// The derivative of exp in vector registers: the source of the kernels, and for fused loops elsewhere.
// (No #pragma once: Highway's foreach_target includes this text again for each target.)
//
// How to use it: as exp-inl.h, with
//   ... const auto at = lanes::exp_point(d, s);                      // once for each S
//   ... const lanes::Six<V> f = lanes::exp_value(d, at);             // exp(S), if that is needed, too
//   ... const lanes::Six<V> df = lanes::exp_derivative(d, at, e);    // for each direction E at S
// Each lane has the bits of the single call sym3::exp_derivative under the kernel of that target, whatever
// the other lanes hold. Bounds and special values: derivative.h. exp_value has the bounds of sym3::exp, not
// its bits: its polynomial is another one.
//
// Algorithm: that of exp-inl.h, differentiated. With t = tr E / 3, E - t I traceless and C = adj A,
//   dp = <A, E>,   dq = <C, E> + t p,   dC = adj'(A)[E] + t A,
//   exp'(S)[E] = dz_0 I + dz_1 A + z_1 (E - t I) + dz_2 C + z_2 dC + t exp(S),
// where adj'(A)[E] is bilinear. The coefficients z_k are sums of a_{n+k} h_n over n, and h_n those of the
// power series 1 / (1 - p x^2 - q x^3), whose derivatives by p and by q are x^2 and x^3 over the square of
// that: so dz_k = u_k dp + u_{k+1} dq with one recurrence more for every direction,
//   u_k = p u_{k+2} + q u_{k+3} + z_{k+2}.
// No eigenvalues, no division of numbers, no case distinction: exact at equal eigenvalues. The polynomial is
// one whose derivative is close to exp; a minimax polynomial's is not, at the ends of its range. Squaring:
// f' <- f f' + f' f, f <- f f.
#if defined(VIETE_SYM3_EXP_DERIVATIVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_EXP_DERIVATIVE_INL_H
#undef VIETE_SYM3_EXP_DERIVATIVE_INL_H
#else
#define VIETE_SYM3_EXP_DERIVATIVE_INL_H
#endif

#include "sym3/exp-inl.h"
#include "sym3/exp_tables.h"
#include "sym3/fallback.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

/// exp(S) = z0 I + z1 A + z2 C, and u_k = dz_k / dp, u_{k+1} = dz_k / dq: all that a derivative is made of.
template <class V>
struct ExpParts {
  Six<V> a, c;
  V minus_p;
  Coefficients<V> z;
  V u0, u1, u2, u3;
};

/// From A = `a`, times a factor that is made beside the recurrence: scalar.step(k) in its steps, then
/// scalar.value(). (Into a place and not returned: what would copy it is the compiler's, for no target.)
template <class D, class V, class Scalar>
static HWY_INLINE void put_exp_parts(D d, const Six<V>& a, Scalar scalar, ExpParts<V>& parts) {
  using C = ExpDerivativeTables<hn::TFromD<D>>;
  constexpr int degree = sizeof(C::matrix_exp) / sizeof(C::matrix_exp[0]) - 1;
  parts.a = a, parts.c = adjugate(a), parts.minus_p = minus_p(parts.c);
  const V minus_p = parts.minus_p, q = determinant(a, parts.c);
  V u1 = hn::Set(d, C::matrix_exp[degree - 1]), u2 = hn::Set(d, C::matrix_exp[degree]), u3 = hn::Zero(d);
  V u0 = u1;
  const auto beside = [&](int step, const V& z2) HWY_ATTR __attribute__((always_inline)) {
    if (step > 0) u3 = u2, u2 = u1, u1 = u0;
    u0 = NegMulAdd(minus_p, u2, MulAdd(q, u3, z2));
    scalar.step(step);
  };
  parts.z = recurrence(d, C::matrix_exp, minus_p, q, beside);
  const V factor = scalar.value();
  parts.z = times(parts.z, factor);
  parts.u0 = Mul(u0, factor), parts.u1 = Mul(u1, factor), parts.u2 = Mul(u2, factor),
  parts.u3 = Mul(u3, factor);
}

/// The trace of m times e, both symmetric.
template <class D, class V>
static HWY_INLINE V inner_product(D d, const Six<V>& m, const Six<V>& e) {
  return MulAdd(hn::Set(d, hn::TFromD<D>(2)), sum_of_products(m.xy, e.xy, m.xz, e.xz, m.yz, e.yz),
                sum_of_products(m.xx, e.xx, m.yy, e.yy, m.zz, e.zz));
}

/// The derivative of adj at A in the direction E.
template <class V>
static HWY_INLINE Six<V> adjugate_slope(const Six<V>& a, const Six<V>& e) {
  const V twice_xy = Add(e.xy, e.xy), twice_xz = Add(e.xz, e.xz), twice_yz = Add(e.yz, e.yz);
  return {NegMulAdd(a.yz, twice_yz, MulAdd(a.yy, e.zz, Mul(a.zz, e.yy))),
          NegMulAdd(a.xy, e.zz, NegMulAdd(a.zz, e.xy, MulAdd(a.xz, e.yz, Mul(a.yz, e.xz)))),
          NegMulAdd(a.xz, e.yy, NegMulAdd(a.yy, e.xz, MulAdd(a.xy, e.yz, Mul(a.yz, e.xy)))),
          NegMulAdd(a.xz, twice_xz, MulAdd(a.xx, e.zz, Mul(a.zz, e.xx))),
          NegMulAdd(a.yz, e.xx, NegMulAdd(a.xx, e.yz, MulAdd(a.xy, e.xz, Mul(a.xz, e.xy)))),
          NegMulAdd(a.xy, twice_xy, MulAdd(a.xx, e.yy, Mul(a.yy, e.xx)))};
}

/// exp'(S)[E] where the parts are right.
template <class D, class V>
static HWY_INLINE Six<V> exp_slope(D d, const ExpParts<V>& m, const Six<V>& e) {
  const Coefficients<V>& z = m.z;
  const V t = Mul(Add(Add(e.xx, e.yy), e.zz), hn::Set(d, hn::TFromD<D>(1) / hn::TFromD<D>(3)));
  const V dp = inner_product(d, m.a, e), dq = NegMulAdd(t, m.minus_p, inner_product(d, m.c, e));
  const V k0 = sum_of_products(m.u0, dp, m.u1, dq, t, Sub(z.z0, z.z1));
  const V k1 = sum_of_products(m.u1, dp, m.u2, dq, t, Add(z.z1, z.z2));
  const V k2 = sum_of_products(m.u2, dp, m.u3, dq, t, z.z2);
  const Six<V> base = combine({k0, k1, k2}, m.a, m.c), s = adjugate_slope(m.a, e);
  const auto entry = [&](const V& b, const V& e, const V& s) HWY_ATTR __attribute__((always_inline)) {
    return MulAdd(z.z1, e, MulAdd(z.z2, s, b));
  };
  return {entry(base.xx, e.xx, s.xx), entry(base.xy, e.xy, s.xy), entry(base.xz, e.xz, s.xz),
          entry(base.yy, e.yy, s.yy), entry(base.yz, e.yz, s.yz), entry(base.zz, e.zz, s.zz)};
}

/// One S a lane with what all its directions share.
template <class D, class V = hn::Vec<D>>
struct ExpPoint {
  Six<V> s;
  ExpParts<V> parts;
  hn::Mask<D> ok;  ///< where `parts` are right
};

template <class D, class V = hn::Vec<D>>
static HWY_INLINE void put_exp_point(D d, const Six<V>& s, ExpPoint<D>& point) {
  using C = ExpDerivativeTables<hn::TFromD<D>>;
  const Split<V> m = split(d, s);
  point.s = s;
  put_exp_parts(d, m.a, ScalarExp<C, D, V>(d, m), point.parts);
  point.ok = is_quick(d, point.parts.minus_p, m.trace);
}

template <class D, class V = hn::Vec<D>>
static HWY_INLINE ExpPoint<D> exp_point(D d, const Six<V>& s) {
  ExpPoint<D> point;
  put_exp_point(d, s, point);
  return point;
}

/// In place of ScalarExp.
template <class V>
struct ConstantFactor {
  V factor;
  HWY_INLINE void step(int) const {}
  HWY_INLINE V value() const { return factor; }
};

/// a b + c d + e f + g h + i j + k l.
template <class V>
static HWY_INLINE V sum_of_six_products(V a, V b, V c, V d, V e, V f, V g, V h, V i, V j, V k, V l) {
  return MulAdd(a, b, MulAdd(c, d, MulAdd(e, f, sum_of_products(g, h, i, j, k, l))));
}

/// f g + g f.
template <class V>
static HWY_INLINE Six<V> twice_symmetric_product(const Six<V>& f, const Six<V>& g) {
  const V xx = sum_of_products(f.xx, g.xx, f.xy, g.xy, f.xz, g.xz),
          yy = sum_of_products(f.yy, g.yy, f.xy, g.xy, f.yz, g.yz),
          zz = sum_of_products(f.zz, g.zz, f.xz, g.xz, f.yz, g.yz);
  return {Add(xx, xx),
          sum_of_six_products(f.xx, g.xy, f.xy, g.yy, f.xz, g.yz, g.xx, f.xy, g.xy, f.yy, g.xz, f.yz),
          sum_of_six_products(f.xx, g.xz, f.xy, g.yz, f.xz, g.zz, g.xx, f.xz, g.xy, f.yz, g.xz, f.zz),
          Add(yy, yy),
          sum_of_six_products(f.xy, g.xz, f.yy, g.yz, f.yz, g.zz, g.xy, f.xz, g.yy, f.yz, g.yz, f.zz),
          Add(zz, zz)};
}

/// Any S and any E, as exp_general, of which it is the derivative.
template <class D, class V = hn::Vec<D>>
static HWY_NOINLINE Six<V> exp_derivative_general(D d, const Six<V>& s, const Six<V>& direction) {
  using T = hn::TFromD<D>;
  using C = ExpTables<T>;
  ExpPoint<D> point;
  put_exp_point(d, s, point);
  const Six<V> quick = exp_slope(d, point.parts, direction);
  const Halvings<V> halvings = halvings_of(d, point.parts.minus_p);
  const auto in_reach = hn::Le(halvings.p, hn::Set(d, C::p_limit));
  const Split<V> m = split(d, s);
  const ConstantFactor<V> lead = {hn::Set(d, ExpDerivativeTables<T>::lead)};
  ExpParts<V> parts;
  put_exp_parts(d, times(m.a, halvings.scale), lead, parts);
  Six<V> f = combine(parts.z, parts.a, parts.c), df = exp_slope(d, parts, times(direction, halvings.scale));
  for (int j = 0; j < C::max_squarings; ++j) {
    const auto more = hn::Gt(halvings.count, hn::Set(d, T(j)));
    if (hn::AllFalse(d, more)) break;
    df = select(more, twice_symmetric_product(f, df), df);
    f = select(more, square(f), f);
  }
  df = select(point.ok, quick, times_exp(d, df, m.mean, m.rest));
  const auto good = hn::And(hn::Or(point.ok, in_reach), is_finite(d, df));
  if (hn::AllTrue(d, good)) return df;
  const V from[12] = {s.xx,         s.xy,         s.xz,         s.yy,         s.yz,         s.zz,
                      direction.xx, direction.xy, direction.xz, direction.yy, direction.yz, direction.zz};
  V to[6] = {df.xx, df.xy, df.xz, df.yy, df.yz, df.zz};
  replace_lanes(d, hn::Not(good), from, to, [](const T* in, T* out) { exp_derivative_by_jacobi(in, out); });
  return {to[0], to[1], to[2], to[3], to[4], to[5]};
}

/// exp'(S)[E], one S and one E a lane.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> exp_derivative(D d, const ExpPoint<D>& point, const Six<V>& e) {
  const Six<V> quick = exp_slope(d, point.parts, e);
  if (HWY_LIKELY(hn::AllTrue(d, hn::And(point.ok, is_finite(d, quick))))) return quick;
  const Six<V> s = point.s, direction = e;  // copies: what is passed by reference lives in memory
  return exp_derivative_general(d, s, direction);
}

/// exp(S).
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> exp_value(D d, const ExpPoint<D, V>& point) {
  if (HWY_LIKELY(hn::AllTrue(d, point.ok))) return combine(point.parts.z, point.parts.a, point.parts.c);
  const Six<V> s = point.s;
  const Six<V> general = exp_general(d, s);
  return select(point.ok, combine(point.parts.z, point.parts.a, point.parts.c), general);
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
