// Functions of symmetric matrices in vector registers, by a closed form of the eigenvalues and Newton's
// divided differences. Internal.
//
// S = m I + s B, where m is the mean eigenvalue and B has trace zero. The power of two s makes the largest
// entry of B about 1. For p, q and C = adj B see exp-inl.h. Let g^2 = p / 3, and let 3 t be the argument of
// the complex number |q| + i sqrt(D / 27), where D is the discriminant of B. The eigenvalues of B, times the
// sign of q, are
//   2 g cos t   and   -g (cos t -+ sqrt(3) sin t).
// squared_minors() computes D so that close eigenvalues are as accurate as all others. Errors are relative to
// the largest eigenvalue. For the eigenvalues a, b and c of B, Newton's form is
//   f(B) = f(b) I + f[b,c] (B - b I) + f[a,b,c] (B - b I)(B - c I) = z0 I + z1 B + z2 C.
#if defined(VIETE_SYM3_SPECTRAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_SPECTRAL_INL_H
#undef VIETE_SYM3_SPECTRAL_INL_H
#else
#define VIETE_SYM3_SPECTRAL_INL_H
#endif

#include "sym3/exp-inl.h"
#include "sym3/spectral_tables.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

/// The eigenvalues of B are a, b and c, where b >= c are the closer pair. The eigenvalues of S are the mean
/// eigenvalue plus `size` times a, b and c.
template <class V>
struct Spectrum {
  Six<V> matrix, adjugate;  ///< B and C
  V minus_p, q;             ///< the invariants of B
  V size, a, b, c, gap;     ///< gap = b - c
  V at_a, at_b, at_c;       ///< the eigenvalues of S
};

/// Sets `power` to 2^e and `inverse` to 2^-e, where e is the binary exponent of x. x = 0 gives 0 and 2^1023
/// (float 2^127).
template <class D, class V>
static HWY_INLINE void power_of_two_below(D d, V x, V& power, V& inverse) {
  using C = SpectralTables<hn::TFromD<D>>;
  const hn::RebindToUnsigned<D> du;
  using U = hn::TFromD<decltype(du)>;
  const auto bits = hn::And(hn::BitCast(du, x), hn::Set(du, U(2 * C::exponent_bias + 1) << C::mantissa_bits));
  power = hn::BitCast(d, bits);
  inverse = hn::BitCast(d, hn::Sub(hn::Set(du, U(2 * C::exponent_bias) << C::mantissa_bits), bits));
}

template <class V>
static HWY_INLINE V largest_entry(const Six<V>& m) {
  return hn::Max(hn::Max(hn::Max(hn::Abs(m.xx), hn::Abs(m.yy)), hn::Max(hn::Abs(m.zz), hn::Abs(m.xy))),
                 hn::Max(hn::Abs(m.xz), hn::Abs(m.yz)));
}

/// Returns 4/3 of the discriminant D of B: the sum of (x_i y_j - x_j y_i)^2 over all i < j. x has the
/// coordinates of sqrt 2 * B, and y has the coordinates of sqrt 2 * (C - (tr C / 3) I). Both refer to the
/// same orthonormal basis of the matrices with trace zero. With this sum, the square root of D has an error
/// of u. With the formula D = 4 p^3 - 27 q^2, the square root would have an error of sqrt(u).
template <class D, class V>
static HWY_INLINE V squared_minors(D d, const Six<V>& b, const Six<V>& c, V minus_p) {
  using T = hn::TFromD<D>;
  const V root3 = hn::Set(d, T(1.7320508075688772)), two = hn::Set(d, T(2)), third = hn::Set(d, T(1) / T(3));
  const V x[5] = {hn::Sub(b.xx, b.yy), hn::Mul(root3, b.zz), hn::Mul(two, b.xy), hn::Mul(two, b.xz),
                  hn::Mul(two, b.yz)};
  const V y[5] = {hn::Sub(c.xx, c.yy), hn::Mul(root3, hn::NegMulAdd(third, minus_p, c.zz)),
                  hn::Mul(two, c.xy), hn::Mul(two, c.xz), hn::Mul(two, c.yz)};
  V sum = hn::Zero(d);
#pragma GCC unroll 5
  for (int i = 0; i < 5; ++i) {
#pragma GCC unroll 5
    for (int j = i + 1; j < 5; ++j) {
      const V minor = difference_of_products(x[i], y[j], x[j], y[i]);
      sum = hn::MulAdd(minor, minor, sum);
    }
  }
  return sum;
}

template <class D, class V = hn::Vec<D>>
static HWY_INLINE Spectrum<V> spectrum(D d, const Six<V>& s) {
  using T = hn::TFromD<D>;
  using C = SpectralTables<T>;
  const Split<V> m = split(d, s);
  Spectrum<V> e;
  V inverse;
  power_of_two_below(d, largest_entry(m.a), e.size, inverse);
  e.matrix = times(m.a, inverse);
  e.adjugate = adjugate(e.matrix);
  e.minus_p = minus_p(e.adjugate);
  e.q = determinant(e.matrix, e.adjugate);
  const V g2 = hn::Mul(hn::Neg(e.minus_p), hn::Set(d, T(1) / T(3))), g = hn::Sqrt(g2);
  const V sine3 =
      hn::Mul(hn::Sqrt(squared_minors(d, e.matrix, e.adjugate, e.minus_p)), hn::Set(d, T(1) / T(6)));
  const V tiny = hn::Set(d, T(1e-37));
  const V cosine3 = hn::MulAdd(hn::Add(g2, g2), g, hn::Add(hn::Abs(e.q), tiny));
  const V u = hn::Min(hn::Div(sine3, cosine3), hn::Set(d, T(1)));  // tan(3 t / 2)
  const V w = hn::Mul(u, u);
  const V sine = hn::Mul(u, horner(d, C::sine, w)), cosine = horner(d, C::cosine, w);
  const V far = hn::CopySign(hn::Mul(hn::Add(g, g), cosine), e.q);
  const V half_gap = hn::Mul(hn::Mul(g, sine), hn::Set(d, T(1.7320508075688772)));
  e.a = far;
  e.b = hn::NegMulAdd(far, hn::Set(d, T(0.5)), half_gap);
  e.c = hn::NegMulAdd(far, hn::Set(d, T(0.5)), hn::Neg(half_gap));
  e.gap = hn::Add(half_gap, half_gap);
  e.at_a = hn::Add(m.mean, hn::MulAdd(e.size, e.a, m.rest));
  e.at_b = hn::Add(m.mean, hn::MulAdd(e.size, e.b, m.rest));
  e.at_c = hn::Add(m.mean, hn::MulAdd(e.size, e.c, m.rest));
  return e;
}

/// Returns true if S is finite and its invariants are in range.
template <class D, class V>
static HWY_INLINE hn::Mask<D> has_ordinary_size(D d, const Six<V>& s) {
  using T = hn::TFromD<D>;
  const V size = largest_entry(s);
  return hn::And(is_finite(d, s), hn::And(hn::Ge(size, hn::Set(d, T(sizeof(T) == 8 ? 1e-290 : 1e-30))),
                                          hn::Le(size, hn::Set(d, T(sizeof(T) == 8 ? 1e300 : 1e37)))));
}

/// Returns true if S is positive definite and not badly conditioned, and nothing overflows or underflows.
template <class D, class V>
static HWY_INLINE hn::Mask<D> is_ordinary(D d, const Spectrum<V>& e) {
  using C = SpectralTables<hn::TFromD<D>>;
  const V low = hn::Min(e.at_a, e.at_c), high = hn::Max(e.at_a, e.at_b);
  return hn::And(hn::And(hn::Ge(low, hn::Set(d, C::smallest)), hn::Le(high, hn::Set(d, C::largest))),
                 hn::Ge(hn::Mul(low, hn::Set(d, C::condition)), high));
}

/// Returns f(S) from f(b) and the divided differences f[b,c] and f[a,b,c] for the eigenvalues of B.
template <class V>
static HWY_INLINE Six<V> newton_form(const Spectrum<V>& e, V at_b, V over_bc, V over_abc) {
  const V z1 = hn::MulAdd(e.a, over_abc, over_bc);
  const V z0 = hn::NegMulAdd(e.b, over_bc, hn::MulAdd(hn::Mul(e.a, e.a), over_abc, at_b));
  return combine({z0, z1, over_abc}, e.matrix, e.adjugate);
}

template <class V>
static HWY_INLINE Six<V> sqrt_lanes(const Spectrum<V>& e) {
  const V a = hn::Sqrt(e.at_a), b = hn::Sqrt(e.at_b), c = hn::Sqrt(e.at_c);
  const V bc = hn::Add(b, c), ab_ac = hn::Mul(hn::Add(a, b), hn::Add(a, c));
  const V t = hn::Div(e.size, hn::Mul(bc, ab_ac));
  return newton_form(e, b, hn::Mul(t, ab_ac), hn::Neg(hn::Mul(t, e.size)));
}

template <class D, class V>
static HWY_INLINE Six<V> inv_sqrt_lanes(D d, const Spectrum<V>& e) {
  const V a = hn::Sqrt(e.at_a), b = hn::Sqrt(e.at_b), c = hn::Sqrt(e.at_c);
  const V ab_ac = hn::Mul(hn::Add(a, b), hn::Add(a, c)), sums = hn::Mul(hn::Add(b, c), ab_ac);
  const V ac = hn::Mul(a, c);
  const V t = hn::Div(hn::Set(d, hn::TFromD<D>(1)), hn::Mul(hn::Mul(ac, b), sums));
  const V st = hn::Mul(e.size, t);
  return newton_form(e, hn::Mul(hn::Mul(t, ac), sums), hn::Neg(hn::Mul(hn::Mul(st, a), ab_ac)),
                     hn::Mul(hn::Mul(st, e.size), hn::Add(a, hn::Add(b, c))));
}

/// log(x / y) and slope = log(x / y) / (x - y).
template <class V>
struct LogRatio {
  V log, slope;
};

/// x and y must be positive and normal. `difference` must be x - y, computed without cancellation.
template <class D, class V>
static HWY_INLINE LogRatio<V> log_ratio(D d, V x, V y, V difference) {
  using T = hn::TFromD<D>;
  using C = SpectralTables<T>;
  const hn::RebindToUnsigned<D> du;
  using U = hn::TFromD<decltype(du)>;
  // Finds 2^k close to x / y: subtracts the bits of y from the bits of x, and keeps the exponent.
  const U shift = (U(C::exponent_bias) << C::mantissa_bits) + (U(1) << (C::mantissa_bits - 1));
  const auto bits = hn::Add(hn::Sub(hn::BitCast(du, x), hn::BitCast(du, y)), hn::Set(du, shift));
  const V power = hn::BitCast(d, hn::And(bits, hn::Set(du, U(2 * C::exponent_bias + 1) << C::mantissa_bits)));
  const auto near = hn::Eq(power, hn::Set(d, T(1)));
  // Converts the biased integer k to a number, as the low bits of 2^52 (float 2^23).
  const V magic = hn::Set(d, ExpTables<T>::round_magic / T(1.5));
  const V k = hn::Sub(hn::Or(hn::BitCast(d, hn::ShiftRight<C::mantissa_bits>(bits)), magic),
                      hn::Add(magic, hn::Set(d, T(C::exponent_bias))));
  const V scaled = hn::Mul(y, power);
  const V inverse = hn::Div(hn::Set(d, T(1)), hn::Add(x, scaled));
  const V s = hn::Mul(hn::IfThenElse(near, difference, hn::Sub(x, scaled)), inverse);
  const V series = horner(d, C::atanh, hn::Mul(s, s));
  const V twice = hn::Add(series, series);
  const V log =
      hn::MulAdd(k, hn::Set(d, C::ln2_high), hn::MulAdd(s, twice, hn::Mul(k, hn::Set(d, C::ln2_low))));
  return {log, hn::IfThenElse(near, hn::Mul(twice, inverse), hn::Div(log, difference))};
}

template <class D, class V>
static HWY_INLINE Six<V> log_lanes(D d, const Six<V>& s, const Spectrum<V>& e) {
  using T = hn::TFromD<D>;
  const V one = hn::Set(d, T(1));
  // Computes at_b - 1 from diagonal entries minus 1, which are exact if S is close to I.
  const V above = hn::Mul(hn::Add(hn::Add(hn::Sub(s.xx, one), hn::Sub(s.yy, one)), hn::Sub(s.zz, one)),
                          hn::Set(d, T(1) / T(3)));
  const V at_b = log_ratio(d, e.at_b, one, hn::MulAdd(e.size, e.b, above)).log;
  const V bc = log_ratio(d, e.at_b, e.at_c, hn::Mul(e.size, e.gap)).slope;
  const V ab = log_ratio(d, e.at_a, e.at_b, hn::Mul(e.size, hn::Sub(e.a, e.b))).slope;
  const V ac = hn::Sub(e.a, e.c);
  const V curvature = hn::Div(hn::Sub(ab, bc), hn::IfThenElse(hn::Eq(ac, hn::Zero(d)), one, ac));
  return newton_form(e, at_b, hn::Mul(e.size, bc), hn::Mul(e.size, curvature));
}

template <class D, class V>
static HWY_INLINE Three<V> eigenvalues_lanes(D d, const Spectrum<V>& e) {
  const auto far_is_top = hn::Ge(e.a, hn::Zero(d));
  return {hn::IfThenElse(far_is_top, e.at_c, e.at_a), hn::IfThenElse(far_is_top, e.at_b, e.at_c),
          hn::IfThenElse(far_is_top, e.at_a, e.at_b)};
}

/// Orthonormal eigenvectors of the eigenvalues a, b and c of a Spectrum.
template <class V>
struct Vectors {
  Three<V> a, b, c;
};

template <class V>
static HWY_INLINE V dot(const Three<V>& u, const Three<V>& v) {
  return sum_of_products(u.x, v.x, u.y, v.y, u.z, v.z);
}

template <class V>
static HWY_INLINE Three<V> combination(V s, const Three<V>& u, V t, const Three<V>& v) {
  return {MulAdd(s, u.x, Mul(t, v.x)), MulAdd(s, u.y, Mul(t, v.y)), MulAdd(s, u.z, Mul(t, v.z))};
}

template <class M, class V>
static HWY_INLINE Three<V> select(M mask, const Three<V>& yes, const Three<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

/// Returns a number to add to divisors that can be 0. Its square is positive, but 1 plus this number is 1.
template <class D>
static HWY_INLINE hn::Vec<D> next_to_nothing(D d) {
  using T = hn::TFromD<D>;
  return hn::Set(d, T(sizeof(T) == 8 ? 1e-100 : 1e-15));
}

/// Returns the unit eigenvector of the eigenvalue `a`: the column with the largest diagonal entry of
/// adj(B - a I) = adj B + a B + a^2 I, divided by its length. If B = 0, returns (1, 0, 0).
template <class D, class V>
static HWY_INLINE Three<V> far_vector(D d, const Spectrum<V>& e) {
  const Six<V>&m = e.matrix, &c = e.adjugate;
  const V square = hn::Mul(e.a, e.a), xy = hn::MulAdd(e.a, m.xy, c.xy), xz = hn::MulAdd(e.a, m.xz, c.xz),
          yz = hn::MulAdd(e.a, m.yz, c.yz);
  const V xx = hn::Add(hn::MulAdd(e.a, m.xx, hn::Add(square, c.xx)), next_to_nothing(d));
  const V yy = hn::MulAdd(e.a, m.yy, hn::Add(square, c.yy)),
          zz = hn::MulAdd(e.a, m.zz, hn::Add(square, c.zz));
  Three<V> v = {xx, xy, xz};
  v = select(hn::Gt(yy, xx), Three<V>{xy, yy, yz}, v);
  v = select(hn::Gt(zz, hn::Max(xx, yy)), Three<V>{xz, yz, zz}, v);
  const V scale = hn::Div(hn::Set(d, hn::TFromD<D>(1)), hn::Sqrt(dot(v, v)));
  return {hn::Mul(v.x, scale), hn::Mul(v.y, scale), hn::Mul(v.z, scale)};
}

/// Computes unit vectors `u` and `v` that are orthogonal to each other and to the unit vector n (Duff et al.
/// 2017, Building an orthonormal basis, revisited).
template <class D, class V>
static HWY_INLINE void complete(D d, const Three<V>& n, Three<V>& u, Three<V>& v) {
  const V one = hn::Set(d, hn::TFromD<D>(1)), sign = hn::CopySign(one, n.z);
  const V a = hn::Div(hn::Neg(one), hn::Add(sign, n.z)), b = hn::Mul(hn::Mul(n.x, n.y), a);
  const V signed_x = hn::Mul(sign, n.x);
  u = {hn::MulAdd(hn::Mul(signed_x, n.x), a, one), hn::Mul(sign, b), hn::Neg(signed_x)};
  v = {b, hn::MulAdd(hn::Mul(n.y, n.y), a, sign), hn::Neg(n.y)};
}

/// Computes the eigenvectors. If the eigenvalues b and c are close, rounding may rotate the eigenvectors of b
/// and c in their plane. The derivative remains accurate, because then entries of F are also close.
template <class D, class V>
static HWY_INLINE void put_vectors(D d, const Spectrum<V>& e, Vectors<V>& s) {
  using T = hn::TFromD<D>;
  Three<V> u, v;
  s.a = far_vector(d, e);
  complete(d, s.a, u, v);
  const Three<V> bu = times(e.matrix, u), bv = times(e.matrix, v);
  // In the basis (u, v), the 2x2 block of B is a multiple of I plus (half, cross; cross, -half).
  const V half = hn::Mul(hn::Sub(dot(u, bu), dot(v, bv)), hn::Set(d, T(0.5))), cross = dot(u, bv);
  const V radius = hn::Sqrt(hn::MulAdd(half, half, hn::Mul(cross, cross)));
  const V size = hn::Add(hn::Add(hn::Abs(half), radius), next_to_nothing(d));
  const V scale = hn::Div(hn::Set(d, T(1)), hn::Sqrt(hn::MulAdd(size, size, hn::Mul(cross, cross))));
  const V longer = hn::Mul(size, scale), shorter = hn::Mul(cross, scale);
  const auto upright = hn::Ge(half, hn::Zero(d));
  const V cosine = hn::IfThenElse(upright, longer, shorter), sine = hn::IfThenElse(upright, shorter, longer);
  s.b = combination(cosine, u, sine, v);
  s.c = combination(hn::Neg(sine), u, cosine, v);
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
