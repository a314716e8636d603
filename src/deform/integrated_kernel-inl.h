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

constexpr double series_limit = 1.0 / 16;  // largest k sin^2 t for which J is taken as a series
constexpr int series_terms = 14;           // of which it takes so many

struct SeenEdge {
  PointV m, moment;  // m L
  PointV q2, inverse_q;
  PointV c, q_length, start;  // start: squared distance to where it begins
};

static HWY_INLINE SeenEdge seen_edge(PointV along, PointV m, double length, PointV h2) {
  const PointTag d;
  const PointV l = hn::Set(d, length);
  SeenEdge e;
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
static HWY_INLINE PointV arc_rest(PointV x) {
  using C = sym3::RotationTables<double>;
  const PointTag d;
  const PointV x2 = hn::Mul(x, x);
  static constexpr std::size_t evens = std::size(C::arc_even) - 1;
  static constexpr auto even = [] {
    std::array<double, evens> rest{};
    std::copy_n(C::arc_even + 1, evens, rest.begin());
    return rest;
  }();
  PointV sum = hn::Set(d, even[evens - 1]);
#pragma GCC unroll 16
  for (std::size_t i = evens - 1; i-- > 0;) sum = hn::MulAdd(sum, x2, hn::Set(d, even[i]));
  return hn::MulAdd(sum, x, lanes::horner(d, C::arc_odd, x2));
}

// The angle between the directions to its ends, and of that the integral of sin^2.
struct Angle {
  PointV b, squared_sine, sine_cosine, integral;
};

static HWY_INLINE Angle angle_of(const SeenEdge& e, PointV inverse_ends) {
  const PointTag d;
  const PointV zero = hn::Zero(d), half = hn::Set(d, 0.5), size = hn::Abs(e.c);
  const auto acute = hn::Gt(e.c, zero), flat = hn::Le(e.q_length, size);
  const PointV z = hn::Div(hn::Min(e.q_length, size), hn::Max(e.q_length, size)), x = hn::Mul(z, z);
  const PointV rest = arc_rest(x), z3 = hn::Mul(z, x), arc = hn::MulAdd(z3, rest, z);
  const PointV base =
      hn::IfThenElse(flat, hn::IfThenElseZero(hn::Not(acute), hn::Set(d, pi)), hn::Set(d, pi / 2));
  const PointV b = hn::Add(base, hn::IfThenElse(hn::Xor(acute, hn::Not(flat)), arc, hn::Neg(arc)));
  Angle a;
  a.b = b;
  a.squared_sine = hn::Mul(hn::Mul(e.q_length, e.q_length), inverse_ends);
  a.sine_cosine = hn::Mul(hn::Mul(e.q_length, e.c), inverse_ends);
  // (atan(z) - z / (1 + z^2)) / 2, where 1 / (1 + z^2) is the square of the cosine.
  const PointV squared_cosine = hn::Mul(hn::Mul(e.c, e.c), inverse_ends);
  a.integral = hn::Mul(half, hn::IfThenElse(hn::And(acute, flat), hn::Mul(z3, hn::Add(rest, squared_cosine)),
                                            hn::Sub(b, a.sine_cosine)));
  return a;
}

// J: the sum of Q_n = k^n S_n, with (2n+2) S_n = (2n+1) S_n-1 - sin^(2n+1) b cos b, backward, so that S_0 and
// the boundary's terms each get what all later Q_n have of them.
static HWY_INLINE PointV series(const Angle& a, PointV k, int terms) {
  const PointTag d;
  const PointV x = hn::Mul(k, a.squared_sine), one = hn::Set(d, 1.0);
  PointV later = one, boundary = hn::Zero(d);
  for (int n = terms - 1; n > 0; --n) {
    const double share = 1.0 / (2 * n + 2);
    boundary = hn::Mul(x, hn::MulAdd(later, hn::Set(d, share), boundary));
    later = hn::MulAdd(hn::Mul(k, hn::Set(d, 1 - share)), later, one);
  }
  return hn::NegMulAdd(a.sine_cosine, boundary, hn::Mul(later, a.integral));
}

// As many terms as the lane that converges most slowly needs.
static HWY_INLINE int terms_for(PointV steepest) {
  const PointTag d;
  if (hn::AllTrue(d, hn::Lt(steepest, hn::Set(d, 1e-4)))) return 4;
  return hn::AllTrue(d, hn::Lt(steepest, hn::Set(d, 1e-2))) ? 8 : series_terms;
}

// |x - y|^-4 over a triangle.
static HWY_INLINE PointV inverse_fourth_power(const Points<PointTag>& p, const DistanceTriangle<double>& t,
                                              const double* shift, double squared_softening) {
  const PointTag d;
  const PointV zero = hn::Zero(d);
  const PointV x = along(d, p, t.axes[0], shift[0]), y = along(d, p, t.axes[1], shift[1]);
  const PointV z = along(d, p, t.axes[2], shift[2]);
  const PointV h2 = hn::MulAdd(z, z, hn::Set(d, squared_softening));
  const SeenEdge e[] = {
      seen_edge(x, y, t.length[0], h2),
      seen_edge(linear(d, t.along[0], x, y), linear(d, t.inward[0], x, y), t.length[1], h2),
      seen_edge(linear(d, t.along[1], x, y), linear(d, t.inward[1], x, y), t.length[2], h2)};
  const PointV ends = hn::Mul(e[0].start, hn::Mul(e[1].start, e[2].start)),
               inverse = hn::Div(hn::Set(d, 1.0), ends);
  Angle a[3];
  PointV angles = zero, steepest = zero, k[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    a[i] = angle_of(e[i], hn::Mul(inverse, e[(i + 2) % 3].start));
    angles = hn::MulAdd(hn::Mul(e[i].m, e[i].inverse_q), a[i].b, angles);
    k[i] = hn::Mul(h2, hn::Mul(e[i].inverse_q, e[i].inverse_q));
    steepest =
        hn::Max(steepest, hn::IfThenElse(hn::Lt(e[i].c, zero), k[i], hn::Mul(k[i], a[i].squared_sine)));
  }
  const PointV direct = hn::Div(angles, hn::Add(h2, h2));
  const auto outside = hn::Lt(hn::Min(e[0].m, hn::Min(e[1].m, e[2].m)), zero);
  const auto far_above = hn::Gt(h2, hn::Set(d, t.length[0] * t.length[0]));
  const auto by_series = hn::And(hn::Or(outside, far_above), hn::Lt(steepest, hn::Set(d, series_limit)));
  if (hn::AllFalse(d, by_series)) return direct;
  const int terms = terms_for(hn::IfThenElseZero(by_series, steepest));
  const PointV minus_real = hn::MulAdd(hn::Mul(e[0].c, e[1].moment), e[2].moment,
                                       hn::MulAdd(hn::Mul(e[1].c, e[2].moment), e[0].moment,
                                                  hn::MulSub(hn::Mul(e[2].c, e[0].moment), e[1].moment,
                                                             hn::Mul(e[0].c, hn::Mul(e[1].c, e[2].c)))));
  const PointV area_power =
      hn::MulSub(hn::Set(d, t.opposite), e[0].moment, hn::Mul(hn::Set(d, t.twice_area), e[0].c));
  const PointV ratio = hn::Div(area_power, minus_real), argument = hn::Mul(h2, ratio);
  const PointV x2 = hn::Mul(argument, argument);
  PointV area = hn::MulAdd(hn::Mul(ratio, x2), arc_rest(x2), ratio);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const PointV q3 = hn::Mul(e[i].inverse_q, hn::Mul(e[i].inverse_q, e[i].inverse_q));
    area = hn::NegMulAdd(hn::Mul(e[i].m, q3), series(a[i], k[i], terms), area);
  }
  return hn::IfThenElse(by_series, hn::Mul(area, hn::Set(d, 0.5)), direct);
}

static void integrated(const WeightJob<double>& job, double* weights) {
  const PointTag d;
  for (std::size_t l = 0; l < bind_lanes; l += hn::Lanes(d)) {
    const auto p = load_points(d, job.points + l, bind_lanes);
    PointV sum = hn::Zero(d);
    for (std::size_t i = 0; i < job.count; ++i) {
      PointV w = hn::Zero(d);
      if (!job.triangles[i].degenerate)
        w = inverse_fourth_power(p, job.triangles[i], job.shifts[i], job.least_square);
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

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
