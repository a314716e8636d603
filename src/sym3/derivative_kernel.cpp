// Derivatives of exp, log, square roots and powers of batches, compiled once per instruction set.
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "sym3/derivative_kernel.cpp"
#include <hwy/foreach_target.h>

#include "sym3/batch-inl.h"
#include "sym3/exp_derivative-inl.h"
#include "sym3/fallback.h"
#include "sym3/spectral_derivative-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::sym3::HWY_NAMESPACE {

// A function F to be differentiated has
//   Point<D>                      data shared by all directions at one S, one S per lane
//   f.put_point(d, s, point)      computes that of S
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
  for (int k = 0; k < 6; ++k) from[k] = hn::LoadU(d, s + k), e[k] = hn::LoadU(d, direction + k);
  typename F::template Point<D> point;
  f.put_point(d, six(from), point);
  put_six(f.derivative(d, point, six(e)), answer);
  store_row(d, answer, out);
}

/// True if items [i, i + count) can be processed in place in planes, in whole registers.
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

/// Items [i, i + count) in planes: in place, or gathered into a tile.
template <class D, class T>
static HWY_INLINE View<const T, 6> readable(D d, const View<const T, 6>& v, std::size_t i, std::size_t count,
                                            T* tile) {
  if (is_direct(d, v, count)) return planes_from(v, i);
  fill_tile(d, v, i, count, tile);
  return Tile<T>::template view<6, const T>(tile);
}

/// Processes tiles: first the shared data of all S in a tile, then one direction after the other, each read
/// before its results are written.
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

/// One direction after the other. Writes only lanes that are not `done`.
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

/// The derivatives in the six directions with one number 1 and the others 0.
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
