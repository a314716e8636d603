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

// A function F whose derivative is taken has
//   Point<D>                      what all directions at one S share, one S a lane
//   f.put_point(d, s, point)      makes that of S
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

/// By tiles: first what the directions share of all S in a tile, then one direction after the other, read
/// before its answers are written.
template <class F, class T>
static HWY_INLINE void many_by(const F& f, const View<const T, 6>& s, const View<const T, 6>* directions,
                               const View<T, 6>* out, std::size_t n, const Range& range) {
  const hn::ScalableTag<T> d;
  using D = hn::ScalableTag<T>;
  constexpr std::size_t stride = Tile<T>::stride, lanes = hn::MaxLanes(D());
  alignas(64) T from[6 * stride], to[6 * stride];
  typename F::template Point<D> points[Tile<T>::items / lanes];
  const auto from_view = Tile<T>::template view<6, const T>(from);
  const auto to_view = Tile<T>::template view<6, T>(to);
  hn::Vec<D> e[6];
  for (std::size_t i = range.begin; i < range.end; i += Tile<T>::items) {
    const std::size_t count = range.end - i < Tile<T>::items ? range.end - i : Tile<T>::items;
    const std::size_t filled = fill_tile(d, s, i, count, from);
    for (std::size_t j = 0; j < filled; j += lanes) {
      InPlanes::load(d, from_view, j, e);
      f.put_point(d, six(e), points[j / lanes]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      fill_tile(d, directions[k], i, count, from);
      for (std::size_t j = 0; j < filled; j += lanes) {
        InPlanes::load(d, from_view, j, e);
        put_six(f.derivative(d, points[j / lanes], six(e)), e);
        InPlanes::store<false>(d, e, to_view, j);
      }
      scatter(d, to, stride, count, out[k], i);
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

/// The derivatives in the six directions in which one of the six numbers is 1 and the others are 0.
struct Tangent {
  static constexpr int in = 6, out = 36, group = 1;
  static constexpr bool memory_bound = false;
  Of f;
  double p;

  template <int G, class D, class V>
  HWY_INLINE bool quick(D d, const V (&s)[G][in], V (&tangent)[G][out]) const {
    if (f == Of::exp) {
      put(d, ExpDerivative{}, s[0], tangent[0]);
    } else {
      put(d, SpectralDerivative{f, p}, s[0], tangent[0]);
    }
    return true;
  }

private:
  template <class D, class F, class V>
  static HWY_INLINE void put(D d, const F& f, const V (&s)[in], V (&tangent)[out]) {
    typename F::template Point<D> point;
    f.put_point(d, six(s), point);
    const V zero = hn::Zero(d), one = hn::Set(d, hn::TFromD<D>(1));
    for (int k = 0; k < 6; ++k) {
      V e[6] = {zero, zero, zero, zero, zero, zero}, answer[6];
      e[k] = one;
      put_six(f.derivative(d, point, six(e)), answer);
      for (int j = 0; j < 6; ++j) tangent[6 * k + j] = answer[j];
    }
  }
};

VIETE_DEFINE_FUNCTION(tangent, Tangent, Of, double)

}  // namespace viete::sym3::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
