// exp of symmetric matrices in vector registers: the text behind every kernel, for fused loops elsewhere too.
// (No #pragma once: Highway's foreach_target includes this text again for each target.)
//
// How to use it, in a file that Highway compiles once per target:
//   #define HWY_TARGET_INCLUDE "room/file.cpp"
//   #include <hwy/foreach_target.h>
//   #include "sym3/exp-inl.h"
//   HWY_BEFORE_NAMESPACE();
//   namespace viete::room::HWY_NAMESPACE {
//   namespace lanes = viete::sym3::HWY_NAMESPACE;
//   ... const hn::ScalableTag<float> d;  lanes::Six<hn::Vec<decltype(d)>> e = lanes::exp_lanes(d, s); ...
// Link viete::sym3; compile with -ffp-contract=off. Each lane has the bits of the single call sym3::exp under
// the kernel of that target, whatever the other lanes hold. Bounds and special values: exp.h, method `fast`.
//
// Algorithm: S = (m + e) I + A with A traceless; for a polynomial f(x) = sum a_k x^k,
//   f(A) = z_0 I + z_1 A + z_2 adj A,   z_k = a_k + p z_{k+2} + q z_{k+3},
// because A^3 = p A + q I with p = |A|^2 / 2 and q = det A. No eigenvalues, no division, no case distinction:
// equal eigenvalues are as exact as any others. f is the minimax polynomial of exp for every p up to p_limit;
// larger p go there by A / 2^j, and back by squaring the matrix j times.
#if defined(VIETE_SYM3_EXP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_EXP_INL_H
#undef VIETE_SYM3_EXP_INL_H
#else
#define VIETE_SYM3_EXP_INL_H
#endif

#include "sym3/exp_by_jacobi.h"
#include "sym3/exp_tables.h"
#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

/// S = (mean + rest) I + a, with a traceless; rest is what rounding the mean left over.
template <class V>
struct Split {
  V trace, mean, rest;
  Six<V> a;
};

template <class D, class V = hn::Vec<D>>
static HWY_INLINE Split<V> split(D d, const Six<V>& s) {
  using T = hn::TFromD<D>;
  const V third = hn::Set(d, T(1) / T(3));
  const V trace = hn::Add(hn::Add(s.xx, s.yy), s.zz);
  const V mean = hn::Mul(trace, third);
  const V dx = hn::Sub(s.xx, mean), dy = hn::Sub(s.yy, mean), dz = hn::Sub(s.zz, mean);
  const V rest = hn::Mul(hn::Add(hn::Add(dx, dy), dz), third);
  return {trace, mean, rest, {hn::Sub(dx, rest), s.xy, s.xz, hn::Sub(dy, rest), s.yz, hn::Sub(dz, rest)}};
}

/// A traceless matrix with its adjugate and the two invariants: A^3 = p A + q I. (-p saves a negation.)
template <class V>
struct Invariants {
  Six<V> a, c;
  V minus_p, q;
};

template <class V>
static HWY_INLINE Invariants<V> invariants(const Six<V>& a) {
  const Six<V> c = adjugate(a);
  return {a, c, hn::Add(hn::Add(c.xx, c.yy), c.zz),
          hn::MulAdd(a.xx, c.xx, hn::MulAdd(a.xy, c.xy, hn::Mul(a.xz, c.xz)))};
}

/// f(A) = z0 I + z1 A + z2 adj A for the polynomial with these coefficients and a last one of 1.
template <class V>
struct Coefficients {
  V z0, z1, z2;
};

/// For G registers at a time: their chains of dependent steps hide each other's latencies.
template <int G, class D, class T, std::size_t N, class V = hn::Vec<D>>
static HWY_INLINE void recurrence(D d, const T (&a)[N], const Invariants<V> (&v)[G],
                                  Coefficients<V> (&z)[G]) {
  constexpr int degree = static_cast<int>(N) - 1;
  const V c1 = hn::Set(d, a[degree - 1]), c2 = hn::Set(d, a[degree - 2]), c3 = hn::Set(d, a[degree - 3]);
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) {
    z[g] = {hn::NegMulAdd(v[g].minus_p, c1, hn::Add(v[g].q, c3)), hn::Sub(c2, v[g].minus_p), c1};
  }
#pragma GCC unroll 64
  for (int k = degree - 4; k >= 0; --k) {
    const V c = hn::Set(d, a[k]);
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) {
      const V next = hn::NegMulAdd(v[g].minus_p, z[g].z1, hn::MulAdd(v[g].q, z[g].z2, c));
      z[g] = {next, z[g].z0, z[g].z1};
    }
  }
}

template <class V>
static HWY_INLINE Six<V> combine(const Coefficients<V>& z, const Six<V>& a, const Six<V>& c) {
  return {hn::MulAdd(z.z1, a.xx, hn::MulAdd(z.z2, c.xx, z.z0)),
          hn::MulAdd(z.z1, a.xy, hn::Mul(z.z2, c.xy)),
          hn::MulAdd(z.z1, a.xz, hn::Mul(z.z2, c.xz)),
          hn::MulAdd(z.z1, a.yy, hn::MulAdd(z.z2, c.yy, z.z0)),
          hn::MulAdd(z.z1, a.yz, hn::Mul(z.z2, c.yz)),
          hn::MulAdd(z.z1, a.zz, hn::MulAdd(z.z2, c.zz, z.z0))};
}

/// x = n ln 2 + r, |r| <= 0.3467; n also as the low bits of `shifted`.
template <class V>
struct Reduced {
  V r, n, shifted;
};

template <class D, class V = hn::Vec<D>>
static HWY_INLINE Reduced<V> reduce(D d, V x) {
  using C = ExpTables<hn::TFromD<D>>;
  const V magic = hn::Set(d, C::round_magic);
  const V shifted = hn::MulAdd(x, hn::Set(d, C::log2_e), magic);
  const V n = hn::Sub(shifted, magic);
  const V r = hn::NegMulAdd(n, hn::Set(d, C::ln2_low), hn::NegMulAdd(n, hn::Set(d, C::ln2_high), x));
  return {r, n, shifted};
}

/// x 2^n, for results in the normal range: n, the low bits of `shifted`, is added to the exponent field.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE V add_to_exponent(D d, V x, V shifted) {
  const hn::RebindToUnsigned<D> du;
  constexpr int mantissa_bits = ExpTables<hn::TFromD<D>>::mantissa_bits;
  return hn::BitCast(d, hn::Add(hn::BitCast(du, x), hn::ShiftLeft<mantissa_bits>(hn::BitCast(du, shifted))));
}

/// The answer of the fast path, right in the lanes of `ok`.
template <class D, class V = hn::Vec<D>>
struct Quick {
  Six<V> e;
  hn::Mask<D> ok;
};

/// Spreads up to 4.9 (float 6.9) at any trace that leaves exp in the normal range; anything else not ok.
template <int G, class D, class V = hn::Vec<D>>
static HWY_INLINE void exp_quick(D d, const Six<V> (&s)[G], Quick<D> (&out)[G]) {
  using T = hn::TFromD<D>;
  using C = ExpTables<T>;
  Invariants<V> v[G];
  V r[G], shifted[G], factor[G];
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) {
    const Split<V> m = split(d, s[g]);
    v[g] = invariants(m.a);
    out[g].ok = hn::And(hn::Ge(v[g].minus_p, hn::Set(d, -C::p_limit)),
                        hn::Le(hn::Abs(m.trace), hn::Set(d, C::trace_limit)));
    const Reduced<V> e = reduce(d, m.mean);
    r[g] = hn::Add(e.r, m.rest), shifted[g] = e.shifted;
  }
  constexpr int degree = sizeof(C::exp_table) / sizeof(T) - 1;
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) factor[g] = hn::Set(d, C::exp_table[degree] * C::lead);
#pragma GCC unroll 32
  for (int k = degree - 1; k >= 0; --k) {
    const V c = hn::Set(d, C::exp_table[k] * C::lead);
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) factor[g] = hn::MulAdd(factor[g], r[g], c);
  }
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) factor[g] = add_to_exponent(d, factor[g], shifted[g]);
  Coefficients<V> z[G];
  recurrence<G>(d, C::taylor, v, z);
#pragma GCC unroll 4
  for (int g = 0; g < G; ++g) {
    const V f = factor[g];
    out[g].e = combine({hn::Mul(z[g].z0, f), hn::Mul(z[g].z1, f), hn::Mul(z[g].z2, f)}, v[g].a, v[g].c);
  }
}

/// m e^(x + rest) for any x; over- and underflow entry by entry. Four factors, because 2^n alone may be out
/// of range.
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
  Six<V> out = times(m, horner(d, C::exp_table, hn::Add(e.r, rest)));
  for (int i = 0; i < 3; ++i) out = times(out, power);
  return times(out, add_to_exponent(d, one, hn::Add(last, magic)));
}

/// Any input, given what exp_quick made of it: squarings lane by lane, and what is left one by one.
template <class D, class V = hn::Vec<D>>
static HWY_NOINLINE Six<V> exp_general(D d, const Six<V>& s, const Quick<D>& quick) {
  using T = hn::TFromD<D>;
  using C = ExpTables<T>;
  const V limit = hn::Set(d, C::p_limit), half = hn::Set(d, T(0.5));
  const Split<V> m = split(d, s);
  V p = hn::Neg(invariants(m.a).minus_p), scale = hn::Set(d, T(1)), squarings = hn::Zero(d);
  for (int j = 0; j < C::max_squarings; ++j) {
    const auto large = hn::Gt(p, limit);
    if (hn::AllFalse(d, large)) break;
    p = hn::IfThenElse(large, hn::Mul(p, hn::Set(d, T(0.25))), p);
    scale = hn::IfThenElse(large, hn::Mul(scale, half), scale);
    squarings = hn::Add(squarings, hn::IfThenElseZero(large, hn::Set(d, T(1))));
  }
  const auto in_reach = hn::AndNot(is_diagonal(d, s), hn::Le(p, limit));
  const Invariants<V> v[1] = {invariants(times(m.a, scale))};
  Coefficients<V> z[1];
  recurrence<1>(d, C::taylor, v, z);
  const V lead = hn::Set(d, C::lead);
  Six<V> e =
      combine({hn::Mul(z[0].z0, lead), hn::Mul(z[0].z1, lead), hn::Mul(z[0].z2, lead)}, v[0].a, v[0].c);
  for (int j = 0; j < C::max_squarings; ++j) {
    const auto more = hn::Gt(squarings, hn::Set(d, T(j)));
    if (hn::AllFalse(d, more)) break;
    e = select(more, square(e), e);
  }
  e = select(quick.ok, quick.e, times_exp(d, e, m.mean, m.rest));
  const auto good = hn::Or(quick.ok, hn::And(in_reach, is_finite(d, e)));
  if (hn::AllTrue(d, good)) return e;
  return replace_lanes(d, hn::Not(good), s, e, [](const T* in, T* out) { exp_by_jacobi(in, out); });
}

/// exp of one matrix a lane. T = float or double; any number of lanes.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> exp_lanes(D d, const Six<V>& s) {
  const Six<V> in[1] = {s};
  Quick<D> quick[1];
  exp_quick<1>(d, in, quick);
  if (HWY_LIKELY(hn::AllTrue(d, quick[0].ok))) return quick[0].e;
  const Six<V> matrix = s;  // copies: what is passed by reference lives in memory, on the quick way too
  const Quick<D> copy = quick[0];
  return exp_general(d, matrix, copy);
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
