// exp of rotation vectors in vector registers: the text behind every kernel, for fused loops elsewhere too.
// (No #pragma once: Highway's foreach_target includes this text again for each target.) How to use it: exp-inl.h.
// Bounds and special values: rotation.h.
//
// Half the angle: h = |w|^2 / 4, cos(sqrt h) and sin(sqrt h) / (2 sqrt h) are polynomials in h up to 3.24 radians,
// which gives the quaternion without a root and without a case for small angles; the matrix follows by products.
#if defined(VIETE_SYM3_ROTATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_ROTATION_INL_H
#undef VIETE_SYM3_ROTATION_INL_H
#else
#define VIETE_SYM3_ROTATION_INL_H
#endif

#include "sym3/lanes-inl.h"
#include "sym3/rotation_tables.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

/// Unit quaternions, scalar part first.
template <class V>
struct Quaternion {
  V w, x, y, z;
};

template <class V>
static HWY_INLINE Quaternion<V> half_angle_quaternion(V cosine, V sine, const Three<V>& w) {
  return {cosine, hn::Mul(sine, w.x), hn::Mul(sine, w.y), hn::Mul(sine, w.z)};
}

template <class D, class V = hn::Vec<D>>
static HWY_INLINE Nine<V> to_matrix(D d, const Quaternion<V>& q) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const V x2 = hn::Add(q.x, q.x), y2 = hn::Add(q.y, q.y), z2 = hn::Add(q.z, q.z);
  const V xx = hn::Mul(x2, q.x), wx = hn::Mul(x2, q.w), wy = hn::Mul(y2, q.w), wz = hn::Mul(z2, q.w);
  const V yy = hn::Mul(y2, q.y);
  return {hn::NegMulAdd(z2, q.z, hn::Sub(one, yy)), hn::MulSub(x2, q.y, wz),  hn::MulAdd(x2, q.z, wy),
          hn::MulAdd(x2, q.y, wz),  hn::NegMulAdd(z2, q.z, hn::Sub(one, xx)), hn::MulSub(y2, q.z, wx),
          hn::MulSub(x2, q.z, wy),  hn::MulAdd(y2, q.z, wx),  hn::Sub(hn::Sub(one, xx), yy)};
}

/// |w|^2 / 4; NaN or infinite where w is, and where it overflows.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE V quarter_of_square(D d, const Three<V>& w) {
  return hn::Mul(sum_of_products(w.x, w.x, w.y, w.y, w.z, w.z), hn::Set(d, hn::TFromD<D>(0.25)));
}

/// Angles up to 3.24 in every lane (h up to h_limit).
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Nine<V> exp_rotation_quick(D d, const Three<V>& w, V h) {
  using C = RotationTables<hn::TFromD<D>>;
  return to_matrix(d, half_angle_quaternion(horner(d, C::cosine, h), horner(d, C::sine, h), w));
}

/// Any angle: the lanes beyond one by one.
template <class D, class V = hn::Vec<D>>
static HWY_NOINLINE Nine<V> exp_rotation_general(D d, const Three<V>& w, const V& h) {
  using T = hn::TFromD<D>;
  using C = RotationTables<T>;
  constexpr std::size_t lanes = hn::MaxLanes(D());
  HWY_ALIGN T x[lanes], y[lanes], z[lanes], cosine[lanes], sine[lanes], hs[lanes];
  hn::Store(w.x, d, x), hn::Store(w.y, d, y), hn::Store(w.z, d, z), hn::Store(h, d, hs);
  hn::Store(horner(d, C::cosine, h), d, cosine), hn::Store(horner(d, C::sine, h), d, sine);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    if (hs[i] <= C::h_limit) continue;
    const T one[3] = {x[i], y[i], z[i]};
    T both[2];
    half_angle(one, both);
    cosine[i] = both[0], sine[i] = both[1];
  }
  return to_matrix(d, half_angle_quaternion(hn::Load(d, cosine), hn::Load(d, sine), w));
}

/// The rotations about w / |w| by |w| radians, one a lane. T = float or double; any number of lanes.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Nine<V> exp_rotation_lanes(D d, const Three<V>& w) {
  const V h = quarter_of_square(d, w);
  const auto ok = hn::Le(h, hn::Set(d, RotationTables<hn::TFromD<D>>::h_limit));
  if (HWY_LIKELY(hn::AllTrue(d, ok))) return exp_rotation_quick(d, w, h);
  return exp_rotation_general(d, w, h);
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
