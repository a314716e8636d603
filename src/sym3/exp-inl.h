// exp of symmetric matrices in vector registers, for the kernels and for loops of other libraries.
//
// Example of a file that Highway compiles once for each instruction set:
//   #include "sym3/highway_targets.h"  // the instruction sets of the library's own kernels
//   #define HWY_TARGET_INCLUDE "room/file.cpp"
//   #include <hwy/foreach_target.h>
//   HWY_BEFORE_NAMESPACE();
//   namespace viete::room::HWY_NAMESPACE {
//   namespace lanes = viete::sym3::HWY_NAMESPACE;
//   ... const hn::ScalableTag<float> d;  lanes::Six<hn::Vec<decltype(d)>> e = lanes::exp_lanes(d, s); ...
//   ... const auto both = lanes::exp_lanes(d, lanes::together(s, t));  // lanes::first(both), second(both)
//   ...
// Link viete::sym3 and compile with -ffp-contract=off. Each lane has the same bits as a single call of
// sym3::exp with the kernel of that instruction set, whatever other lanes contain. For bounds and special
// values see method `fast` in exp.h.
//
// Algorithm: let A = S - (tr S / 3) I, which has trace zero. For a polynomial f(x) = sum a_k x^k,
//   f(A) = z_0 I + z_1 A + z_2 adj A,   z_k = a_k + p z_{k+2} + q z_{k+3},
// with p = |A|^2 / 2 and q = det A. This is the remainder of f(x) divided by the characteristic polynomial
// x^3 - p x - q, at x = A. Equal eigenvalues lose no accuracy and need no special cases. If p is at most
// p_limit, f is the minimax polynomial of exp. For larger p, A is divided by 2^j, and the result is squared
// j times.
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

/// S = (mean + rest) I + a, where `a` has trace zero and `rest` is the rounding error of the mean.
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

/// Returns -p (see above) for a matrix A with trace zero and the adjugate c. (-p saves a negation.)
template <class V>
static HWY_INLINE V minus_p(const Six<V>& c) {
  return Add(Add(c.xx, c.yy), c.zz);
}
template <class V>
static HWY_INLINE V determinant(const Six<V>& a, const Six<V>& c) {
  return sum_of_products(a.xx, c.xx, a.xy, c.xy, a.xz, c.xz);
}

template <class V>
struct Coefficients {
  V z0, z1, z2;
};

/// Computes the recurrence at the top of this file. `a` has the coefficients of f; the last coefficient must
/// be 1. Each step waits for the result of the previous step. Meanwhile, beside(step, z2) does other work.
template <class D, class T, std::size_t N, class V, class Beside>
static HWY_INLINE Coefficients<V> recurrence(D d, const T (&a)[N], V minus_p, V q, const Beside& beside) {
  constexpr int degree = static_cast<int>(N) - 1;
  V z2 = hn::Set(d, a[degree - 1]);
  V z1 = Sub(hn::Set(d, a[degree - 2]), minus_p);
  V z0 = NegMulAdd(minus_p, z2, Add(q, hn::Set(d, a[degree - 3])));
#pragma GCC unroll 64
  for (int step = 0; step <= degree - 4; ++step) {
    const V next = NegMulAdd(minus_p, z1, MulAdd(q, z2, hn::Set(d, a[degree - 4 - step])));
    z2 = z1;
    z1 = z0;
    z0 = next;
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

/// The reduction x = n * ln 2 + r with |r| <= 0.3467. The low bits of `shifted` are n as an integer.
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

/// Returns x * 2^n by adding n to the exponent of x. The low bits of `shifted` are n. The result must be in
/// the normal range.
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

/// Returns true if the polynomial is valid without squaring and e^mean is in the normal range.
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

/// Computes Table::lead * e^(mean + rest) in steps during recurrence(). Valid only if is_quick() is true.
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
    r = Add(x.r, m.rest);
    shifted = x.shifted;
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

/// Returns exp(S) from the parts of S and the invariants of A. Valid only if is_quick() is true.
template <class D, class V>
static HWY_INLINE Six<V> exp_by_polynomial(D d, const Split<V>& m, const Six<V>& c, V minus_p, V q) {
  using C = ExpTables<hn::TFromD<D>>;
  ScalarExp<C, D, V> scalar(d, m);
  const Coefficients<V> z = recurrence(
      d, C::matrix_exp, minus_p,
      q, [&](int step, const V&) HWY_ATTR __attribute__((always_inline)) { scalar.step(step); });
  return combine(times(z, scalar.value()), m.a, c);
}

/// If every lane has a spread up to 4.9 (float 6.9), and e^mean is in the normal range, computes exp without
/// squaring and returns true. Otherwise returns false. V is one register or Two.
template <class D, class V>
static HWY_INLINE bool exp_quick(D d, const Six<V>& s, Six<V>& e) {
  const Split<V> m = split(d, s);
  const Six<V> c = adjugate(m.a);
  const V p = minus_p(c), q = determinant(m.a, c);
  if (HWY_UNLIKELY(!hn::AllTrue(d, is_quick(d, p, m.trace)))) return false;
  e = exp_by_polynomial(d, m, c, p, q);
  return true;
}

/// Returns m * e^(x + rest) for any x. An entry that overflows or underflows does not change other entries.
/// Multiplies by four factors, because 2^n as one factor may overflow.
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

/// `count` says how often A must be halved until p is at most p_limit. If this needs more than max_squarings
/// halvings, `count` is max_squarings. `scale` is 2^-count, and `p` is the value after the halvings.
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

/// Returns exp of any input. Lanes where is_quick() is true get the bits of exp_quick(), so that results do
/// not depend on other lanes. All other lanes get e^mean * exp(A / 2^j)^(2^j), where j is Halvings::count.
/// Exceptions: exp_by_jacobi() computes NaN, infinities, diagonal matrices, results that overflow, and
/// matrices that need too many squarings.
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
  // Squares the matrix, because rounding errors of the coefficients z would grow with the squared spread.
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

/// Returns exp of one matrix in each lane, float or double, for any number of lanes.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Six<V> exp_lanes(D d, const Six<V>& s) {
  Six<V> e;
  if (HWY_LIKELY(exp_quick(d, s, e))) return e;
  const Six<V> matrix = s;  // a copy, because passing s by reference would keep s in memory
  return exp_general(d, matrix);
}

/// Returns exp of two registers at once, which is faster than two calls.
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
