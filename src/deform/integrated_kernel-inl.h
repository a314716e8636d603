// Integrated weights in vector registers, one lane a point: included by bind_kernel.cpp for each instruction
// set. The formulas and their letters are those of integrated_distance.h. Internal. (No #pragma once: see
// sym3/exp-inl.h.)
#if defined(VIETE_DEFORM_INTEGRATED_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_DEFORM_INTEGRATED_KERNEL_INL_H
#undef VIETE_DEFORM_INTEGRATED_KERNEL_INL_H
#else
#define VIETE_DEFORM_INTEGRATED_KERNEL_INL_H
#endif

#include "deform/bind_kernel-inl.h"
#include "deform/mean_value_kernel-inl.h"
#include "sym3/rotation_tables.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

// J is taken as a series where k sin^2 t is below its limit: of the most terms, or of fewer where it is
// smaller everywhere.
template <class T>
struct Series;
template <>
struct Series<double> {
  static constexpr double limit = 1.0 / 16, small = 1e-2, smaller = 1e-4;
  static constexpr int most = 14, few = 8, fewer = 4;
};
template <>
struct Series<float> {
  static constexpr float limit = 0.25f, small = 0.1f, smaller = 1e-2f;
  static constexpr int most = 10, few = 6, fewer = 4;
};

// x^-1/2 to an ulp or two.
static HWY_INLINE RowV inverse_root(RowV x) {
  const RowTag d;
  const RowV y = hn::ApproximateReciprocalSqrt(x), e = hn::NegMulAdd(hn::Mul(x, y), y, hn::Set(d, 1.0f));
  return hn::MulAdd(hn::Mul(y, e), hn::MulAdd(e, hn::Set(d, 0.375f), hn::Set(d, 0.5f)), y);
}

template <class V>
struct SeenEdge {
  V m, moment;  // m L
  V q2, inverse_q;
  V c, q_length, start;  // start: squared distance to where it begins
};

template <class D, class V = hn::Vec<D>>
static HWY_INLINE SeenEdge<V> seen_edge(D d, V along, V m, hn::TFromD<D> length, V h2) {
  const V l = hn::Set(d, length);
  SeenEdge<V> e;
  e.m = m;
  e.moment = hn::Mul(m, l);
  e.q2 = hn::MulAdd(m, m, h2);
  e.inverse_q = inverse_root(e.q2);
  e.c = hn::MulAdd(along, hn::Sub(along, l), e.q2);
  e.q_length = hn::Mul(hn::Mul(e.q2, e.inverse_q), l);
  e.start = hn::MulAdd(along, along, e.q2);
  return e;
}

// (atan(z) / z - 1) / z^2 for z to 1, of z^2.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE V arc_rest(D d, V x) {
  using T = hn::TFromD<D>;
  using C = sym3::RotationTables<T>;
  const V x2 = hn::Mul(x, x);
  constexpr int highest = std::size(C::arc_even) - 1;
  V sum = hn::Set(d, C::arc_even[highest]);
#pragma GCC unroll 16
  for (int i = highest - 1; i > 0; --i) sum = hn::MulAdd(sum, x2, hn::Set(d, C::arc_even[i]));
  return hn::MulAdd(sum, x, lanes::horner(d, C::arc_odd, x2));
}

// The angle between the directions to its ends, and of that the integral of sin^2.
template <class V>
struct Angle {
  V b, squared_sine, sine_cosine, integral;
};

template <class D, class V = hn::Vec<D>>
static HWY_INLINE Angle<V> angle_of(D d, const SeenEdge<V>& e, V inverse_ends) {
  using T = hn::TFromD<D>;
  const V zero = hn::Zero(d), half = hn::Set(d, T(0.5)), size = hn::Abs(e.c);
  const auto acute = hn::Gt(e.c, zero), flat = hn::Le(e.q_length, size);
  const V z = hn::Div(hn::Min(e.q_length, size), hn::Max(e.q_length, size)), x = hn::Mul(z, z);
  const V rest = arc_rest(d, x), z3 = hn::Mul(z, x), arc = hn::MulAdd(z3, rest, z);
  const V base =
      hn::IfThenElse(flat, hn::IfThenElseZero(hn::Not(acute), hn::Set(d, T(pi))), hn::Set(d, T(pi / 2)));
  const V b = hn::Add(base, hn::IfThenElse(hn::Xor(acute, hn::Not(flat)), arc, hn::Neg(arc)));
  Angle<V> a;
  a.b = b;
  a.squared_sine = hn::Mul(hn::Mul(e.q_length, e.q_length), inverse_ends);
  a.sine_cosine = hn::Mul(hn::Mul(e.q_length, e.c), inverse_ends);
  // (atan(z) - z / (1 + z^2)) / 2, where 1 / (1 + z^2) is the square of the cosine.
  const V squared_cosine = hn::Mul(hn::Mul(e.c, e.c), inverse_ends);
  a.integral = hn::Mul(half, hn::IfThenElse(hn::And(acute, flat), hn::Mul(z3, hn::Add(rest, squared_cosine)),
                                            hn::Sub(b, a.sine_cosine)));
  return a;
}

// J: the sum of Q_n = k^n S_n, with (2n+2) S_n = (2n+1) S_n-1 - sin^(2n+1) b cos b, backward, so that S_0 and
// the boundary's terms each get what all later Q_n have of them.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE V series(D d, const Angle<V>& a, V k, int terms) {
  using T = hn::TFromD<D>;
  const V x = hn::Mul(k, a.squared_sine), one = hn::Set(d, T(1));
  V later = one, boundary = hn::Zero(d);
  for (int n = terms - 1; n > 0; --n) {
    const T share = T(1) / T(2 * n + 2);
    boundary = hn::Mul(x, hn::MulAdd(later, hn::Set(d, share), boundary));
    later = hn::MulAdd(hn::Mul(k, hn::Set(d, 1 - share)), later, one);
  }
  return hn::NegMulAdd(a.sine_cosine, boundary, hn::Mul(later, a.integral));
}

// As many terms as the lane that converges most slowly needs.
template <class D, class V = hn::Vec<D>, class S = Series<hn::TFromD<D>>>
static HWY_INLINE int terms_for(D d, V steepest) {
  if (hn::AllTrue(d, hn::Lt(steepest, hn::Set(d, S::smaller)))) return S::fewer;
  return hn::AllTrue(d, hn::Lt(steepest, hn::Set(d, S::small))) ? S::few : S::most;
}

// |x - y|^-4 over a triangle.
template <class D, class T = hn::TFromD<D>, class V = hn::Vec<D>>
static HWY_INLINE V inverse_fourth_power(D d, const Points<D>& p, const DistanceTriangle<T>& t,
                                         const T* shift, T squared_softening) {
  const V zero = hn::Zero(d);
  const V x = along(d, p, t.axes[0], shift[0]), y = along(d, p, t.axes[1], shift[1]);
  const V z = along(d, p, t.axes[2], shift[2]);
  const V h2 = hn::MulAdd(z, z, hn::Set(d, squared_softening));
  const SeenEdge<V> e[] = {
      seen_edge(d, x, y, t.length[0], h2),
      seen_edge(d, linear(d, t.along[0], x, y), linear(d, t.inward[0], x, y), t.length[1], h2),
      seen_edge(d, linear(d, t.along[1], x, y), linear(d, t.inward[1], x, y), t.length[2], h2)};
  const V ends = hn::Mul(e[0].start, hn::Mul(e[1].start, e[2].start)),
          inverse = hn::Div(hn::Set(d, T(1)), ends);
  Angle<V> a[3];
  V angles = zero, steepest = zero, k[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    a[i] = angle_of(d, e[i], hn::Mul(inverse, e[(i + 2) % 3].start));
    angles = hn::MulAdd(hn::Mul(e[i].m, e[i].inverse_q), a[i].b, angles);
    k[i] = hn::Mul(h2, hn::Mul(e[i].inverse_q, e[i].inverse_q));
    steepest =
        hn::Max(steepest, hn::IfThenElse(hn::Lt(e[i].c, zero), k[i], hn::Mul(k[i], a[i].squared_sine)));
  }
  const V direct = hn::Div(angles, hn::Add(h2, h2));
  const auto outside = hn::Lt(hn::Min(e[0].m, hn::Min(e[1].m, e[2].m)), zero);
  const auto far_above = hn::Gt(h2, hn::Set(d, t.length[0] * t.length[0]));
  const auto by_series = hn::And(hn::Or(outside, far_above), hn::Lt(steepest, hn::Set(d, Series<T>::limit)));
  if (hn::AllFalse(d, by_series)) return direct;
  const int terms = terms_for(d, hn::IfThenElseZero(by_series, steepest));
  const V minus_real = hn::MulAdd(hn::Mul(e[0].c, e[1].moment), e[2].moment,
                                  hn::MulAdd(hn::Mul(e[1].c, e[2].moment), e[0].moment,
                                             hn::MulSub(hn::Mul(e[2].c, e[0].moment), e[1].moment,
                                                        hn::Mul(e[0].c, hn::Mul(e[1].c, e[2].c)))));
  const V area_power =
      hn::MulSub(hn::Set(d, t.opposite), e[0].moment, hn::Mul(hn::Set(d, t.twice_area), e[0].c));
  const V ratio = hn::Div(area_power, minus_real), argument = hn::Mul(h2, ratio);
  const V x2 = hn::Mul(argument, argument);
  V area = hn::MulAdd(hn::Mul(ratio, x2), arc_rest(d, x2), ratio);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const V q3 = hn::Mul(e[i].inverse_q, hn::Mul(e[i].inverse_q, e[i].inverse_q));
    area = hn::NegMulAdd(hn::Mul(e[i].m, q3), series(d, a[i], k[i], terms), area);
  }
  return hn::IfThenElse(by_series, hn::Mul(area, hn::Set(d, T(0.5))), direct);
}

static void integrated(const WeightJob<double>& job, double* weights) {
  const PointTag d;
  for (std::size_t l = 0; l < bind_lanes; l += hn::Lanes(d)) {
    const auto p = load_points(d, job.points + l, bind_lanes);
    PointV sum = hn::Zero(d);
    for (std::size_t i = 0; i < job.count; ++i) {
      PointV w = hn::Zero(d);
      if (!job.triangles[i].degenerate)
        w = hn::Max(w, inverse_fourth_power(d, p, job.triangles[i], job.shifts[i], job.least_square));
      sum = hn::Add(sum, w);
      hn::StoreU(w, d, weights + i * bind_lanes + l);
    }
    const PointV share = hn::Div(hn::Set(d, 1.0), sum);
    for (std::size_t i = 0; i < job.count; ++i) {
      double* w = weights + i * bind_lanes + l;
      hn::StoreU(hn::Mul(share, hn::LoadU(d, w)), d, w);
    }
  }
}

// That of a cage a thousand diagonals away: farther, products of lengths leave the range of floats.
constexpr float least_sum = 1e-13f;

// Over a face w is pi / d^2, at edges and corners less: w times `near` is 1 about where distances are as
// near. (An overflow fails the test, too.)
static bool integrated_rows(const WeightJob<float>& job, const RowJob& out) {
  const RowTag d;
  HWY_ALIGN float shares[row_lanes];
  for (std::size_t l = 0; l < row_lanes; l += hn::Lanes(d)) {
    const auto p = load_points(d, job.points + l, row_lanes);
    RowV sum = hn::Zero(d);
    for (std::size_t block = 0; block < job.count; block += summed_at_once) {
      RowV part = hn::Zero(d);
      for (std::size_t i = block; i < std::min(block + summed_at_once, job.count); ++i) {
        RowV w = hn::Zero(d);
        const auto& t = job.triangles[i];
        if (!t.degenerate) {
          const RowV integral = inverse_fourth_power(d, p, t, job.shifts[i], job.least_square);
          if (!hn::AllTrue(d, hn::Lt(hn::Mul(integral, hn::Set(d, t.near)), hn::Set(d, 1.0f)))) return false;
          w = hn::Max(w, integral);
        }
        part = hn::Add(part, w);
        hn::StoreU(w, d, out.rows + i * row_lanes + l);
      }
      sum = hn::Add(sum, part);
    }
    if (!hn::AllTrue(d, hn::Gt(sum, hn::Set(d, least_sum)))) return false;
    hn::StoreU(hn::Div(hn::Set(d, 1.0f), sum), d, shares + l);
  }
  normalise_rows(shares, out);
  return true;
}

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
