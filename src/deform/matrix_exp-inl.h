// exp of general matrices in vector registers, times a vector: included by frame_kernel-inl.h for each
// instruction set. Internal. (No #pragma once: see sym3/exp-inl.h.)
//
// D = L - (tr L / 3) I has no trace, so D^3 = J2 D + J3 I with J2 = tr(D^2) / 2 and J3 = det D (Cayley and
// Hamilton), and every power series of D is a I + b D + c D^2: a step of Horner's scheme takes two
// multiply-adds, a squaring ten. Nothing of it asks whether eigenvalues are real.
#if defined(VIETE_DEFORM_MATRIX_EXP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_DEFORM_MATRIX_EXP_INL_H
#undef VIETE_DEFORM_MATRIX_EXP_INL_H
#else
#define VIETE_DEFORM_MATRIX_EXP_INL_H
#endif

#include "sym3/exp-inl.h"
#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = viete::sym3::HWY_NAMESPACE;

// Of a series that goes to the tenth power: 1/11! is less than a float shows.
inline constexpr float inverse_factorials[] = {1.0f,         1.0f,          1.0f / 2,      1.0f / 6,
                                               1.0f / 24,    1.0f / 120,    1.0f / 720,    1.0f / 5040,
                                               1.0f / 40320, 1.0f / 362880, 1.0f / 3628800};
inline constexpr int most_squarings = 7;  // |D| up to 128: two turns are 13
inline constexpr float largest_mean = 80;

// a I + b D + c D^2.
template <class V>
struct InPowers {
  V a, b, c;
};

template <class V>
static HWY_INLINE lanes::Three<V> times(const lanes::Nine<V>& m, const lanes::Three<V>& u) {
  return {lanes::sum_of_products(m.xx, u.x, m.xy, u.y, m.xz, u.z),
          lanes::sum_of_products(m.yx, u.x, m.yy, u.y, m.yz, u.z),
          lanes::sum_of_products(m.zx, u.x, m.zy, u.y, m.zz, u.z)};
}

template <class V>
static HWY_INLINE V sum_of_squares(const lanes::Nine<V>& m) {
  const V a = lanes::sum_of_products(m.xx, m.xx, m.xy, m.xy, m.xz, m.xz);
  const V b = lanes::sum_of_products(m.yx, m.yx, m.yy, m.yy, m.yz, m.yz);
  return Add(Add(a, b), lanes::sum_of_products(m.zx, m.zx, m.zy, m.zy, m.zz, m.zz));
}

template <class V>
static HWY_INLINE V determinant(const lanes::Nine<V>& m) {
  return lanes::sum_of_products(m.xx, lanes::difference_of_products(m.yy, m.zz, m.yz, m.zy), m.xy,
                                lanes::difference_of_products(m.yz, m.zx, m.yx, m.zz), m.xz,
                                lanes::difference_of_products(m.yx, m.zy, m.yy, m.zx));
}

template <class D, class V>
static HWY_INLINE V trace_of_square_halved(D d, const lanes::Nine<V>& m) {
  const V diagonal = lanes::sum_of_products(m.xx, m.xx, m.yy, m.yy, m.zz, m.zz);
  const V across = lanes::sum_of_products(m.xy, m.yx, m.xz, m.zx, m.yz, m.zy);
  return hn::MulAdd(diagonal, hn::Set(d, 0.5f), across);
}

template <class D, class V>
static HWY_INLINE InPowers<V> series(D d, V j2, V j3) {
  constexpr int last = sizeof(inverse_factorials) / sizeof(float) - 1;
  InPowers<V> s{hn::Set(d, inverse_factorials[last - 2]), hn::Set(d, inverse_factorials[last - 1]),
                hn::Set(d, inverse_factorials[last])};
#pragma GCC unroll 16
  for (int n = last - 3; n >= 0; --n)
    s = {hn::MulAdd(s.c, j3, hn::Set(d, inverse_factorials[n])), hn::MulAdd(s.c, j2, s.a), s.b};
  return s;
}

template <class V>
static HWY_INLINE InPowers<V> squared(const InPowers<V>& s, V j2, V j3) {
  const V bc2 = Mul(s.b, Add(s.c, s.c)), cc = Mul(s.c, s.c), a2 = Add(s.a, s.a);
  return {MulAdd(s.a, s.a, Mul(bc2, j3)), MulAdd(a2, s.b, MulAdd(bc2, j2, Mul(cc, j3))),
          MulAdd(s.b, s.b, MulAdd(a2, s.c, Mul(cc, j2)))};
}

template <class M, class V>
static HWY_INLINE InPowers<V> select(M mask, const InPowers<V>& yes, const InPowers<V>& no) {
  return {hn::IfThenElse(mask, yes.a, no.a), hn::IfThenElse(mask, yes.b, no.b),
          hn::IfThenElse(mask, yes.c, no.c)};
}

// e^x, x up to largest_mean in size.
template <class D, class V>
static HWY_INLINE V exp_of_mean(D d, V x) {
  const V limit = hn::Set(d, largest_mean);
  const auto r = lanes::reduce(d, hn::Min(hn::Max(x, hn::Neg(limit)), limit));
  return lanes::add_to_exponent(d, lanes::horner(d, viete::sym3::ExpTables<float>::scalar_exp, r.r),
                                r.shifted);
}

// How often a matrix is halved until its norm, here squared, is 1 or less, and what that makes of it.
template <class V>
struct Halvings {
  V scale, count;
};

template <class D, class V = hn::Vec<D>>
static HWY_INLINE Halvings<V> halvings(D d, V square) {
  const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f), quarter = hn::Set(d, 0.25f);
  Halvings<V> h{one, hn::Zero(d)};
  for (int j = 0; j < most_squarings; ++j) {
    const auto large = hn::Gt(square, one);
    if (hn::AllFalse(d, large)) break;
    square = hn::IfThenElse(large, hn::Mul(square, quarter), square);
    h.scale = hn::IfThenElse(large, hn::Mul(h.scale, half), h.scale);
    h.count = hn::Add(h.count, hn::IfThenElseZero(large, one));
  }
  return h;
}

/// exp(L) u. Each lane takes the squarings that it needs, whatever the lanes beside it.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE lanes::Three<V> exp_times(D d, const lanes::Nine<V>& log, const lanes::Three<V>& u) {
  const V mean = hn::Mul(hn::Set(d, 1.0f / 3), hn::Add(log.xx, hn::Add(log.yy, log.zz)));
  lanes::Nine<V> m = log;
  m.xx = hn::Sub(m.xx, mean), m.yy = hn::Sub(m.yy, mean), m.zz = hn::Sub(m.zz, mean);
  const auto [scale, squarings] = halvings(d, sum_of_squares(m));
  const V scale2 = hn::Mul(scale, scale);
  const V j2 = hn::Mul(scale2, trace_of_square_halved(d, m));
  const V j3 = hn::Mul(hn::Mul(scale2, scale), determinant(m));
  InPowers<V> s = series(d, j2, j3);
  for (int j = 0; j < most_squarings; ++j) {
    const auto more = hn::Gt(squarings, hn::Set(d, static_cast<float>(j)));
    if (hn::AllFalse(d, more)) break;
    s = select(more, squared(s, j2, j3), s);
  }
  const V factor = exp_of_mean(d, mean);
  const V a = hn::Mul(factor, s.a), b = hn::Mul(factor, hn::Mul(scale, s.b));
  const V c = hn::Mul(factor, hn::Mul(scale2, s.c));
  const lanes::Three<V> v = times(m, u), w = times(m, v);
  return {lanes::sum_of_products(a, u.x, b, v.x, c, w.x), lanes::sum_of_products(a, u.y, b, v.y, c, w.y),
          lanes::sum_of_products(a, u.z, b, v.z, c, w.z)};
}

template <class V>
static HWY_INLINE lanes::Nine<V> first_matrix(const lanes::Nine<lanes::Two<V>>& m) {
  return {m.xx.a, m.xy.a, m.xz.a, m.yx.a, m.yy.a, m.yz.a, m.zx.a, m.zy.a, m.zz.a};
}
template <class V>
static HWY_INLINE lanes::Nine<V> second_matrix(const lanes::Nine<lanes::Two<V>>& m) {
  return {m.xx.b, m.xy.b, m.xz.b, m.yx.b, m.yy.b, m.yz.b, m.zx.b, m.zy.b, m.zz.b};
}

template <class D, class V>
static HWY_INLINE lanes::Three<lanes::Two<V>> exp_times(D d, const lanes::Nine<lanes::Two<V>>& m,
                                                        const lanes::Three<lanes::Two<V>>& u) {
  return lanes::together(exp_times(d, first_matrix(m), lanes::first(u)),
                         exp_times(d, second_matrix(m), lanes::second(u)));
}

// (mean + D) p.
template <class V>
static HWY_INLINE InPowers<V> shifted(const InPowers<V>& p, V mean, V j2, V j3) {
  return {hn::MulAdd(mean, p.a, hn::Mul(p.c, j3)), hn::MulAdd(mean, p.b, hn::MulAdd(p.c, j2, p.a)),
          hn::MulAdd(mean, p.c, p.b)};
}

/// phi(L) u, phi(L) = (e^L - I) / L = I + L / 2 + L^2 / 6 + ...: as exp_times(), in powers of D, but that the
/// mean stays in L; and phi(2 A) = phi(A) + A phi(A)^2 / 2.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE lanes::Three<V> phi_times(D d, const lanes::Nine<V>& log, const lanes::Three<V>& u) {
  const auto [scale, doublings] = halvings(d, sum_of_squares(log));
  const V unscaled = hn::Mul(hn::Set(d, 1.0f / 3), hn::Add(log.xx, hn::Add(log.yy, log.zz)));
  lanes::Nine<V> m = log;
  m.xx = hn::Sub(m.xx, unscaled), m.yy = hn::Sub(m.yy, unscaled), m.zz = hn::Sub(m.zz, unscaled);
  const V scale2 = hn::Mul(scale, scale), mean = hn::Mul(scale, unscaled);
  const V j2 = hn::Mul(scale2, trace_of_square_halved(d, m));
  const V j3 = hn::Mul(hn::Mul(scale2, scale), determinant(m));
  constexpr int last = sizeof(inverse_factorials) / sizeof(float) - 1;
  InPowers<V> p{hn::Set(d, inverse_factorials[last]), hn::Zero(d), hn::Zero(d)};
#pragma GCC unroll 16
  for (int n = last - 1; n >= 1; --n) {
    p = shifted(p, mean, j2, j3);
    p.a = hn::Add(p.a, hn::Set(d, inverse_factorials[n]));
  }
  V factor = hn::Set(d, 0.5f);  // of A in units of the scaled one, and a half
  for (int j = 0; j < most_squarings; ++j) {
    const auto more = hn::Gt(doublings, hn::Set(d, static_cast<float>(j)));
    if (hn::AllFalse(d, more)) break;
    const InPowers<V> q = shifted(squared(p, j2, j3), mean, j2, j3);
    const InPowers<V> next{hn::MulAdd(factor, q.a, p.a), hn::MulAdd(factor, q.b, p.b),
                           hn::MulAdd(factor, q.c, p.c)};
    p = select(more, next, p);
    factor = hn::Add(factor, factor);
  }
  const V b = hn::Mul(scale, p.b), c = hn::Mul(scale2, p.c);
  const lanes::Three<V> v = times(m, u), w = times(m, v);
  return {lanes::sum_of_products(p.a, u.x, b, v.x, c, w.x), lanes::sum_of_products(p.a, u.y, b, v.y, c, w.y),
          lanes::sum_of_products(p.a, u.z, b, v.z, c, w.z)};
}

template <class D, class V>
static HWY_INLINE lanes::Three<lanes::Two<V>> phi_times(D d, const lanes::Nine<lanes::Two<V>>& m,
                                                        const lanes::Three<lanes::Two<V>>& u) {
  return lanes::together(phi_times(d, first_matrix(m), lanes::first(u)),
                         phi_times(d, second_matrix(m), lanes::second(u)));
}

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
