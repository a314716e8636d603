// Matrices in vector registers. Each lane has one matrix, and each register has one entry of these matrices.
//
// Headers *-inl.h have include guards instead of #pragma once, because foreach_target of Highway includes
// each header again for each instruction set.
#if defined(VIETE_SYM3_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_SYM3_LANES_INL_H
#undef VIETE_SYM3_LANES_INL_H
#else
#define VIETE_SYM3_LANES_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A symmetric matrix in each lane. The copy constructor copies entry by entry, because GCC would copy the
/// whole structure through memory.
template <class V>
struct Six {
  V xx, xy, xz, yy, yz, zz;

  Six() = default;
  HWY_INLINE Six(V xx, V xy, V xz, V yy, V yz, V zz) : xx(xx), xy(xy), xz(xz), yy(yy), yz(yz), zz(zz) {}
  HWY_INLINE Six(const Six& m) : Six(m.xx, m.xy, m.xz, m.yy, m.yz, m.zz) {}
  HWY_INLINE Six& operator=(const Six& m) {
    xx = m.xx;
    xy = m.xy;
    xz = m.xz;
    yy = m.yy;
    yz = m.yz;
    zz = m.zz;
    return *this;
  }
};

template <class V>
struct Three {
  V x, y, z;
};

template <class V>
struct Nine {
  V xx, xy, xz, yx, yy, yz, zx, zy, zz;
};

/// Two registers. While one register waits for a result, the processor computes the other. If a function
/// calls Add and other operations without hn::, argument-dependent lookup finds the overloads below, and the
/// function accepts one register or Two.
template <class V>
struct Two {
  V a, b;

  Two() = default;
  HWY_INLINE Two(V both) : a(both), b(both) {}
  HWY_INLINE Two(V a, V b) : a(a), b(b) {}

  friend HWY_INLINE Two Add(Two x, Two y) { return {hn::Add(x.a, y.a), hn::Add(x.b, y.b)}; }
  friend HWY_INLINE Two Sub(Two x, Two y) { return {hn::Sub(x.a, y.a), hn::Sub(x.b, y.b)}; }
  friend HWY_INLINE Two Mul(Two x, Two y) { return {hn::Mul(x.a, y.a), hn::Mul(x.b, y.b)}; }
  friend HWY_INLINE Two MulAdd(Two x, Two y, Two z) {
    return {hn::MulAdd(x.a, y.a, z.a), hn::MulAdd(x.b, y.b, z.b)};
  }
  friend HWY_INLINE Two MulSub(Two x, Two y, Two z) {
    return {hn::MulSub(x.a, y.a, z.a), hn::MulSub(x.b, y.b, z.b)};
  }
  friend HWY_INLINE Two NegMulAdd(Two x, Two y, Two z) {
    return {hn::NegMulAdd(x.a, y.a, z.a), hn::NegMulAdd(x.b, y.b, z.b)};
  }
};

template <class V>
static HWY_INLINE Six<Two<V>> together(const Six<V>& a, const Six<V>& b) {
  return {{a.xx, b.xx}, {a.xy, b.xy}, {a.xz, b.xz}, {a.yy, b.yy}, {a.yz, b.yz}, {a.zz, b.zz}};
}
template <class V>
static HWY_INLINE Six<V> first(const Six<Two<V>>& m) {
  return {m.xx.a, m.xy.a, m.xz.a, m.yy.a, m.yz.a, m.zz.a};
}
template <class V>
static HWY_INLINE Six<V> second(const Six<Two<V>>& m) {
  return {m.xx.b, m.xy.b, m.xz.b, m.yy.b, m.yz.b, m.zz.b};
}

template <class V>
static HWY_INLINE Three<Two<V>> together(const Three<V>& a, const Three<V>& b) {
  return {{a.x, b.x}, {a.y, b.y}, {a.z, b.z}};
}
template <class V>
static HWY_INLINE Three<V> first(const Three<Two<V>>& u) {
  return {u.x.a, u.y.a, u.z.a};
}
template <class V>
static HWY_INLINE Three<V> second(const Three<Two<V>>& u) {
  return {u.x.b, u.y.b, u.z.b};
}

template <class V>
static HWY_INLINE Six<V> times(const Six<V>& m, V s) {
  return {hn::Mul(m.xx, s), hn::Mul(m.xy, s), hn::Mul(m.xz, s),
          hn::Mul(m.yy, s), hn::Mul(m.yz, s), hn::Mul(m.zz, s)};
}

template <class M, class V>
static HWY_INLINE Six<V> select(M mask, const Six<V>& yes, const Six<V>& no) {
  return {hn::IfThenElse(mask, yes.xx, no.xx), hn::IfThenElse(mask, yes.xy, no.xy),
          hn::IfThenElse(mask, yes.xz, no.xz), hn::IfThenElse(mask, yes.yy, no.yy),
          hn::IfThenElse(mask, yes.yz, no.yz), hn::IfThenElse(mask, yes.zz, no.zz)};
}

template <class V>
static HWY_INLINE V sum_of_products(V a, V b, V c, V d, V e, V f) {
  return MulAdd(a, b, MulAdd(c, d, Mul(e, f)));
}

template <class V>
static HWY_INLINE Six<V> square(const Six<V>& m) {
  return {sum_of_products(m.xx, m.xx, m.xy, m.xy, m.xz, m.xz),
          sum_of_products(m.xx, m.xy, m.xy, m.yy, m.xz, m.yz),
          sum_of_products(m.xx, m.xz, m.xy, m.yz, m.xz, m.zz),
          sum_of_products(m.yy, m.yy, m.xy, m.xy, m.yz, m.yz),
          sum_of_products(m.xy, m.xz, m.yy, m.yz, m.yz, m.zz),
          sum_of_products(m.zz, m.zz, m.xz, m.xz, m.yz, m.yz)};
}

template <class V>
static HWY_INLINE V difference_of_products(V a, V b, V c, V d) {
  return MulSub(a, b, Mul(c, d));
}

template <class V>
static HWY_INLINE Three<V> cross(const Three<V>& a, const Three<V>& b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

template <class V>
static HWY_INLINE Three<V> times(const Six<V>& m, const Three<V>& u) {
  return {sum_of_products(m.xx, u.x, m.xy, u.y, m.xz, u.z), sum_of_products(m.xy, u.x, m.yy, u.y, m.yz, u.z),
          sum_of_products(m.xz, u.x, m.yz, u.y, m.zz, u.z)};
}

template <class V>
static HWY_INLINE Six<V> adjugate(const Six<V>& a) {
  return {difference_of_products(a.yy, a.zz, a.yz, a.yz), difference_of_products(a.xz, a.yz, a.xy, a.zz),
          difference_of_products(a.xy, a.yz, a.xz, a.yy), difference_of_products(a.xx, a.zz, a.xz, a.xz),
          difference_of_products(a.xy, a.xz, a.xx, a.yz), difference_of_products(a.xx, a.yy, a.xy, a.xy)};
}

template <class D, class V>
static HWY_INLINE hn::Mask<D> is_finite(D d, const Six<V>& m) {
  const V zero = hn::Zero(d);
  const V a = hn::MulAdd(m.xx, zero, hn::MulAdd(m.xy, zero, hn::Mul(m.xz, zero)));
  const V b = hn::MulAdd(m.yy, zero, hn::MulAdd(m.yz, zero, hn::Mul(m.zz, zero)));
  return hn::Eq(hn::Add(a, b), zero);
}

template <class D, class V>
static HWY_INLINE hn::Mask<D> is_diagonal(D d, const Six<V>& m) {
  const V zero = hn::Zero(d);
  return hn::And(hn::Eq(m.xy, zero), hn::And(hn::Eq(m.xz, zero), hn::Eq(m.yz, zero)));
}

/// Returns (c[0] + c[1] * x + c[2] * x^2 + ...) * scale. The compiler computes c[k] * scale.
template <class D, class T, std::size_t N, class V>
static HWY_INLINE V horner(D d, const T (&c)[N], V x, T scale = T(1)) {
  V sum = hn::Set(d, c[N - 1] * scale);
#pragma GCC unroll 32
  for (int k = static_cast<int>(N) - 2; k >= 0; --k) sum = MulAdd(sum, x, hn::Set(d, c[k] * scale));
  return sum;
}

/// For each lane of the mask, calls one(from, to). `from` has the N numbers of `in` in this lane. The M
/// numbers of `to` replace the numbers of `out` in this lane.
template <class D, class V, int N, int M, class One>
static HWY_NOINLINE void replace_lanes(D d, hn::Mask<D> mask, const V (&in)[N], V (&out)[M], One one) {
  using T = hn::TFromD<D>;
  constexpr std::size_t lanes = hn::MaxLanes(D());
  HWY_ALIGN T from[N][lanes], to[M][lanes], flag[lanes];
  for (int k = 0; k < N; ++k) hn::Store(in[k], d, from[k]);
  for (int k = 0; k < M; ++k) hn::Store(out[k], d, to[k]);
  hn::Store(hn::IfThenElseZero(mask, hn::Set(d, T(1))), d, flag);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    if (flag[i] == 0) continue;
    T a[N], b[M];
    for (int k = 0; k < N; ++k) a[k] = from[k][i];
    one(a, b);
    for (int k = 0; k < M; ++k) to[k][i] = b[k];
  }
  for (int k = 0; k < M; ++k) out[k] = hn::Load(d, to[k]);
}

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
