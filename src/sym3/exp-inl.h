// exp of symmetric matrices in vector registers: the source of the kernels, and usable in fused loops
// elsewhere. (No #pragma once: Highway's foreach_target includes this file again for each target.)
//
// How to use it, in a file that Highway compiles once per target:
//   #include "sym3/highway_targets.h"  // the instruction sets of the library's own kernels
//   #define HWY_TARGET_INCLUDE "room/file.cpp"
//   #include <hwy/foreach_target.h>
//   HWY_BEFORE_NAMESPACE();
//   namespace viete::room::HWY_NAMESPACE {
//   namespace lanes = viete::sym3::HWY_NAMESPACE;
//   ... const hn::ScalableTag<float> d;  lanes::Six<hn::Vec<decltype(d)>> e = lanes::exp_lanes(d, s); ...
//   ... const auto both = lanes::exp_lanes(d, lanes::together(s, t));  // lanes::first(both), second(both)
//   ...
// Link viete::sym3; compile with -ffp-contract=off. Each lane has the bits of the single call sym3::exp under
// the kernel of that target, independent of other lanes. Bounds and special values: exp.h, method `fast`.
//
// Algorithm: S = (m + e) I + A with A traceless; for a polynomial f(x) = sum a_k x^k,
//   f(A) = z_0 I + z_1 A + z_2 adj A,   z_k = a_k + p z_{k+2} + q z_{k+3},
// with p = |A|^2 / 2 and q = det A: A^3 = p A + q I (Cayley-Hamilton), and dividing f by x^3 - p x - q gives
// the quotient sum z_{k+3} x^k and the remainder z_2 x^2 + z_1 x + z_0 - p z_2, where A^2 - p I = adj A. No
// eigenvalues, no division of numbers, no case distinction: equal eigenvalues are as accurate as any others.
// f is the minimax polynomial of exp for every p up to p_limit; for larger p, A is scaled to A / 2^j and the
// result squared j times.
#if defined(VIETE_SYM3_EXP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_EXP_INL_H
#undef VIETE_SYM3_EXP_INL_H
#else
#define VIETE_SYM3_EXP_INL_H
#endif

#include "sym3/exp_tables.h"
#include "sym3/fallback.h"
#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

/// S = (mean + rest) I + a, with a traceless; rest is the rounding error of the mean.
template <class V>
struct Split {
  V trace, mean, rest;
  Six<V> a;
};

template <class D, class V>
static HWY_INLINE Split<V> split(D d, const Six<V>& s) {
  using T = hn::TFromD<D>;
  const V third = hn::Set(d, T(1) / T(3));
  const V trace = Add(Add(s.xx, s.yy), s.zz);
  const V mean = Mul(trace, third);
  const V dx = Sub(s.xx, mean), dy = Sub(s.yy, mean), dz = Sub(s.zz, mean);
  const V rest = Mul(Add(Add(dx, dy), dz), third);
  return {trace, mean, rest, {Sub(dx, rest), s.xy, s.xz, Sub(dy, rest), s.yz, Sub(dz, rest)}};
}

/// The invariants of a traceless matrix with adjugate c: A^3 = p A + q I. (Storing -p saves a negation.)
template <class V>
static HWY_INLINE V minus_p(const Six<V>& c) {
  return Add(Add(c.xx, c.yy), c.zz);
}
template <class V>
static HWY_INLINE V determinant(const Six<V>& a, const Six<V>& c) {
  return sum_of_products(a.xx, c.xx, a.xy, c.xy, a.xz, c.xz);
}

/// f(A) = z0 I + z1 A + z2 adj A for the polynomial with these coefficients and leading coefficient 1.
template <class V>
struct Coefficients {
  V z0, z1, z2;
};

/// Interleaves other work, beside(step, z_{k+2}), with each step from z_{k+3}, z_{k+2} and z_{k+1} to z_k, to
/// hide the latency of this chain of dependent steps.
template <class D, class T, std::size_t N, class V, class Beside>
static HWY_INLINE Coefficients<V> recurrence(D d, const T (&a)[N], V minus_p, V q, const Beside& beside) {
  constexpr int degree = static_cast<int>(N) - 1;
  V z2 = hn::Set(d, a[degree - 1]);
  V z1 = Sub(hn::Set(d, a[degree - 2]), minus_p);
  V z0 = NegMulAdd(minus_p, z2, Add(q, hn::Set(d, a[degree - 3])));
#pragma GCC unroll 64
  for (int step = 0; step <= degree - 4; ++step) {
    const V next = NegMulAdd(minus_p, z1, MulAdd(q, z2, hn::Set(d, a[degree - 4 - step])));
    z2 = z1, z1 = z0, z0 = next;
    beside(step, z2);
  }
  return {z0, z1, z2};
}

template <class V>
static HWY_INLINE Six<V> combine(const Coefficients<V>& z, const Six<V>& a, const Six<V>& c) {
  return {MulAdd(z.z1, a.xx, MulAdd(z.z2, c.xx, z.z0)), MulAdd(z.z1, a.xy, Mul(z.z2, c.xy)),
          MulAdd(z.z1, a.xz, Mul(z.z2, c.xz)),          MulAdd(z.z1, a.yy, MulAdd(z.z2, c.yy, z.z0)),
          MulAdd(z.z1, a.yz, Mul(z.z2, c.yz)),          MulAdd(z.z1, a.zz, MulAdd(z.z2, c.zz, z.z0))};
}

/// x = n ln 2 + r, |r| <= 0.3467; n also as the low bits of `shifted`.
template <class V>
struct Reduced {
  V r, n, shifted;
};

template <class D, class V>
static HWY_INLINE Reduced<V> reduce(D d, V x) {
  using C = ExpTables<hn::TFromD<D>>;
  const V magic = hn::Set(d, C::round_magic);
  const V shifted = MulAdd(x, hn::Set(d, C::log2_e), magic);
  const V n = Sub(shifted, magic);
  const V r = NegMulAdd(n, hn::Set(d, C::ln2_low), NegMulAdd(n, hn::Set(d, C::ln2_high), x));
  return {r, n, shifted};
}

/// x 2^n, for results in the normal range: n, the low bits of `shifted`, is added to the exponent field.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE V add_to_exponent(D d, V x, V shifted) {
  const hn::RebindToUnsigned<D> du;
  constexpr int mantissa_bits = ExpTables<hn::TFromD<D>>::mantissa_bits;
  return hn::BitCast(d, hn::Add(hn::BitCast(du, x), hn::ShiftLeft<mantissa_bits>(hn::BitCast(du, shifted))));
}

template <class D, class V>
static HWY_INLINE Two<V> add_to_exponent(D d, Two<V> x, Two<V> shifted) {
  return {add_to_exponent(d, x.a, shifted.a), add_to_exponent(d, x.b, shifted.b)};
}

/// True if the polynomial applies, and e^mean alone is in the normal range.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE hn::Mask<D> is_quick(D d, V minus_p, V trace) {
  using C = ExpTables<hn::TFromD<D>>;
  return hn::And(hn::Ge(minus_p, hn::Set(d, -C::p_limit)),
                 hn::Le(hn::Abs(trace), hn::Set(d, C::trace_limit)));
}
template <class D, class V>
static HWY_INLINE hn::Mask<D> is_quick(D d, Two<V> minus_p, Two<V> trace) {
  return hn::And(is_quick(d, minus_p.a, trace.a), is_quick(d, minus_p.b, trace.b));
}

/// Table::lead e^(mean + rest), valid if is_quick, in steps to be interleaved with those of a recurrence.
template <class Table, class D, class V>
struct ScalarExp {
  using T = hn::TFromD<D>;
  using C = ExpTables<T>;
  static constexpr int degree = sizeof(C::scalar_exp) / sizeof(T) - 1;

  D d;
  V r, shifted, factor;

  HWY_INLINE ScalarExp(D d, const Split<V>& m)
      : d(d), factor(hn::Set(d, C::scalar_exp[degree] * Table::lead)) {
    const Reduced<V> x = reduce(d, m.mean);
    r = Add(x.r, m.rest), shifted = x.shifted;
  }
  HWY_INLINE void step(int step) {
    if (step < degree) {
      factor = MulAdd(factor, r, hn::Set(d, C::scalar_exp[degree - 1 - step] * Table::lead));
    }
  }
  HWY_INLINE V value() const { return add_to_exponent(d, factor, shifted); }
};

template <class V>
static HWY_INLINE Coefficients<V> times(const Coefficients<V>& z, V factor) {
  return {Mul(z.z0, factor), Mul(z.z1, factor), Mul(z.z2, factor)};
}

/// exp(S) from its parts and the invariants of A, valid if is_quick.
template <class D, class V>
static HWY_INLINE Six<V> exp_by_polynomial(D d, const Split<V>& m, const Six<V>& c, V minus_p, V q) {
  using C = ExpTables<hn::TFromD<D>>;
  ScalarExp<C, D, V> scalar(d, m);
  const Coefficients<V> z = recurrence(
      d, C::matrix_exp, minus_p,
      q, [&](int step, const V&) HWY_ATTR __attribute__((always_inline)) { scalar.step(step); });
  return combine(times(z, scalar.value()), m.a, c);
}

/// The fast path, V one register or Two: true if it served every lane; for spreads up to 4.9 (float 6.9) at
/// any trace with exp in the normal range.
template <class D, class V>
static HWY_INLINE bool exp_quick(D d, const Six<V>& s, Six<V>& e) {
  const Split<V> m = split(d, s);
  const Six<V> c = adjugate(m.a);
  const V p = minus_p(c), q = determinant(m.a, c);
  if (HWY_UNLIKELY(!hn::AllTrue(d, is_quick(d, p, m.trace)))) return false;
  e = exp_by_polynomial(d, m, c, p, q);
  return true;
}

/// m e^(x + rest) for any x; over- and underflow per entry. Four factors, because 2^n alone may overflow.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> times_exp(D d, const Six<V>& m, V x, V rest) {
  using T = hn::TFromD<D>;
  using C = ExpTables<T>;
  const V limit = hn::Set(d, C::exponent_limit), magic = hn::Set(d, C::round_magic);
  const V one = hn::Set(d, T(1));
  const Reduced<V> e = reduce(d, hn::Min(hn::Max(x, hn::Neg(limit)), limit));
  const V quarter = hn::Sub(hn::MulAdd(e.n, hn::Set(d, T(0.25)), magic), magic);
  const V last = hn::Sub(e.n, hn::Mul(quarter, hn::Set(d, T(3))));
  const V power = add_to_exponent(d, one, hn::Add(quarter, magic));
  Six<V> out = times(m, horner(d, C::scalar_exp, hn::Add(e.r, rest)));
  for (int i = 0; i < 3; ++i) out = times(out, power);
  return times(out, add_to_exponent(d, one, hn::Add(last, magic)));
}

/// Number of halvings of A, and their factor, that bring its p below p_limit, limited to max_squarings.
template <class V>
struct Halvings {
  V p, scale, count;
};

template <class D, class V = hn::Vec<D>>
static HWY_INLINE Halvings<V> halvings_of(D d, V minus_p) {
  using T = hn::TFromD<D>;
  using C = ExpTables<T>;
  const V limit = hn::Set(d, C::p_limit), half = hn::Set(d, T(0.5));
  Halvings<V> h = {hn::Neg(minus_p), hn::Set(d, T(1)), hn::Zero(d)};
  for (int j = 0; j < C::max_squarings; ++j) {
    const auto large = hn::Gt(h.p, limit);
    if (hn::AllFalse(d, large)) break;
    h.p = hn::IfThenElse(large, hn::Mul(h.p, hn::Set(d, T(0.25))), h.p);
    h.scale = hn::IfThenElse(large, hn::Mul(h.scale, half), h.scale);
    h.count = hn::Add(h.count, hn::IfThenElseZero(large, hn::Set(d, T(1))));
  }
  return h;
}

/// Any input. Per lane exp(A) = exp(A / 2^j)^(2^j) with the least j that brings p, which scales with the
/// square of A, below p_limit. Squares the matrix j times instead of the three coefficients: these depend on
/// the spectrum only through p and q, and a rounding error of q moves a close pair of large eigenvalues, an
/// error of u times the square of the spread; that of the matrix grows by u per unit of the spread. e^mean is
/// applied last, for any mean. Lanes without squaring take the steps of exp_quick, so that results do not
/// depend on neighbouring lanes. Remaining cases use Jacobi one by one: more than max_squarings, overflow,
/// NaN and infinities, and diagonal matrices, whose entries are then accurate individually.
template <class D, class V = hn::Vec<D>>
static HWY_NOINLINE Six<V> exp_general(D d, const Six<V>& s) {
  using T = hn::TFromD<D>;
  using C = ExpTables<T>;
  const Split<V> m = split(d, s);
  const Six<V> unscaled = adjugate(m.a);
  const Halvings<V> halvings = halvings_of(d, minus_p(unscaled));
  const auto ok = is_quick(d, minus_p(unscaled), m.trace);
  const Six<V> quick = exp_by_polynomial(d, m, unscaled, minus_p(unscaled), determinant(m.a, unscaled));
  if (hn::AllTrue(d, ok)) return quick;
  const auto in_reach = hn::AndNot(is_diagonal(d, s), hn::Le(halvings.p, hn::Set(d, C::p_limit)));
  const Six<V> a = times(m.a, halvings.scale), c = adjugate(a);
  const Coefficients<V> z = recurrence(d, C::matrix_exp, minus_p(c), determinant(a, c), [](int, const V&) {});
  Six<V> e = combine(times(z, hn::Set(d, C::lead)), a, c);
  for (int j = 0; j < C::max_squarings; ++j) {
    const auto more = hn::Gt(halvings.count, hn::Set(d, T(j)));
    if (hn::AllFalse(d, more)) break;
    e = select(more, square(e), e);
  }
  e = select(ok, quick, times_exp(d, e, m.mean, m.rest));
  const auto good = hn::Or(ok, hn::And(in_reach, is_finite(d, e)));
  if (hn::AllTrue(d, good)) return e;
  const V from[6] = {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
  V to[6] = {e.xx, e.xy, e.xz, e.yy, e.yz, e.zz};
  replace_lanes(d, hn::Not(good), from, to, [](const T* in, T* out) { exp_by_jacobi(in, out); });
  return {to[0], to[1], to[2], to[3], to[4], to[5]};
}

/// exp of one matrix per lane. T = float or double; any number of lanes.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> exp_lanes(D d, const Six<V>& s) {
  Six<V> e;
  if (HWY_LIKELY(exp_quick(d, s, e))) return e;
  const Six<V> matrix = s;  // a copy: arguments by reference would live in memory, even on the quick path
  return exp_general(d, matrix);
}

/// The same for two registers at once, faster than sequentially.
template <class D, class V>
static HWY_INLINE Six<Two<V>> exp_lanes(D d, const Six<Two<V>>& s) {
  Six<Two<V>> e;
  if (HWY_LIKELY(exp_quick(d, s, e))) return e;
  const Six<V> a = first(s), b = second(s);
  return together(exp_general(d, a), exp_general(d, b));
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
