// Derivatives of exp, log, square roots and powers of batches, compiled once for each instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/derivative_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/batch-inl.h"
#include "sym3/exp_derivative-inl.h"
#include "sym3/fallback.h"
#include "sym3/spectral-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

/// The data for f'(S)[E] = V (F o V^T E V) V^T, where f is log, sqrt or pow (Daleckii and Krein 1965). See
/// derivative.h for F. The data does not depend on E.
template <class V>
struct Slopes : Vectors<V> {  ///< the columns of V
  Six<V> f;                   ///< F
};

/// a, b and c are the square roots of the eigenvalues. Returns F for sqrt: 1 / (x + y) for roots x and y.
template <class D, class V>
static HWY_INLINE Six<V> sqrt_slopes(D d, V a, V b, V c) {
  using T = hn::TFromD<D>;
  const V one = hn::Set(d, T(1)), half = hn::Set(d, T(0.5));
  const V ab = hn::Add(a, b), ac = hn::Add(a, c), bc = hn::Add(b, c);
  const V sums = hn::Div(one, hn::Mul(hn::Mul(ab, ac), bc)),
          values = hn::Div(half, hn::Mul(hn::Mul(a, b), c));
  return {hn::Mul(hn::Mul(b, c), values), hn::Mul(hn::Mul(ac, bc), sums), hn::Mul(hn::Mul(ab, bc), sums),
          hn::Mul(hn::Mul(a, c), values), hn::Mul(hn::Mul(ab, ac), sums), hn::Mul(hn::Mul(a, b), values)};
}

template <class D, class V>
static HWY_INLINE Six<V> log_slopes(D d, const Spectrum<V>& e) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const auto slope = [&](V x, V y, V difference) HWY_ATTR __attribute__((always_inline)) {
    return log_ratio(d, x, y, hn::Mul(e.size, difference)).slope;
  };
  return {hn::Div(one, e.at_a),
          slope(e.at_a, e.at_b, hn::Sub(e.a, e.b)),
          slope(e.at_a, e.at_c, hn::Sub(e.a, e.c)),
          hn::Div(one, e.at_b),
          slope(e.at_b, e.at_c, e.gap),
          hn::Div(one, e.at_c)};
}

template <class D, class V>
struct PowSlopes {
  using T = hn::TFromD<D>;
  using C = ExpTables<T>;

  D d;
  V p;
  hn::Mask<D> ok;  ///< lanes whose powers are in the normal range

  HWY_INLINE V power(V x) {
    const V one = hn::Set(d, T(1)), y = hn::Mul(p, log_ratio(d, x, one, hn::Sub(x, one)).log);
    ok = hn::And(ok, hn::Le(hn::Abs(y), hn::Set(d, C::trace_limit / 3)));
    const Reduced<V> r = reduce(d, y);
    return add_to_exponent(d, horner(d, C::scalar_exp, r.r), r.shifted);
  }

  /// Returns the divided difference (x^p - y^p) / (x - y). `of_log` is the divided difference of log. For
  /// small t = p log(x / y), the result is p * of_log * y^p * (e^t - 1) / t.
  HWY_INLINE V between(V x_power, V y_power, V difference, V of_log) const {
    constexpr int degree = sizeof(C::scalar_exp) / sizeof(T) - 1;
    const V slope = hn::Mul(p, of_log), t = hn::Mul(slope, difference);
    V series = hn::Set(d, C::scalar_exp[degree]);
#pragma GCC unroll 16
    for (int k = degree - 1; k > 0; --k) series = hn::MulAdd(series, t, hn::Set(d, C::scalar_exp[k]));
    const auto near = hn::Le(hn::Abs(t), hn::Set(d, T(0.3467)));
    return hn::IfThenElse(near, hn::Mul(hn::Mul(slope, y_power), series),
                          hn::Div(hn::Sub(x_power, y_power), difference));
  }
};

template <class D, class V>
static HWY_INLINE Six<V> pow_slopes(D d, const Spectrum<V>& e, V p, hn::Mask<D>& ok) {
  const Six<V> log = log_slopes(d, e);
  PowSlopes<D, V> f = {d, p, ok};
  const V a = f.power(e.at_a), b = f.power(e.at_b), c = f.power(e.at_c);
  const auto over = [&](V power, V inverse) HWY_ATTR __attribute__((always_inline)) {
    return hn::Mul(hn::Mul(p, power), inverse);
  };
  ok = f.ok;
  return {over(a, log.xx),
          f.between(a, b, hn::Mul(e.size, hn::Sub(e.a, e.b)), log.xy),
          f.between(a, c, hn::Mul(e.size, hn::Sub(e.a, e.c)), log.xz),
          over(b, log.yy),
          f.between(b, c, hn::Mul(e.size, e.gap), log.yz),
          over(c, log.zz)};
}

template <class D, class V>
static HWY_INLINE hn::Mask<D> put_slopes(D d, Of f, double p, const Six<V>& s, Slopes<V>& slopes) {
  const Spectrum<V> e = spectrum(d, s);
  auto ok = is_ordinary(d, e);
  put_vectors(d, e, slopes);
  if (f == Of::log) {
    slopes.f = log_slopes(d, e);
  } else if (f == Of::pow) {
    slopes.f = pow_slopes(d, e, hn::Set(d, hn::TFromD<D>(p)), ok);
  } else {
    slopes.f = sqrt_slopes(d, hn::Sqrt(e.at_a), hn::Sqrt(e.at_b), hn::Sqrt(e.at_c));
  }
  return ok;
}

template <class V>
static HWY_INLINE Six<V> by_slopes(const Slopes<V>& s, const Six<V>& e) {
  const Three<V> ea = times(e, s.a), eb = times(e, s.b), ec = times(e, s.c);
  const V aa = Mul(s.f.xx, dot(s.a, ea)), ab = Mul(s.f.xy, dot(s.a, eb)), ac = Mul(s.f.xz, dot(s.a, ec)),
          bb = Mul(s.f.yy, dot(s.b, eb)), bc = Mul(s.f.yz, dot(s.b, ec)), cc = Mul(s.f.zz, dot(s.c, ec));
  const auto column = [&](V a, V b, V c) HWY_ATTR __attribute__((always_inline)) {
    return Three<V>{sum_of_products(a, s.a.x, b, s.b.x, c, s.c.x),
                    sum_of_products(a, s.a.y, b, s.b.y, c, s.c.y),
                    sum_of_products(a, s.a.z, b, s.b.z, c, s.c.z)};
  };
  const Three<V> a = column(aa, ab, ac), b = column(ab, bb, bc), c = column(ac, bc, cc);
  return {sum_of_products(a.x, s.a.x, b.x, s.b.x, c.x, s.c.x),
          sum_of_products(a.x, s.a.y, b.x, s.b.y, c.x, s.c.y),
          sum_of_products(a.x, s.a.z, b.x, s.b.z, c.x, s.c.z),
          sum_of_products(a.y, s.a.y, b.y, s.b.y, c.y, s.c.y),
          sum_of_products(a.y, s.a.z, b.y, s.b.z, c.y, s.c.z),
          sum_of_products(a.z, s.a.z, b.z, s.b.z, c.z, s.c.z)};
}

// A derivative type F has these members:
//   Point<D>                      the data at S for all directions, with one S in each lane
//   f.put_point(d, s, point)      computes this data
//   f.derivative(d, point, e)     f'(S)[E]

struct ExpDerivative {
  template <class D>
  using Point = ExpPoint<D>;

  template <class D, class V>
  HWY_INLINE void put_point(D d, const Six<V>& s, Point<D>& point) const {
    put_exp_point(d, s, point);
  }
  template <class D, class V>
  HWY_INLINE Six<V> derivative(D d, const Point<D>& point, const Six<V>& e) const {
    return exp_derivative(d, point, e);
  }
};

template <class D>
struct SpectralPoint {
  Six<hn::Vec<D>> s;
  Slopes<hn::Vec<D>> slopes;
  hn::Mask<D> ok;
};

struct SpectralDerivative {
  template <class D>
  using Point = SpectralPoint<D>;
  Of f;
  double p;

  template <class D, class V>
  HWY_NOINLINE void put_point(D d, const Six<V>& s, Point<D>& point) const {
    point.s = s;
    point.ok = put_slopes(d, f, p, s, point.slopes);
  }
  template <class D, class V>
  HWY_NOINLINE Six<V> derivative(D d, const Point<D>& point, const Six<V>& e) const {
    const Six<V> answer = by_slopes(point.slopes, e);
    const auto good = hn::And(point.ok, is_finite(d, answer));
    if (HWY_LIKELY(hn::AllTrue(d, good))) return answer;
    const V from[12] = {point.s.xx, point.s.xy, point.s.xz, point.s.yy, point.s.yz, point.s.zz,
                        e.xx,       e.xy,       e.xz,       e.yy,       e.yz,       e.zz};
    V to[6];
    put_six(answer, to);
    replace_lanes(d, hn::Not(good), from, to,
                  [this](const auto* in, auto* out) { spectral_derivative_by_jacobi(f, p, in, out); });
    return six(to);
  }
};

template <class F, class T>
static HWY_INLINE void one_by(const F& f, const T* s, const T* direction, T* out) {
  using D = hn::CappedTag<T, 1>;
  using V = hn::Vec<D>;
  const D d;
  V from[6], e[6], answer[6];
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    from[k] = hn::LoadU(d, s + k);
    e[k] = hn::LoadU(d, direction + k);
  }
  typename F::template Point<D> point;
  f.put_point(d, six(from), point);
  put_six(f.derivative(d, point, six(e)), answer);
  store_row(d, answer, out);
}

/// Returns true if the items need no tile: the layout is planes, and `count` items fill whole registers.
template <class D, class T>
static HWY_INLINE bool is_direct(D, const View<T, 6>& v, std::size_t count) {
  return v.layout == Layout::planes && count % hn::MaxLanes(D()) == 0;
}

template <class T>
static HWY_INLINE View<T, 6> planes_from(const View<T, 6>& v, std::size_t i) {
  View<T, 6> there;
  there.layout = Layout::planes;
  for (int k = 0; k < 6; ++k) there.plane[k] = v.plane[k] + i;
  return there;
}

/// Returns items [i, i + count) as planes: the view itself if possible, otherwise a copy in `tile`.
template <class D, class T>
static HWY_INLINE View<const T, 6> readable(D d, const View<const T, 6>& v, std::size_t i, std::size_t count,
                                            T* tile) {
  if (is_direct(d, v, count)) return planes_from(v, i);
  fill_tile(d, v, i, count, tile);
  return Tile<T>::template view<6, const T>(tile);
}

/// For each tile, computes the data of all S, then one direction after the other.
template <class F, class T>
static HWY_INLINE void many_by(const F& f, const View<const T, 6>& s, const View<const T, 6>* directions,
                               const View<T, 6>* out, std::size_t n, const Range& range) {
  using D = hn::ScalableTag<T>;
  const D d;
  constexpr std::size_t stride = Tile<T>::stride, lanes = hn::MaxLanes(D());
  alignas(64) T from[6 * stride], to[6 * stride];
  typename F::template Point<D> points[Tile<T>::items / lanes];
  hn::Vec<D> e[6];
  for (std::size_t i = range.begin; i < range.end; i += Tile<T>::items) {
    const std::size_t count = range.end - i < Tile<T>::items ? range.end - i : Tile<T>::items;
    const auto matrices = readable(d, s, i, count, from);
    for (std::size_t j = 0; j < count; j += lanes) {
      InPlanes::load(d, matrices, j, e);
      f.put_point(d, six(e), points[j / lanes]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const bool direct = is_direct(d, out[k], count);
      const auto direction = readable(d, directions[k], i, count, from);
      const auto answers = direct ? planes_from(out[k], i) : Tile<T>::template view<6, T>(to);
      for (std::size_t j = 0; j < count; j += lanes) {
        InPlanes::load(d, direction, j, e);
        put_six(f.derivative(d, points[j / lanes], six(e)), e);
        InPlanes::store<false>(d, e, answers, j);
      }
      if (!direct) scatter(d, to, stride, count, out[k], i);
    }
  }
}

template <class T>
static void derivative_one(const T* s, const T* direction, T* out, Of f, double p) {
  if (f == Of::exp) return one_by(ExpDerivative{}, s, direction, out);
  one_by(SpectralDerivative{f, p}, s, direction, out);
}

template <class T>
static void derivative_many(const View<const T, 6>& s, const View<const T, 6>* directions,
                            const View<T, 6>* out, std::size_t n, Of f, double p, const Range& range) {
  if (f == Of::exp) return many_by(ExpDerivative{}, s, directions, out, n, range);
  many_by(SpectralDerivative{f, p}, s, directions, out, n, range);
}

extern const DerivativeFunction<double> derivative_double;
extern const DerivativeFunction<float> derivative_float;
const DerivativeFunction<double> derivative_double = {derivative_one<double>, derivative_many<double>};
const DerivativeFunction<float> derivative_float = {derivative_one<float>, derivative_many<float>};

/// Computes a tangent, one direction after the other. Leaves lanes in `done` unchanged.
template <class F, class D, class V, class M>
static HWY_NOINLINE void tangent_by_directions(D d, const F& f, const typename F::template Point<D>& point,
                                               const M& done, V (&tangent)[36]) {
  const V zero = hn::Zero(d), one = hn::Set(d, hn::TFromD<D>(1));
  for (int k = 0; k < 6; ++k) {
    V e[6] = {zero, zero, zero, zero, zero, zero}, answer[6];
    e[k] = one;
    put_six(f.derivative(d, point, six(e)), answer);
    for (int j = 0; j < 6; ++j) tangent[6 * k + j] = hn::IfThenElse(done, tangent[6 * k + j], answer[j]);
  }
}

struct Tangent {
  static constexpr int in = 6, out = 36, group = 1;
  static constexpr bool memory_bound = false;
  Of f;
  double p;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&s)[G][in], V (&tangent)[G][out]) const {
    if (f == Of::exp) {
      put(d, six(s[0]), tangent[0]);
    } else {
      const SpectralDerivative any = {f, p};
      SpectralPoint<D> point;
      any.put_point(d, six(s[0]), point);
      for (V& x : tangent[0]) x = hn::Zero(d);
      tangent_by_directions(d, any, point, hn::MaskFromVec(hn::Zero(d)), tangent[0]);
    }
    return true;
  }

private:
  template <class D, class V>
  static HWY_INLINE void put(D d, const Six<V>& s, V (&tangent)[out]) {
    ExpPoint<D> point;
    Six<V> rows[6];
    put_exp_point(d, s, point);
    put_exp_tangent(d, point.parts, rows);
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
      V row[6];
      put_six(rows[k], row);
#pragma GCC unroll 6
      for (int j = 0; j < 6; ++j) tangent[6 * k + j] = row[j];
    }
    if (HWY_LIKELY(hn::AllTrue(d, point.ok))) return;
    tangent_by_directions(d, ExpDerivative{}, point, point.ok, tangent);
  }
};

VIETE_DEFINE_FUNCTION(tangent, Tangent, Of, double)

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
