// Mean value coordinates in vector registers, one point per lane. bind_kernel.cpp includes this file once per
// instruction set. (No #pragma once: see sym3/exp-inl.h.)
#if defined(VIETE_WEIGHTS_MEAN_VALUE_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_WEIGHTS_MEAN_VALUE_KERNEL_INL_H
#undef VIETE_WEIGHTS_MEAN_VALUE_KERNEL_INL_H
#else
#define VIETE_WEIGHTS_MEAN_VALUE_KERNEL_INL_H
#endif

#include "sym3/lanes-inl.h"
#include "weights/bind_jobs.h"

HWY_BEFORE_NAMESPACE();
namespace viete::weights::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = viete::sym3::HWY_NAMESPACE;

using ViewTag = hn::CappedTag<double, bind_lanes>;
using ViewV = hn::Vec<ViewTag>;

// Mean value coordinates of a point p (Ju, Schaefer, Warren 2005). For each triangle, u_i are the unit
// directions from p to the corners, and a_i is the angle between u_(i+1) and u_(i+2). Indices are modulo 3.
//     c_i = u_(i+1) x u_(i+2)                    has the length sin(a_i)
//     m   = sum of a_i / (2 * sin(a_i)) * c_i    is the integral of unit vectors over the spherical triangle
//     s_i = dot(c_i, m) / dot(c_0, u_0)          solves m = sum of s_i * u_i (Cramer's rule)
// A corner's weight is the sum of s_i over the corner's triangles, divided by the distance from p to the
// corner. The two triangles at an edge have equal a_i and opposite c_i, so c_i is computed once per edge.

constexpr double in_plane = 1e-8;   // limit of |dot(c_0, u_0)| / (largest product of two sines)
constexpr double vanishing = 1e-9;  // limit of |sum of weights| / (sum of |weights|)
constexpr double pi = 3.14159265358979323846;

// Returns 1 / sqrt(x) with an error of at most two ulp, for x from 1e-38 to 1e38. Improves the hardware
// estimate by two third-order steps. A square root and a division would take three times as long.
static HWY_INLINE ViewV inverse_root(ViewV x) {
  const ViewTag d;
  const hn::Rebind<float, ViewTag> narrow;
  ViewV y = hn::PromoteTo(d, hn::ApproximateReciprocalSqrt(hn::DemoteTo(narrow, x)));
#pragma GCC unroll 2
  for (int step = 0; step < 2; ++step) {
    const ViewV e = hn::NegMulAdd(hn::Mul(x, y), y, hn::Set(d, 1.0));
    y = hn::MulAdd(hn::Mul(y, e), hn::MulAdd(e, hn::Set(d, 0.375), hn::Set(d, 0.5)), y);
  }
  return y;
}

// Returns angle / sine for a cosine from 0 to 1. Interpolates at Chebyshev points, with an error of 4e-17.
static HWY_INLINE ViewV angle_over_sine(ViewV cosine) {
  static constexpr double powers[] = {1.0,
                                      0.33333333333330945,
                                      0.13333333333682526,
                                      0.05714285694042784,
                                      0.025396831596651948,
                                      0.011543895604776996,
                                      0.00532944828305169,
                                      0.0024737607111697374,
                                      0.001251083869870826,
                                      0.00016421047913476515,
                                      0.0017011133906985544,
                                      -0.003976427223224787,
                                      0.009195329684833449,
                                      -0.01586170544127971,
                                      0.02153400343586953,
                                      -0.022454256450108755,
                                      0.01773831596916336,
                                      -0.01025927464062151,
                                      0.004114940516850556,
                                      -0.001025639660813829,
                                      0.00012117305831116537};
  const ViewTag d;
  return lanes::horner(d, powers, hn::Sub(hn::Set(d, 1.0), cosine));
}

// Directions from eight points to the cage. Each number is an array of bind_lanes values.
struct Seen {
  double* directions;  // [corner][x y z, inverse distance]
  double* edges;       // [edge][cross product of the directions x y z, angle / (2 sine), squared sine]
};
constexpr std::size_t corner_size = 4 * bind_lanes, edge_size = 5 * bind_lanes;

static HWY_INLINE lanes::Three<ViewV> load_three(const double* at) {
  const ViewTag d;
  return {hn::LoadU(d, at), hn::LoadU(d, at + bind_lanes), hn::LoadU(d, at + 2 * bind_lanes)};
}

static HWY_INLINE ViewV dot(const lanes::Three<ViewV>& a, const lanes::Three<ViewV>& b) {
  return lanes::sum_of_products(a.x, b.x, a.y, b.y, a.z, b.z);
}

static void see_corners(const MeanValueJob& job, std::size_t lane, const Seen& seen) {
  const ViewTag d;
  const auto p = load_three(job.points + lane);
  for (std::size_t j = 0; j < job.corner_count; ++j) {
    const lanes::Three<ViewV> q{hn::Sub(hn::Set(d, job.corners[j][0]), p.x),
                                hn::Sub(hn::Set(d, job.corners[j][1]), p.y),
                                hn::Sub(hn::Set(d, job.corners[j][2]), p.z)};
    const ViewV inverse = inverse_root(dot(q, q));
    double* out = seen.directions + j * corner_size + lane;
    hn::StoreU(hn::Mul(q.x, inverse), d, out);
    hn::StoreU(hn::Mul(q.y, inverse), d, out + bind_lanes);
    hn::StoreU(hn::Mul(q.z, inverse), d, out + 2 * bind_lanes);
    hn::StoreU(inverse, d, out + 3 * bind_lanes);
  }
}

// Fills seen.edges. For angles above 90 degrees, uses angle / sine = pi / sine - angle_over_sine(-cosine).
static void see_edges(const MeanValueJob& job, std::size_t lane, const Seen& seen) {
  const ViewTag d;
  for (std::size_t e = 0; e < job.edge_count; ++e) {
    const auto u = load_three(seen.directions + job.edges[e][0] * corner_size + lane);
    const auto v = load_three(seen.directions + job.edges[e][1] * corner_size + lane);
    const lanes::Three<ViewV> c{lanes::difference_of_products(u.y, v.z, u.z, v.y),
                                lanes::difference_of_products(u.z, v.x, u.x, v.z),
                                lanes::difference_of_products(u.x, v.y, u.y, v.x)};
    const ViewV squared_sine = dot(c, c), cosine = dot(u, v);
    const ViewV ratio = angle_over_sine(hn::Abs(cosine));
    const ViewV beyond = hn::MulSub(hn::Set(d, pi), inverse_root(squared_sine), ratio);
    const ViewV angle = hn::IfThenElse(hn::Lt(cosine, hn::Zero(d)), beyond, ratio);
    double* out = seen.edges + e * edge_size + lane;
    hn::StoreU(c.x, d, out);
    hn::StoreU(c.y, d, out + bind_lanes);
    hn::StoreU(c.z, d, out + 2 * bind_lanes);
    hn::StoreU(hn::Mul(hn::Set(d, 0.5), angle), d, out + 3 * bind_lanes);
    hn::StoreU(squared_sine, d, out + 4 * bind_lanes);
  }
}

// Adds s_i to the weights of the corners. Returns the lanes in which p may be in the triangle's plane.
static HWY_INLINE hn::Mask<ViewTag> add_triangle(const MeanValueTriangle& t, std::size_t lane,
                                                 const Seen& seen, double* weights) {
  const ViewTag d;
  lanes::Three<ViewV> c[3], m{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  ViewV squared_sine[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const double* edge = seen.edges + t.edge[i] * edge_size + lane;
    c[i] = load_three(edge);
    const ViewV factor = hn::Mul(hn::Set(d, t.sign[i]), hn::LoadU(d, edge + 3 * bind_lanes));
    m = {hn::MulAdd(factor, c[i].x, m.x), hn::MulAdd(factor, c[i].y, m.y), hn::MulAdd(factor, c[i].z, m.z)};
    squared_sine[i] = hn::LoadU(d, edge + 4 * bind_lanes);
  }
  const ViewV volume = dot(load_three(seen.directions + t.corner[0] * corner_size + lane), c[0]);
  const ViewV signed_inverse = hn::Div(hn::Set(d, t.sign[0]), volume);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    double* w = weights + t.corner[i] * bind_lanes + lane;
    const ViewV share = hn::Mul(dot(c[i], m), hn::Mul(hn::Set(d, t.sign[i]), signed_inverse));
    hn::StoreU(hn::Add(hn::LoadU(d, w), share), d, w);
  }
  const ViewV sines = hn::Max(hn::Mul(squared_sine[0], squared_sine[1]),
                              hn::Mul(squared_sine[2], hn::Max(squared_sine[0], squared_sine[1])));
  return hn::Not(hn::Gt(hn::Mul(volume, volume), hn::Mul(sines, hn::Set(d, in_plane * in_plane))));
}

static unsigned mean_value(const MeanValueJob& job, double* weights) {
  const ViewTag d;
  const Seen seen{job.scratch, job.scratch + job.corner_count * corner_size};
  unsigned left = 0;
  for (std::size_t lane = 0; lane < bind_lanes; lane += hn::Lanes(d)) {
    see_corners(job, lane, seen);
    see_edges(job, lane, seen);
    for (std::size_t j = 0; j < job.corner_count; ++j)
      hn::StoreU(hn::Zero(d), d, weights + j * bind_lanes + lane);
    auto unclear = hn::Lt(hn::Zero(d), hn::Zero(d));
    for (std::size_t t = 0; t < job.triangle_count; ++t) {
      unclear = hn::Or(unclear, add_triangle(job.triangles[t], lane, seen, weights));
    }
    ViewV sum = hn::Zero(d), size = hn::Zero(d);
    for (std::size_t j = 0; j < job.corner_count; ++j) {
      double* w = weights + j * bind_lanes + lane;
      const ViewV weight =
          hn::Mul(hn::LoadU(d, w), hn::LoadU(d, seen.directions + j * corner_size + 3 * bind_lanes + lane));
      hn::StoreU(weight, d, w);
      sum = hn::Add(sum, weight);
      size = hn::Add(size, hn::Abs(weight));
    }
    unclear = hn::Or(unclear, hn::Not(hn::Gt(hn::Abs(sum), hn::Mul(size, hn::Set(d, vanishing)))));
    const ViewV scale = hn::Div(hn::Set(d, 1.0), sum);
    for (std::size_t j = 0; j < job.corner_count; ++j) {
      double* w = weights + j * bind_lanes + lane;
      hn::StoreU(hn::Mul(scale, hn::LoadU(d, w)), d, w);
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, unclear, bits);
    left |= unsigned(bits[0]) << lane;
  }
  return left;
}

}  // namespace viete::weights::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
