// The derivative of exp in vector registers, for the kernels and for loops of other libraries.
//
// Use this header like exp-inl.h, with
//   ... const auto at = lanes::exp_point(d, s);                      // once for each S
//   ... const lanes::Six<V> f = lanes::exp_value(d, at);             // exp(S), if needed
//   ... const lanes::Six<V> df = lanes::exp_derivative(d, at, e);    // for each direction E at S
// A point cannot be assigned. For an array of points, use put_exp_point(). Each lane has the same bits as a
// single call of sym3::exp_derivative with the kernel of that instruction set, whatever other lanes contain.
// For bounds and special values see derivative.h. exp_value() has the error bounds of sym3::exp but other
// bits, because it uses another polynomial.
//
// The code differentiates the formulas of exp-inl.h. With C = adj A and t = tr E / 3:
//   dp = <A, E>,   dq = <C, E> + t p,   dC = adj'(A)[E] + t A
//   dz_k = u_k dp + u_{k+1} dq,   u_k = p u_{k+2} + q u_{k+3} + z_{k+2}
//   exp'(S)[E] = dz_0 I + dz_1 A + z_1 (E - t I) + dz_2 C + z_2 dC + t exp(S)
// The numbers u_k do not depend on E. A squaring of f replaces f' by f f' + f' f. The polynomial differs from
// that of exp-inl.h, because its derivative must also be close to exp, see exp_tables.h.
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

/// The parts of exp(S) = z0 I + z1 A + z2 C, and the derivatives u_k = dz_k / dp and u_{k+1} = dz_k / dq.
template <class V>
struct ExpParts {
  Six<V> a, c;
  V minus_p;
  Coefficients<V> z;
  V u0, u1, u2, u3;
  V t0, t1;                        ///< t0 = z0 - z1 and t1 = z1 + z2: the factors of t
  Six<V> w;                        ///< z2 A
  V beside_x, beside_y, beside_z;  ///< z1 - w.xx, z1 - w.yy, z1 - w.zz
};

/// Computes the parts for A = `a`, times scalar.value(). Writes to a parameter, because GCC would compile the
/// copy of a returned value without the instruction set.
template <class D, class V, class Scalar>
static HWY_INLINE void put_exp_parts(D d, const Six<V>& a, Scalar scalar, ExpParts<V>& parts) {
  using C = ExpDerivativeTables<hn::TFromD<D>>;
  constexpr int degree = sizeof(C::matrix_exp) / sizeof(C::matrix_exp[0]) - 1;
  parts.a = a;
  parts.c = adjugate(a);
  parts.minus_p = minus_p(parts.c);
  const V minus_p = parts.minus_p, q = determinant(a, parts.c);
  V u1 = hn::Set(d, C::matrix_exp[degree - 1]), u2 = hn::Set(d, C::matrix_exp[degree]), u3 = hn::Zero(d);
  V u0 = u1;
  const auto beside = [&](int step, const V& z2) HWY_ATTR __attribute__((always_inline)) {
    if (step > 0) {
      u3 = u2;
      u2 = u1;
      u1 = u0;
    }
    u0 = NegMulAdd(minus_p, u2, MulAdd(q, u3, z2));
    scalar.step(step);
  };
  parts.z = recurrence(d, C::matrix_exp, minus_p, q, beside);
  const V factor = scalar.value();
  parts.z = times(parts.z, factor);
  const Coefficients<V>& z = parts.z;
  parts.t0 = Sub(z.z0, z.z1);
  parts.t1 = Add(z.z1, z.z2);
  parts.w = {Mul(z.z2, a.xx), Mul(z.z2, a.xy), Mul(z.z2, a.xz),
             Mul(z.z2, a.yy), Mul(z.z2, a.yz), Mul(z.z2, a.zz)};
  parts.beside_x = Sub(z.z1, parts.w.xx);
  parts.beside_y = Sub(z.z1, parts.w.yy);
  parts.beside_z = Sub(z.z1, parts.w.zz);
  parts.u0 = Mul(u0, factor);
  parts.u1 = Mul(u1, factor);
  parts.u2 = Mul(u2, factor);
  parts.u3 = Mul(u3, factor);
}

/// The coefficients of I, A and C in exp'(S)[E].
template <class V>
static HWY_INLINE Coefficients<V> coefficient_slopes(const ExpParts<V>& m, V t, V dp, V dq) {
  return {sum_of_products(m.u0, dp, m.u1, dq, m.t0, t), sum_of_products(m.u1, dp, m.u2, dq, m.t1, t),
          sum_of_products(m.u2, dp, m.u3, dq, m.z.z2, t)};
}

/// Returns exp'(S)[E] from the parts of exp(S).
template <class D, class V>
static HWY_INLINE Six<V> exp_slope(D d, const ExpParts<V>& m, const Six<V>& e) {
  const Six<V>&a = m.a, &c = m.c, &w = m.w;
  const V xy = Add(e.xy, e.xy), xz = Add(e.xz, e.xz), yz = Add(e.yz, e.yz);
  const auto inner_product = [&](const Six<V>& m) HWY_ATTR __attribute__((always_inline)) {
    return MulAdd(m.xx, e.xx,
                  MulAdd(m.yy, e.yy, MulAdd(m.zz, e.zz, sum_of_products(m.xy, xy, m.xz, xz, m.yz, yz))));
  };
  const V t = Mul(Add(Add(e.xx, e.yy), e.zz), hn::Set(d, hn::TFromD<D>(1) / hn::TFromD<D>(3)));
  const auto k = coefficient_slopes(m, t, inner_product(a), NegMulAdd(t, m.minus_p, inner_product(c)));
  const Six<V> s = combine(k, a, c);
  return {
      NegMulAdd(w.yz, yz, MulAdd(w.zz, e.yy, MulAdd(w.yy, e.zz, MulAdd(m.z.z1, e.xx, s.xx)))),
      NegMulAdd(w.xy, e.zz, MulAdd(w.yz, e.xz, MulAdd(w.xz, e.yz, MulAdd(m.beside_z, e.xy, s.xy)))),
      NegMulAdd(w.xz, e.yy, MulAdd(w.yz, e.xy, MulAdd(w.xy, e.yz, MulAdd(m.beside_y, e.xz, s.xz)))),
      NegMulAdd(w.xz, xz, MulAdd(w.zz, e.xx, MulAdd(w.xx, e.zz, MulAdd(m.z.z1, e.yy, s.yy)))),
      NegMulAdd(w.yz, e.xx, MulAdd(w.xz, e.xy, MulAdd(w.xy, e.xz, MulAdd(m.beside_x, e.yz, s.yz)))),
      NegMulAdd(w.xy, xy, MulAdd(w.yy, e.xx, MulAdd(w.xx, e.yy, MulAdd(m.z.z1, e.zz, s.zz)))),
  };
}

/// Computes exp_slope() in the six directions of a tangent (derivative.h).
template <class D, class V>
static HWY_INLINE void put_exp_tangent(D d, const ExpParts<V>& m, Six<V> (&f)[6]) {
  const Six<V>&a = m.a, &c = m.c, &w = m.w;
  const V third = hn::Set(d, hn::TFromD<D>(1) / hn::TFromD<D>(3)), p = hn::Mul(m.minus_p, third),
          zero = hn::Zero(d);
  const auto diagonal = [&](const V& a_ii, const V& c_ii, Six<V>& f) HWY_ATTR __attribute__((always_inline)) {
    f = combine(coefficient_slopes(m, third, a_ii, hn::Sub(c_ii, p)), a, c);
  };
  const auto off = [&](const V& a_ij, const V& c_ij, Six<V>& f) HWY_ATTR __attribute__((always_inline)) {
    f = combine(coefficient_slopes(m, zero, hn::Add(a_ij, a_ij), hn::Add(c_ij, c_ij)), a, c);
  };
  const auto add = [](V & x, const V& y) HWY_ATTR __attribute__((always_inline)) {
    x = hn::Add(x, y);
  };
  const auto subtract = [](V & x, const V& y) HWY_ATTR __attribute__((always_inline)) {
    x = hn::Sub(x, y);
  };
  const V &x = m.beside_x, &y = m.beside_y, &z = m.beside_z, &z1 = m.z.z1;
  diagonal(a.xx, c.xx, f[0]);
  add(f[0].xx, z1);
  add(f[0].yy, w.zz);
  subtract(f[0].yz, w.yz);
  add(f[0].zz, w.yy);
  off(a.xy, c.xy, f[1]);
  add(f[1].xy, z);
  add(f[1].xz, w.yz);
  add(f[1].yz, w.xz);
  subtract(f[1].zz, hn::Add(w.xy, w.xy));
  off(a.xz, c.xz, f[2]);
  add(f[2].xy, w.yz);
  add(f[2].xz, y);
  subtract(f[2].yy, hn::Add(w.xz, w.xz));
  add(f[2].yz, w.xy);
  diagonal(a.yy, c.yy, f[3]);
  add(f[3].xx, w.zz);
  subtract(f[3].xz, w.xz);
  add(f[3].yy, z1);
  add(f[3].zz, w.xx);
  off(a.yz, c.yz, f[4]);
  subtract(f[4].xx, hn::Add(w.yz, w.yz));
  add(f[4].xy, w.xz);
  add(f[4].xz, w.xy);
  add(f[4].yz, x);
  diagonal(a.zz, c.zz, f[5]);
  add(f[5].xx, w.yy);
  subtract(f[5].xy, w.xy);
  add(f[5].yy, w.xx);
  add(f[5].zz, z1);
}

/// The data at S for all directions. Each lane has one S.
template <class D, class V = hn::Vec<D>>
struct ExpPoint {
  Six<V> s;
  hn::Mask<D> ok;        ///< lanes where is_quick() is true
  ExpParts<V> parts;     ///< the parts for A if `ok`, otherwise for A * halvings.scale
  Halvings<V> halvings;  ///< without halvings if `ok`
};

/// Gives the value of ScalarExp in lanes of `ok`, and Table::lead in all other lanes.
template <class Table, class D, class V>
struct ScalarExpOrLead {
  ScalarExp<Table, D, V> scalar;
  hn::Mask<D> ok;

  HWY_INLINE void step(int step) { scalar.step(step); }
  HWY_INLINE V value() const { return hn::IfThenElse(ok, scalar.value(), hn::Set(scalar.d, Table::lead)); }
};

template <class D, class V = hn::Vec<D>>
static HWY_NOINLINE void scale_exp_point(D d, ExpPoint<D>& point) {
  using C = ExpDerivativeTables<hn::TFromD<D>>;
  const Split<V> m = split(d, point.s);
  point.halvings = halvings_of(d, point.parts.minus_p);
  const ScalarExpOrLead<C, D, V> factor = {ScalarExp<C, D, V>(d, m), point.ok};
  put_exp_parts(d, times(m.a, point.halvings.scale), factor, point.parts);
}

template <class D, class V = hn::Vec<D>>
static HWY_INLINE void put_exp_point(D d, const Six<V>& s, ExpPoint<D>& point) {
  using C = ExpDerivativeTables<hn::TFromD<D>>;
  const Split<V> m = split(d, s);
  point.s = s;
  put_exp_parts(d, m.a, ScalarExp<C, D, V>(d, m), point.parts);
  point.ok = is_quick(d, point.parts.minus_p, m.trace);
  point.halvings = {hn::Neg(point.parts.minus_p), hn::Set(d, hn::TFromD<D>(1)), hn::Zero(d)};
  if (HWY_UNLIKELY(!hn::AllTrue(d, point.ok))) scale_exp_point(d, point);
}

template <class D, class V = hn::Vec<D>>
static HWY_INLINE ExpPoint<D> exp_point(D d, const Six<V>& s) {
  ExpPoint<D> point;
  put_exp_point(d, s, point);
  return point;
}

template <class V>
static HWY_INLINE V sum_of_six_products(V a, V b, V c, V d, V e, V f, V g, V h, V i, V j, V k, V l) {
  return MulAdd(a, b, MulAdd(c, d, MulAdd(e, f, sum_of_products(g, h, i, j, k, l))));
}

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

/// Returns the derivative of exp_general() for any S and E.
template <class D, class V = hn::Vec<D>>
static HWY_NOINLINE Six<V> exp_derivative_general(D d, const ExpPoint<D>& point, const Six<V>& e) {
  using T = hn::TFromD<D>;
  using C = ExpTables<T>;
  const auto& [s, ok, parts, halvings] = point;
  const Six<V> slope = exp_slope(d, parts, times(e, halvings.scale));
  Six<V> f = combine(parts.z, parts.a, parts.c), df = slope;
  for (int j = 0; j < C::max_squarings; ++j) {
    const auto more = hn::Gt(halvings.count, hn::Set(d, T(j)));
    if (hn::AllFalse(d, more)) break;
    df = select(more, twice_symmetric_product(f, df), df);
    f = select(more, square(f), f);
  }
  const Split<V> m = split(d, s);
  df = select(ok, slope, times_exp(d, df, m.mean, m.rest));
  const auto in_reach = hn::Le(halvings.p, hn::Set(d, C::p_limit));
  const auto good = hn::And(in_reach, is_finite(d, df));
  if (hn::AllTrue(d, good)) return df;
  const V from[12] = {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz, e.xx, e.xy, e.xz, e.yy, e.yz, e.zz};
  V to[6] = {df.xx, df.xy, df.xz, df.yy, df.yz, df.zz};
  replace_lanes(d, hn::Not(good), from, to, [](const T* in, T* out) { exp_derivative_by_jacobi(in, out); });
  return {to[0], to[1], to[2], to[3], to[4], to[5]};
}

/// Returns exp'(S)[E]. Each lane has one S and one E.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> exp_derivative(D d, const ExpPoint<D>& point, const Six<V>& e) {
  if (HWY_LIKELY(hn::AllTrue(d, point.ok))) {
    const Six<V> quick = exp_slope(d, point.parts, e);
    if (HWY_LIKELY(hn::AllTrue(d, is_finite(d, quick)))) return quick;
  }
  const Six<V> direction = e;  // a copy, because passing e by reference would keep e in memory
  return exp_derivative_general(d, point, direction);
}

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
