// Eigenvectors of symmetric matrices, in vector registers. Internal.
#if defined(VIETE_SYM3_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_VECTORS_INL_H
#undef VIETE_SYM3_VECTORS_INL_H
#else
#define VIETE_SYM3_VECTORS_INL_H
#endif

#include "sym3/spectral-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

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
