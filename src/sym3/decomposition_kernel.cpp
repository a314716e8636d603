// Eigenvectors, singular value decompositions and polar decompositions of batches, compiled once for each
// instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/decomposition_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/batch-inl.h"
#include "sym3/fallback.h"
#include "sym3/polar-inl.h"
#include "sym3/spectral-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

template <class V>
static HWY_INLINE Three<V> times(const Three<V>& u, V s) {
  return {hn::Mul(u.x, s), hn::Mul(u.y, s), hn::Mul(u.z, s)};
}

/// Returns 1, or -1 if the component of `u` with the largest absolute value is negative.
template <class D, class V>
static HWY_INLINE V sign_of_largest(D d, const Three<V>& u) {
  const V x = hn::Abs(u.x), y = hn::Abs(u.y), z = hn::Abs(u.z);
  const V first = hn::IfThenElse(hn::Ge(x, y), u.x, u.y);
  return hn::CopySign(hn::Set(d, hn::TFromD<D>(1)), hn::IfThenElse(hn::Ge(hn::Max(x, y), z), first, u.z));
}

template <class V>
static HWY_INLINE Nine<V> from_columns(const Three<V>& a, const Three<V>& b, const Three<V>& c) {
  return {a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
}

struct Eigh {
  static constexpr int in = 6, out = 12;
  static constexpr auto by_jacobi = [](const auto* in, auto* out) { eigh_by_jacobi(in, out); };

  template <class D, class V>
  static HWY_INLINE hn::Mask<D> lanes(D d, const V (&in)[6], V (&out)[12]) {
    const Six<V> s = six(in);
    const Spectrum<V> e = spectrum(d, s);
    const Three<V> values = eigenvalues_lanes(d, e);
    Vectors<V> v;
    put_vectors(d, e, v);
    const auto far_is_top = hn::Ge(e.a, hn::Zero(d));
    Three<V> top = select(far_is_top, v.a, v.b), middle = select(far_is_top, v.b, v.c);
    top = times(top, sign_of_largest(d, top));
    middle = times(middle, sign_of_largest(d, middle));
    out[0] = values.x;
    out[1] = values.y;
    out[2] = values.z;
    put_nine(from_columns(cross(middle, top), middle, top), out + 3);
    return has_ordinary_size(d, s);
  }
};

/// M V = W. The rotations below change W and V, and make the columns of W orthogonal.
template <class V>
struct Columns {
  Three<V> w[3], v[3];
};

/// The angle between columns of W counts as right if its cosine is at most this number.
template <class T>
static constexpr T right_angle = T(sizeof(T) == 8 ? 0x1p-51 : 0x1p-22);

/// Returns the lanes in which the columns p and q of W are not orthogonal.
template <class D, class V>
static HWY_INLINE hn::Mask<D> is_oblique(D d, V pp, V qq, V pq) {
  constexpr auto limit = right_angle<hn::TFromD<D>>;
  return hn::Gt(hn::Mul(pq, pq), hn::Mul(hn::Mul(pp, hn::Set(d, limit * limit)), qq));
}

/// Makes the columns p and q orthogonal, by a Jacobi rotation (Golub and Van Loan, Matrix
/// Computations, 8.6.3). Lanes that are orthogonal keep all bits, so that results do not depend on the other
/// lanes.
template <class D, class V>
static HWY_INLINE void rotate_columns(D d, int p, int q, Columns<V>& m) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const V pp = dot(m.w[p], m.w[p]), qq = dot(m.w[q], m.w[q]), pq = dot(m.w[p], m.w[q]);
  const auto oblique = is_oblique(d, pp, qq, pq);
  const V zeta = hn::Div(hn::Sub(qq, pp), hn::Add(pq, pq));
  const V t = hn::Div(hn::CopySign(one, zeta), hn::Add(hn::Abs(zeta), hn::Sqrt(hn::MulAdd(zeta, zeta, one))));
  const V c = hn::Div(one, hn::Sqrt(hn::MulAdd(t, t, one))), s = hn::Mul(c, t);
  const auto turn = [&](Three<V> & a, Three<V> & b) HWY_ATTR __attribute__((always_inline)) {
    const Three<V> old = a;
    a = select(oblique, combination(c, a, hn::Neg(s), b), a);
    b = select(oblique, combination(s, old, c, b), b);
  };
  turn(m.w[p], m.w[q]);
  turn(m.v[p], m.v[q]);
}

template <class D, class V>
static HWY_INLINE bool is_orthogonal(D d, const Columns<V>& m) {
  const V a = dot(m.w[0], m.w[0]), b = dot(m.w[1], m.w[1]), c = dot(m.w[2], m.w[2]);
  const auto oblique =
      hn::Or(is_oblique(d, a, b, dot(m.w[0], m.w[1])),
             hn::Or(is_oblique(d, a, c, dot(m.w[0], m.w[2])), is_oblique(d, b, c, dot(m.w[1], m.w[2]))));
  return hn::AllFalse(d, oblique);
}

/// If column q of W is longer than column p, exchanges them, and changes one sign so that V stays a rotation.
template <class D, class V>
static HWY_INLINE void order_columns(D, int p, int q, Columns<V>& m, V (&squares)[3]) {
  const auto longer = hn::Gt(squares[q], squares[p]);
  const auto exchange = [&](Three<V> & a, Three<V> & b) HWY_ATTR __attribute__((always_inline)) {
    const Three<V> old = a, minus = {hn::Neg(b.x), hn::Neg(b.y), hn::Neg(b.z)};
    a = select(longer, minus, a);
    b = select(longer, old, b);
  };
  exchange(m.w[p], m.w[q]);
  exchange(m.v[p], m.v[q]);
  const V old = squares[p];
  squares[p] = hn::Max(old, squares[q]);
  squares[q] = hn::Min(old, squares[q]);
}

struct SingularValues {
  static constexpr int in = 9, out = 21;
  static constexpr auto by_jacobi = [](const auto* in, auto* out) { svd_by_jacobi(in, out); };

  static constexpr int most_rounds = 12;  // usually one or two are enough

  /// Returns W = M V for the eigenvectors V of M^T M. Only rounding errors make the columns of W oblique.
  template <class D, class V>
  static HWY_INLINE Columns<V> nearly_orthogonal(D d, const Nine<V>& m, const Six<V>& gram) {
    const Spectrum<V> e = spectrum(d, gram);
    Vectors<V> vectors;
    put_vectors(d, e, vectors);
    const auto far_is_top = hn::Ge(e.a, hn::Zero(d));
    Columns<V> columns;
    columns.v[0] = select(far_is_top, vectors.a, vectors.b);
    columns.v[1] = select(far_is_top, vectors.b, vectors.c);
    columns.v[2] = cross(columns.v[0], columns.v[1]);
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      const Three<V>& v = columns.v[k];
      columns.w[k] = {sum_of_products(m.xx, v.x, m.xy, v.y, m.xz, v.z),
                      sum_of_products(m.yx, v.x, m.yy, v.y, m.yz, v.z),
                      sum_of_products(m.zx, v.x, m.zy, v.y, m.zz, v.z)};
    }
    return columns;
  }

  template <class D, class V>
  static HWY_INLINE hn::Mask<D> lanes(D d, const V (&in)[9], V (&out)[21]) {
    using T = hn::TFromD<D>;
    V size = hn::Abs(in[0]), power, inverse, scaled[9];
    for (int k = 1; k < 9; ++k) size = hn::Max(size, hn::Abs(in[k]));
    power_of_two_below(d, size, power, inverse);
    V finite = hn::Zero(d);
#pragma GCC unroll 9
    for (int k = 0; k < 9; ++k) {
      scaled[k] = hn::Mul(in[k], inverse);
      finite = hn::MulAdd(in[k], hn::Zero(d), finite);
    }
    const Six<V> squares_of_m = gram(nine(scaled));
    Columns<V> m = nearly_orthogonal(d, nine(scaled), squares_of_m);
    for (int round = 0; round < most_rounds && !is_orthogonal(d, m); ++round) {
      rotate_columns(d, 0, 1, m);
      rotate_columns(d, 0, 2, m);
      rotate_columns(d, 1, 2, m);
    }
    V squares[3] = {dot(m.w[0], m.w[0]), dot(m.w[1], m.w[1]), dot(m.w[2], m.w[2])};
    order_columns(d, 0, 1, m, squares);
    order_columns(d, 1, 2, m, squares);
    order_columns(d, 0, 1, m, squares);
    put_system(d, m, squares, power, out);
    // Squares must not underflow, and V must not mix long columns of M into much shorter ones: V has errors
    // of u, and errors of u^2 of the longest column remain in W.
    const V shortest = hn::Min(squares_of_m.xx, hn::Min(squares_of_m.yy, squares_of_m.zz));
    const V longest = hn::Max(squares_of_m.xx, hn::Max(squares_of_m.yy, squares_of_m.zz));
    const V ratio = hn::Set(d, T(sizeof(T) == 8 ? 0x1p-106 : 0x1p-50));
    const auto alike = hn::And(hn::Ge(squares[2], hn::Set(d, T(sizeof(T) == 8 ? 0x1p-480 : 0x1p-80))),
                               hn::Ge(shortest, hn::Mul(longest, ratio)));
    const auto in_range = hn::And(hn::Ge(size, hn::Set(d, T(sizeof(T) == 8 ? 1e-290 : 1e-30))),
                                  hn::Le(size, hn::Set(d, T(sizeof(T) == 8 ? 1e300 : 1e37))));
    return hn::And(hn::And(alike, in_range), hn::Eq(finite, hn::Zero(d)));
  }

  /// Writes U, the singular values and V. Two signs change in V, so that V stays a rotation.
  template <class D, class V>
  static HWY_INLINE void put_system(D d, const Columns<V>& m, const V (&squares)[3], V power, V (&out)[21]) {
    Three<V> u[3], v[3];
    V sign[2];
#pragma GCC unroll 2
    for (int k = 0; k < 2; ++k) {
      const V length = hn::Sqrt(squares[k]);
      sign[k] = sign_of_largest(d, m.v[k]);
      u[k] = times(m.w[k], hn::Div(sign[k], length));
      v[k] = times(m.v[k], sign[k]);
      out[9 + k] = hn::Mul(length, power);
    }
    const V both = hn::Mul(sign[0], sign[1]);
    u[2] = cross(u[0], u[1]);
    v[2] = times(m.v[2], both);
    const V last = hn::Mul(dot(m.w[2], u[2]), both);
    out[11] = hn::CopySign(hn::Min(out[10], hn::Abs(hn::Mul(last, power))), last);
    put_nine(from_columns(u[0], u[1], u[2]), out);
    put_nine(from_columns(v[0], v[1], v[2]), out + 12);
  }
};

struct RotationOf {
  static constexpr int in = 9, out = 9, group = 2;
  static constexpr bool memory_bound = false;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&m)[G][in], V (&r)[G][out]) const {
    Nine<V> from[G];
    Rotations<D> answer[G];
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) from[g] = nine(m[g]);
    polar_quick<G>(d, from, answer);
    bool done = true;
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) {
      put_nine(answer[g].r, r[g]);
      done = done && hn::AllTrue(d, answer[g].ok);
    }
    return done;
  }
  template <class D, class V>
  HWY_INLINE void general(D d, const V (&m)[in], V (&r)[out]) const {
    const Nine<V> from[1] = {nine(m)};
    Rotations<D> answer[1];
    polar_quick<1>(d, from, answer);
    put_nine(answer[0].r, r);
    replace_lanes(d, hn::Not(answer[0].ok), m, r,
                  [](const auto* in, auto* out) { polar_by_jacobi(in, out); });
  }
};

struct RotationAndStretch {
  static constexpr int in = 9, out = 15, group = 2;
  static constexpr bool memory_bound = false;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&m)[G][in], V (&both)[G][out]) const {
    V r[G][9];
    const bool done = RotationOf().quick<G>(d, m, r);
#pragma GCC unroll 4
    for (int g = 0; g < G; ++g) put_both(d, r[g], m[g], both[g]);
    return done;
  }
  template <class D, class V>
  HWY_INLINE void general(D d, const V (&m)[in], V (&both)[out]) const {
    V r[9];
    RotationOf().general(d, m, r);
    put_in_range(d, r, m, both);
  }

private:
  /// Like put_both(), but scales large matrices down, because sums of three entries could overflow.
  template <class D, class V>
  static HWY_INLINE void put_in_range(D d, const V (&r)[9], const V (&m)[9], V (&both)[out]) {
    using T = hn::TFromD<D>;
    const V one = hn::Set(d, T(1));
    V size = hn::Zero(d), scaled[9];
    for (const V& x : m) size = hn::Max(size, hn::Abs(x));
    const auto large = hn::Gt(size, hn::Set(d, T(sizeof(T) == 8 ? 1e307 : 1e37)));
    const V down = hn::IfThenElse(large, hn::Set(d, T(0.0625)), one),
            up = hn::IfThenElse(large, hn::Set(d, T(16)), one);
    for (int k = 0; k < in; ++k) scaled[k] = hn::Mul(m[k], down);
    put_both(d, r, scaled, both);
    for (int k = 9; k < out; ++k) both[k] = hn::Mul(both[k], up);
  }

  template <class D, class V>
  static HWY_INLINE void put_both(D d, const V (&r)[9], const V (&m)[9], V (&both)[out]) {
    V u[6];
    put_six(stretch(d, nine(r), nine(m)), u);
#pragma GCC unroll 16
    for (int k = 0; k < out; ++k) both[k] = k < 9 ? r[k] : u[k - 9];
  }
};

/// If all views have the layout `planes`, returns one view of all entries of their items.
template <class T, int N, class... More>
static HWY_INLINE View<T, N> joined(const More&... views) {
  View<T, N> all;
  all.layout = Layout::planes;
  int n = 0;
  const auto add = [&](const auto& view) {
    for (T* plane : view.plane) all.plane[n++] = plane;
  };
  (add(views), ...);
  return all;
}

/// Computes F, whose results are the entries of items of several views, one view after the other.
template <class F, class T, class... Views>
static HWY_INLINE void map_to_views(const F& f, const View<const T, F::in>& in, const Range& range,
                                    const Views&... views) {
  if (in.layout == Layout::planes && ((views.layout == Layout::planes) && ...))
    return map_many(f, in, joined<T, F::out>(views...), range);
  const hn::ScalableTag<T> d;
  map_tiles(d, f, in, range.begin, range.end,
            [&](const T* numbers, std::size_t i, std::size_t count) HWY_ATTR {
              const auto put = [&](const auto& view) HWY_ATTR {
                scatter(d, numbers, Tile<T>::stride, count, view, i);
                numbers += sizeof(view.plane) / sizeof(T*) * Tile<T>::stride;
              };
              (put(views), ...);
            });
}

/// The functions of F for the kernel table. M are the numbers of entries of the views' items.
template <class F, class T, int... M>
struct MappedToViews {
  static void one(const T* in, T* out) { map_one(F{}, in, out); }
  static void many(const View<const T, F::in>& in, const View<T, M>&... out, const Range& range) {
    map_to_views(F{}, in, range, out...);
  }
};

#define VIETE_DEFINE_DECOMPOSITION_OF(T, name, F, ...)                                            \
  extern const Decomposition<T, F::in, __VA_ARGS__> name##_##T;                                   \
  const Decomposition<T, F::in, __VA_ARGS__> name##_##T = {MappedToViews<F, T, __VA_ARGS__>::one, \
                                                           MappedToViews<F, T, __VA_ARGS__>::many};
#define VIETE_DEFINE_DECOMPOSITION(name, F, ...)              \
  VIETE_DEFINE_DECOMPOSITION_OF(double, name, F, __VA_ARGS__) \
  VIETE_DEFINE_DECOMPOSITION_OF(float, name, F, __VA_ARGS__)

VIETE_DEFINE_FUNCTION(rotation_of, RotationOf)
VIETE_DEFINE_DECOMPOSITION(polar, RotationAndStretch, 9, 6)
VIETE_DEFINE_DECOMPOSITION(eigh, WithFallback<Eigh>, 3, 9)
VIETE_DEFINE_DECOMPOSITION(svd, WithFallback<SingularValues>, 9, 3, 9)

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
