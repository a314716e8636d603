// exp of rotation vectors and log of rotations in vector registers. For an example see exp-inl.h. For bounds
// and special values see rotation.h.
//
// exp computes the quaternion from cos and sin of half the angle. Up to 3.24 radians, cos(sqrt h) and
// sin(sqrt h) / (2 sqrt h) are polynomials in h = |w|^2 / 4. log uses a polynomial in t^2 for atan(t) / t,
// where t is the tangent of a quarter of the angle. t is at most 1. Therefore small angles and half turns
// need no special cases.
#if defined(VIETE_SYM3_ROTATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_ROTATION_INL_H
#undef VIETE_SYM3_ROTATION_INL_H
#else
#define VIETE_SYM3_ROTATION_INL_H
#endif

#include "sym3/fallback.h"
#include "sym3/lanes-inl.h"
#include "sym3/rotation_tables.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

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
  return {hn::NegMulAdd(z2, q.z, hn::Sub(one, yy)),
          hn::MulSub(x2, q.y, wz),
          hn::MulAdd(x2, q.z, wy),
          hn::MulAdd(x2, q.y, wz),
          hn::NegMulAdd(z2, q.z, hn::Sub(one, xx)),
          hn::MulSub(y2, q.z, wx),
          hn::MulSub(x2, q.z, wy),
          hn::MulAdd(y2, q.z, wx),
          hn::Sub(hn::Sub(one, xx), yy)};
}

/// The numbers cos(angle / 2) and sin(angle / 2) / angle.
template <class V>
struct HalfAngle {
  V cosine, sine;
};

/// Returns h = |w|^2 / 4. If w is NaN or infinite, or if h overflows, h is NaN or infinite.
template <class D, class V>
static HWY_INLINE V quarter_of_square(D d, const Three<V>& w) {
  return Mul(sum_of_products(w.x, w.x, w.y, w.y, w.z, w.z), hn::Set(d, hn::TFromD<D>(0.25)));
}

/// Returns true if the polynomials are valid: for angles up to 3.24 radians.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE hn::Mask<D> is_small_angle(D d, V h) {
  return hn::Le(h, hn::Set(d, RotationTables<hn::TFromD<D>>::h_limit));
}
template <class D, class V>
static HWY_INLINE hn::Mask<D> is_small_angle(D d, Two<V> h) {
  return hn::And(is_small_angle(d, h.a), is_small_angle(d, h.b));
}

template <class D, class V>
static HWY_INLINE HalfAngle<V> half_angle_quick(D d, V h) {
  using C = RotationTables<hn::TFromD<D>>;
  return {horner(d, C::cosine, h), horner(d, C::sine, h)};
}

/// Works for any angle. Lanes with angles above 3.24 radians are computed one by one.
template <class D, class V = hn::Vec<D>>
static HWY_NOINLINE HalfAngle<V> half_angle_general(D d, const Three<V>& w, const V& h) {
  using T = hn::TFromD<D>;
  const HalfAngle<V> quick = half_angle_quick(d, h);
  const V from[3] = {w.x, w.y, w.z};
  V to[2] = {quick.cosine, quick.sine};
  replace_lanes(d, hn::Not(is_small_angle(d, h)), from, to,
                [](const T* one, T* both) { half_angle(one, both); });
  return {to[0], to[1]};
}
template <class D, class V>
static HWY_INLINE HalfAngle<Two<V>> half_angle_general(D d, const Three<Two<V>>& w, const Two<V>& h) {
  const Three<V> wa = first(w), wb = second(w);
  const V ha = h.a, hb = h.b;
  const HalfAngle<V> a = half_angle_general(d, wa, ha), b = half_angle_general(d, wb, hb);
  return {{a.cosine, b.cosine}, {a.sine, b.sine}};
}

template <class D, class V>
static HWY_INLINE HalfAngle<V> half_angle_lanes(D d, const Three<V>& w) {
  const V h = quarter_of_square(d, w);
  if (HWY_LIKELY(hn::AllTrue(d, is_small_angle(d, h)))) return half_angle_quick(d, h);
  const Three<V> vector = w;  // a copy, because passing w by reference would keep w in memory
  return half_angle_general(d, vector, h);
}

/// Returns in each lane the rotation about w / |w| by |w| radians, float or double, for any number of lanes.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Nine<V> exp_rotation_lanes(D d, const Three<V>& w) {
  const HalfAngle<V> half = half_angle_lanes(d, w);
  return to_matrix(d, half_angle_quaternion(half.cosine, half.sine, w));
}

/// Rotates the vector u by the rotation vector w without a matrix. Returns
/// u + 2 c s * cross(w, u) + 2 s^2 * cross(w, cross(w, u)), where c and s are the cosine and sine of
/// HalfAngle. V is one register or Two.
template <class D, class V>
static HWY_INLINE Three<V> rotate_lanes(D d, const Three<V>& w, const Three<V>& u) {
  const HalfAngle<V> half = half_angle_lanes(d, w);
  const V sine2 = Add(half.sine, half.sine);
  const V first_order = Mul(half.cosine, sine2), second_order = Mul(half.sine, sine2);
  const Three<V> t = cross(w, u), tt = cross(w, t);
  return {MulAdd(second_order, tt.x, MulAdd(first_order, t.x, u.x)),
          MulAdd(second_order, tt.y, MulAdd(first_order, t.y, u.y)),
          MulAdd(second_order, tt.z, MulAdd(first_order, t.z, u.z))};
}

template <class M, class V>
static HWY_INLINE Quaternion<V> select(M mask, const Quaternion<V>& yes, const Quaternion<V>& no) {
  return {hn::IfThenElse(mask, yes.w, no.w), hn::IfThenElse(mask, yes.x, no.x),
          hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

/// Returns a multiple of a rotation's quaternion, with a length between 2 and 4. The computation starts from
/// the largest component to avoid cancellation (Shepperd 1978).
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Quaternion<V> to_quaternion(D d, const Nine<V>& r) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const V dx = hn::Sub(r.zy, r.yz), dy = hn::Sub(r.xz, r.zx), dz = hn::Sub(r.yx, r.xy);
  const V sx = hn::Add(r.zy, r.yz), sy = hn::Add(r.xz, r.zx), sz = hn::Add(r.yx, r.xy);
  const V trace = hn::Add(r.xx, hn::Add(r.yy, r.zz));
  const Quaternion<V> by_w = {hn::Add(one, trace), dx, dy, dz};
  const Quaternion<V> by_x = {dx, hn::Sub(hn::Sub(hn::Add(one, r.xx), r.yy), r.zz), sz, sy};
  const Quaternion<V> by_y = {dy, sz, hn::Sub(hn::Sub(hn::Add(one, r.yy), r.xx), r.zz), sx};
  const Quaternion<V> by_z = {dz, sy, sx, hn::Sub(hn::Sub(hn::Add(one, r.zz), r.xx), r.yy)};
  const auto x_is_largest = hn::And(hn::Ge(r.xx, r.yy), hn::Ge(r.xx, r.zz));
  const auto w_is_largest = hn::Ge(trace, hn::Max(r.xx, hn::Max(r.yy, r.zz)));
  return select(w_is_largest, by_w, select(x_is_largest, by_x, select(hn::Ge(r.yy, r.zz), by_y, by_z)));
}

/// Returns the first nonzero component of q. If this component is positive, the rotation angle is at most pi.
template <class D, class V>
static HWY_INLINE V first_but_zero(D d, const Quaternion<V>& q) {
  const V zero = hn::Zero(d);
  const V yz = hn::IfThenElse(hn::Eq(q.y, zero), q.z, q.y), xyz = hn::IfThenElse(hn::Eq(q.x, zero), yz, q.x);
  return hn::IfThenElse(hn::Eq(q.w, zero), xyz, q.w);
}

/// Returns the rotation vector of the rotation in each lane, float or double, for any number of lanes.
/// Infinite entries and entries whose squares overflow give NaN.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE Three<V> log_rotation_lanes(D d, const Nine<V>& r) {
  using T = hn::TFromD<D>;
  using C = RotationTables<T>;
  const Quaternion<V> q = to_quaternion(d, r);
  const V sine2 = sum_of_products(q.x, q.x, q.y, q.y, q.z, q.z);
  const V length2 = hn::MulAdd(q.w, q.w, sine2);
  const V one_or_nan = hn::MulAdd(length2, hn::Zero(d), hn::Set(d, T(1)));
  // The tangent of a quarter of the angle, divided by the length of (x, y, z).
  const V tangent = hn::Div(one_or_nan, hn::Add(hn::Abs(q.w), hn::Sqrt(length2)));
  const V t2 = hn::Mul(sine2, hn::Mul(tangent, tangent)), t4 = hn::Mul(t2, t2);
  const V arc = hn::MulAdd(horner(d, C::arc_odd, t4, T(4)), t2, horner(d, C::arc_even, t4, T(4)));
  const V factor = hn::CopySign(hn::Mul(arc, tangent), first_but_zero(d, q));
  return {hn::Mul(q.x, factor), hn::Mul(q.y, factor), hn::Mul(q.z, factor)};
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
