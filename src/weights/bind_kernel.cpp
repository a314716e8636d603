#include "weights/bind_kernel.h"

#include "sym3/highway_targets.h"

#define HWY_TARGET_INCLUDE "weights/bind_kernel.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>

#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();

namespace viete::weights::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = viete::sym3::HWY_NAMESPACE;

constexpr std::size_t row_lanes = 16;
constexpr float farthest = 1e24f;           // limit of squared distances for float, in squared cage diagonals
constexpr std::size_t summed_at_once = 16;  // terms per partial sum: short sums have small rounding errors

using PointTag = hn::CappedTag<double, bind_lanes>;
using PointV = hn::Vec<PointTag>;

template <class D>
using Points = lanes::Three<hn::Vec<D>>;

template <class D>
static HWY_INLINE Points<D> load_points(D d, const hn::TFromD<D>* at, std::size_t stride) {
  return {hn::LoadU(d, at), hn::LoadU(d, at + stride), hn::LoadU(d, at + 2 * stride)};
}

template <class D, class T = hn::TFromD<D>>
static HWY_INLINE hn::Vec<D> along(D d, const Points<D>& p, const T* axis, T shift) {
  return hn::MulAdd(
      p.x, hn::Set(d, axis[0]),
      hn::MulAdd(p.y, hn::Set(d, axis[1]), hn::MulSub(p.z, hn::Set(d, axis[2]), hn::Set(d, shift))));
}

template <class D, class V = hn::Vec<D>>
static HWY_INLINE V linear(D d, const hn::TFromD<D>* c, V x, V y) {
  return hn::MulAdd(hn::Set(d, c[0]), x, hn::MulAdd(hn::Set(d, c[1]), y, hn::Set(d, c[2])));
}

// Returns the squared distance from an edge to the point (along, beside) in coordinates of the edge.
template <class D, class V = hn::Vec<D>>
static HWY_INLINE V squared_distance_to_edge(D d, V along, V beside, hn::TFromD<D> length) {
  const V beyond = hn::Sub(along, hn::Min(hn::Max(along, hn::Zero(d)), hn::Set(d, length)));
  return hn::MulAdd(beyond, beyond, hn::Mul(beside, beside));
}

// Returns the squared distance from a point to a triangle. This is z^2, the squared distance to the plane,
// plus the squared distance from the point's projection (x, y) to the triangle, which is 0 inside.
template <class D, class T = hn::TFromD<D>>
static HWY_INLINE hn::Vec<D> squared_distance(D d, const Points<D>& p, const DistanceTriangle<T>& t,
                                              const T* shift) {
  const auto x = along(d, p, t.axes[0], shift[0]), y = along(d, p, t.axes[1], shift[1]);
  const auto z = along(d, p, t.axes[2], shift[2]);
  const auto left1 = linear(d, t.inward[0], x, y), left2 = linear(d, t.inward[1], x, y);
  const auto edges =
      hn::Min(squared_distance_to_edge(d, x, y, t.length[0]),
              hn::Min(squared_distance_to_edge(d, linear(d, t.along[0], x, y), left1, t.length[1]),
                      squared_distance_to_edge(d, linear(d, t.along[1], x, y), left2, t.length[2])));
  const auto outside = hn::Lt(hn::Min(y, hn::Min(left1, left2)), hn::Set(d, t.outside));
  return hn::MulAdd(z, z, hn::IfThenElseZero(outside, edges));
}

// Multiplies `count` weights of the points in one vector by a factor.
static HWY_INLINE void scale(PointV factor, std::size_t count, double* weights) {
  const PointTag d;
  for (std::size_t i = 0; i < count; ++i)
    hn::StoreU(hn::Mul(factor, hn::LoadU(d, weights + i * bind_lanes)), d, weights + i * bind_lanes);
}

static void inverse_distance(const WeightJob<double>& job, double* weights) {
  const PointTag d;
  for (std::size_t l = 0; l < bind_lanes; l += hn::Lanes(d)) {
    const auto p = load_points(d, job.points + l, bind_lanes);
    PointV nearest = hn::Set(d, 1e300), sum = hn::Zero(d);
    for (std::size_t i = 0; i < job.count; ++i) {
      const PointV square =
          hn::Max(hn::Set(d, job.least_square), squared_distance(d, p, job.triangles[i], job.shifts[i]));
      hn::StoreU(square, d, weights + i * bind_lanes + l);
      if (job.triangles[i].share > 0) nearest = hn::Min(nearest, square);
    }
    for (std::size_t i = 0; i < job.count; ++i) {
      double* w = weights + i * bind_lanes + l;
      const double part = job.triangles[i].share;
      const PointV ratio =
          part > 0 ? hn::Mul(hn::Set(d, part), hn::Div(nearest, hn::LoadU(d, w))) : hn::Zero(d);
      sum = hn::Add(sum, ratio);
      hn::StoreU(ratio, d, w);
    }
    scale(hn::Div(hn::Set(d, 1.0), sum), job.count, weights + l);
  }
}

constexpr double farthest_in_space = 1e3;  // limit of coordinates, in cage diagonals

// Writes the functions of the centers at the points in one vector, see SpaceJob.
static HWY_INLINE void around_centers(const SpaceJob& job, const double* at, double* values) {
  const PointTag d;
  const PointV limit = hn::Set(d, farthest_in_space);
  auto p = load_points(d, at, bind_lanes);
  for (PointV* x : {&p.x, &p.y, &p.z}) *x = hn::Max(hn::Neg(limit), hn::Min(*x, limit));
  for (std::size_t i = 0; i < job.count; ++i) {
    const PointV x = hn::Sub(p.x, hn::Set(d, job.centers[i][0]));
    const PointV y = hn::Sub(p.y, hn::Set(d, job.centers[i][1]));
    const PointV z = hn::Sub(p.z, hn::Set(d, job.centers[i][2]));
    const PointV least = hn::Set(d, job.width * job.width);
    const PointV r = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::MulAdd(z, z, least))));
    hn::StoreU(job.inverse ? hn::Div(hn::Set(d, 1), r) : r, d, values + i * bind_lanes);
  }
}

// Computes the weights [first, first + space_group) of the points in one vector.
static HWY_INLINE void sum_in_space(const SpaceJob& job, std::size_t first, const double* values,
                                    double* weights) {
  const PointTag d;
  const double* c = job.coefficients + first * job.count;
  PointV sums[space_group];
#pragma GCC unroll 4
  for (std::size_t j = 0; j < space_group; ++j) sums[j] = hn::Set(d, job.constants[first + j]);
  for (std::size_t i = 0; i < job.count; ++i, c += space_group) {
    const PointV value = hn::LoadU(d, values + i * bind_lanes);
#pragma GCC unroll 4
    for (std::size_t j = 0; j < space_group; ++j) sums[j] = hn::MulAdd(hn::Set(d, c[j]), value, sums[j]);
  }
#pragma GCC unroll 4
  for (std::size_t j = 0; j < space_group; ++j) hn::StoreU(sums[j], d, weights + (first + j) * bind_lanes);
}

static void in_space(const SpaceJob& job, double* weights) {
  const PointTag d;
  const PointV threshold = hn::Set(d, job.threshold), quarter = hn::Set(d, 0.25 / job.threshold);
  for (std::size_t l = 0; l < bind_lanes; l += hn::Lanes(d)) {
    around_centers(job, job.points + l, job.scratch + l);
    for (std::size_t j = 0; j < job.count; j += space_group)
      sum_in_space(job, j, job.scratch + l, weights + l);
    PointV sum = hn::Zero(d);
    for (std::size_t j = 0; j < job.count; ++j) {
      double* const at = weights + j * bind_lanes + l;
      const PointV w = hn::Max(hn::Zero(d), hn::LoadU(d, at)), less = hn::Sub(w, threshold);
      const PointV kept = hn::IfThenElse(hn::Lt(less, threshold), hn::Mul(quarter, hn::Mul(w, w)), less);
      hn::StoreU(kept, d, at);
      sum = hn::Add(sum, kept);
    }
    scale(hn::Div(hn::Set(d, 1.0), sum), job.count, weights + l);
  }
}

template <class V>
struct CutOffSum {
  V weights, near;  // near: 1 if a distance is too small for float precision, else 0
};

// Writes the weight of triangle i to weights[i * stride]: (1 - distance * cut)^2, or 0 beyond the radius.
template <class D, class T = hn::TFromD<D>>
static HWY_INLINE CutOffSum<hn::Vec<D>> cut_off_lanes(D d, const WeightJob<T>& job, const Points<D>& p,
                                                      T* weights, std::size_t stride) {
  using V = hn::Vec<D>;
  CutOffSum<V> sum{hn::Zero(d), hn::Zero(d)};
  for (std::size_t i = 0; i < job.count; ++i) {
    const auto& t = job.triangles[i];
    V w = hn::Zero(d);
    if (t.share > 0) {
      const V square = squared_distance(d, p, t, job.shifts[i]);
      const V left = hn::NegMulAdd(hn::Sqrt(square), hn::Set(d, job.cut), hn::Set(d, 1));
      const V inside = hn::Max(hn::Zero(d), left);
      w = hn::Mul(hn::Set(d, t.share), hn::Mul(inside, inside));
      sum.near = hn::Max(sum.near, hn::IfThenElseZero(hn::Lt(square, hn::Set(d, t.near)), hn::Set(d, 1)));
    }
    sum.weights = hn::Add(sum.weights, w);
    hn::StoreU(w, d, weights + i * stride);
  }
  return sum;
}

template <class D, class V = hn::Vec<D>>
static HWY_INLINE V share_of_sum(D d, V sum) {
  return hn::IfThenElseZero(hn::Gt(sum, hn::Zero(d)), hn::Div(hn::Set(d, 1), sum));
}

static void cut_off(const WeightJob<double>& job, double* weights, double* totals) {
  const PointTag d;
  for (std::size_t l = 0; l < bind_lanes; l += hn::Lanes(d)) {
    const auto p = load_points(d, job.points + l, bind_lanes);
    const PointV sum = cut_off_lanes(d, job, p, weights + l, bind_lanes).weights;
    hn::StoreU(sum, d, totals + l);
    scale(share_of_sum(d, sum), job.count, weights + l);
  }
}

// For every handle i, writes weight(i) to job.rows[i] from `lane` on. Computes job.sums.
template <class Weight>
static HWY_INLINE void fill_rows(const RowJob& job, std::size_t lane, const Weight& weight) {
  const PointTag d;
  const hn::Rebind<float, PointTag> narrow;
  PointV x = hn::Zero(d), y = x, z = x;
  for (std::size_t i = 0; i < job.count; ++i) {
    const auto w = weight(i);
    hn::StoreU(w, narrow, job.rows + i * row_lanes + lane);
    const PointV back = hn::PromoteTo(d, w);
    x = hn::MulAdd(back, hn::Set(d, job.handles[i][0]), x);
    y = hn::MulAdd(back, hn::Set(d, job.handles[i][1]), y);
    z = hn::MulAdd(back, hn::Set(d, job.handles[i][2]), z);
  }
  hn::StoreU(x, d, job.sums + lane);
  hn::StoreU(y, d, job.sums + row_lanes + lane);
  hn::StoreU(z, d, job.sums + 2 * row_lanes + lane);
}

static void to_rows(const double* weights, const RowJob& job) {
  const PointTag d;
  const hn::Rebind<float, PointTag> narrow;
  for (std::size_t l = 0; l < bind_lanes; l += hn::Lanes(d)) {
    fill_rows(job, l, [&](std::size_t i) {
      return hn::DemoteTo(narrow, hn::LoadU(d, weights + i * bind_lanes + l));
    });
  }
}

using RowTag = hn::CappedTag<float, row_lanes>;
using RowV = hn::Vec<RowTag>;

// Returns 1 / x with an error of at most two ulp. Improves the processor's estimate by one third-order step.
// This takes a third of the time of a division.
static HWY_INLINE RowV inverse(RowV x) {
  const RowTag d;
  const RowV y = hn::ApproximateReciprocal(x), e = hn::NegMulAdd(x, y, hn::Set(d, 1.0f));
  return hn::MulAdd(y, hn::MulAdd(e, e, e), y);
}

// Multiplies the weights of each lane by shares[lane], and computes out.sums from the new weights.
static void normalise_rows(const float* shares, const RowJob& out) {
  const hn::Rebind<float, PointTag> half;
  for (std::size_t l = 0; l < row_lanes; l += hn::Lanes(half)) {
    const auto share = hn::LoadU(half, shares + l);
    fill_rows(out, l,
              [&](std::size_t i) { return hn::Mul(share, hn::LoadU(half, out.rows + i * row_lanes + l)); });
  }
}

static bool inverse_distance_rows(const WeightJob<float>& job, const RowJob& out) {
  const RowTag d;
  HWY_ALIGN float shares[row_lanes];
  for (std::size_t l = 0; l < row_lanes; l += hn::Lanes(d)) {
    const auto p = load_points(d, job.points + l, row_lanes);
    RowV nearest = hn::Set(d, farthest), sum = hn::Zero(d);
    auto near = hn::Lt(nearest, hn::Zero(d));
    for (std::size_t i = 0; i < job.count; ++i) {
      const auto& t = job.triangles[i];
      const RowV square = hn::Max(hn::Set(d, job.least_square), squared_distance(d, p, t, job.shifts[i]));
      hn::StoreU(square, d, out.rows + i * row_lanes + l);
      if (!(t.share > 0)) continue;
      nearest = hn::Min(nearest, square);
      near = hn::Or(near, hn::Lt(square, hn::Set(d, t.near)));
    }
    if (!hn::AllFalse(d, hn::Or(near, hn::Ge(nearest, hn::Set(d, farthest))))) return false;
    for (std::size_t block = 0; block < job.count; block += summed_at_once) {
      RowV part = hn::Zero(d);
      for (std::size_t i = block; i < std::min(block + summed_at_once, job.count); ++i) {
        float* w = out.rows + i * row_lanes + l;
        const float of_one = job.triangles[i].share;
        const RowV ratio = of_one > 0
                               ? hn::Mul(hn::Set(d, of_one), hn::Mul(nearest, inverse(hn::LoadU(d, w))))
                               : hn::Zero(d);
        part = hn::Add(part, ratio);
        hn::StoreU(ratio, d, w);
      }
      sum = hn::Add(sum, part);
    }
    hn::StoreU(hn::Div(hn::Set(d, 1.0f), sum), d, shares + l);
  }
  normalise_rows(shares, out);
  return true;
}

static bool cut_off_rows(const WeightJob<float>& job, const RowJob& out) {
  constexpr float least_total = 1e-30f;  // the smallest sum with an accurate inverse
  const RowTag d;
  HWY_ALIGN float shares[row_lanes];
  for (std::size_t l = 0; l < row_lanes; l += hn::Lanes(d)) {
    const auto p = load_points(d, job.points + l, row_lanes);
    const auto [sum, near] = cut_off_lanes(d, job, p, out.rows + l, row_lanes);
    const auto tiny = hn::And(hn::Gt(sum, hn::Zero(d)), hn::Lt(sum, hn::Set(d, least_total)));
    if (!hn::AllFalse(d, hn::Or(tiny, hn::Gt(near, hn::Zero(d))))) return false;
    hn::StoreU(sum, d, out.totals + l);
    hn::StoreU(share_of_sum(d, sum), d, shares + l);
  }
  normalise_rows(shares, out);
  return true;
}

// Returns each row's dot product with a unit row. Four separate sums hide the latency of additions.
static HWY_INLINE RowV product_with(const float* rows, std::size_t columns, const float* unit_row) {
  const RowTag d;
  RowV s[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  std::size_t j = 0;
  for (; j + 4 <= columns; j += 4) {
#pragma GCC unroll 4
    for (std::size_t i = 0; i < 4; ++i) {
      s[i] = hn::MulAdd(hn::Load(d, rows + (j + i) * row_lanes), hn::Set(d, unit_row[j + i]), s[i]);
    }
  }
  for (; j < columns; ++j)
    s[0] = hn::MulAdd(hn::Load(d, rows + j * row_lanes), hn::Set(d, unit_row[j]), s[0]);
  return hn::Add(hn::Add(s[0], s[1]), hn::Add(s[2], s[3]));
}

static void take_out(const LeafRows& leaf, const float* unit_row, float* coefficients, float* squared_norms) {
  const RowTag d;
  for (std::size_t group = 0; group < leaf.tiles * row_lanes; group += hn::Lanes(d)) {
    float* rows = leaf.rows + group / row_lanes * row_lanes * leaf.columns + group % row_lanes;
    const RowV c = product_with(rows, leaf.columns, unit_row);
    RowV norm = hn::Zero(d);
    for (std::size_t j = 0; j < leaf.columns; ++j) {
      const RowV left = hn::NegMulAdd(c, hn::Set(d, unit_row[j]), hn::Load(d, rows + j * row_lanes));
      hn::Store(left, d, rows + j * row_lanes);
      norm = hn::MulAdd(left, left, norm);
    }
    hn::Store(c, d, coefficients + group);
    hn::Store(norm, d, squared_norms + group);
  }
}

static void solve(float* coefficients, std::size_t tiles, std::size_t rank, const float* lower) {
  const RowTag d;
  for (std::size_t group = 0; group < tiles * row_lanes; group += hn::Lanes(d)) {
    float* u = coefficients + group / row_lanes * row_lanes * rank + group % row_lanes;
    for (std::size_t s = rank; s-- > 0;) {
      RowV v = hn::Load(d, u + s * row_lanes);
      for (std::size_t t = s + 1; t < rank; ++t) {
        v = hn::NegMulAdd(hn::Load(d, u + t * row_lanes), hn::Set(d, lower[t * rank + s]), v);
      }
      hn::Store(hn::Mul(v, hn::Set(d, 1 / lower[s * rank + s])), d, u + s * row_lanes);
    }
  }
}

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
static HWY_INLINE PointV inverse_root(PointV x) {
  const PointTag d;
  const hn::Rebind<float, PointTag> narrow;
  PointV y = hn::PromoteTo(d, hn::ApproximateReciprocalSqrt(hn::DemoteTo(narrow, x)));
#pragma GCC unroll 2
  for (int step = 0; step < 2; ++step) {
    const PointV e = hn::NegMulAdd(hn::Mul(x, y), y, hn::Set(d, 1.0));
    y = hn::MulAdd(hn::Mul(y, e), hn::MulAdd(e, hn::Set(d, 0.375), hn::Set(d, 0.5)), y);
  }
  return y;
}

// Returns angle / sine for a cosine from 0 to 1. Interpolates at Chebyshev points, with an error of 4e-17.
static HWY_INLINE PointV angle_over_sine(PointV cosine) {
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
  const PointTag d;
  return lanes::horner(d, powers, hn::Sub(hn::Set(d, 1.0), cosine));
}

// Directions from eight points to the cage. Each number is an array of bind_lanes values.
struct Seen {
  double* directions;  // [corner][x y z, inverse distance]
  double* edges;       // [edge][cross product of the directions x y z, angle / (2 sine), squared sine]
};
constexpr std::size_t corner_size = 4 * bind_lanes, edge_size = 5 * bind_lanes;

static HWY_INLINE lanes::Three<PointV> load_three(const double* at) {
  const PointTag d;
  return {hn::LoadU(d, at), hn::LoadU(d, at + bind_lanes), hn::LoadU(d, at + 2 * bind_lanes)};
}

static HWY_INLINE PointV dot(const lanes::Three<PointV>& a, const lanes::Three<PointV>& b) {
  return lanes::sum_of_products(a.x, b.x, a.y, b.y, a.z, b.z);
}

static void see_corners(const MeanValueJob& job, std::size_t lane, const Seen& seen) {
  const PointTag d;
  const auto p = load_three(job.points + lane);
  for (std::size_t j = 0; j < job.corner_count; ++j) {
    const lanes::Three<PointV> q{hn::Sub(hn::Set(d, job.corners[j][0]), p.x),
                                 hn::Sub(hn::Set(d, job.corners[j][1]), p.y),
                                 hn::Sub(hn::Set(d, job.corners[j][2]), p.z)};
    const PointV inverse = inverse_root(dot(q, q));
    double* out = seen.directions + j * corner_size + lane;
    hn::StoreU(hn::Mul(q.x, inverse), d, out);
    hn::StoreU(hn::Mul(q.y, inverse), d, out + bind_lanes);
    hn::StoreU(hn::Mul(q.z, inverse), d, out + 2 * bind_lanes);
    hn::StoreU(inverse, d, out + 3 * bind_lanes);
  }
}

// Fills seen.edges. For angles above 90 degrees, uses angle / sine = pi / sine - angle_over_sine(-cosine).
static void see_edges(const MeanValueJob& job, std::size_t lane, const Seen& seen) {
  const PointTag d;
  for (std::size_t e = 0; e < job.edge_count; ++e) {
    const auto u = load_three(seen.directions + job.edges[e][0] * corner_size + lane);
    const auto v = load_three(seen.directions + job.edges[e][1] * corner_size + lane);
    const lanes::Three<PointV> c{lanes::difference_of_products(u.y, v.z, u.z, v.y),
                                 lanes::difference_of_products(u.z, v.x, u.x, v.z),
                                 lanes::difference_of_products(u.x, v.y, u.y, v.x)};
    const PointV squared_sine = dot(c, c), cosine = dot(u, v);
    const PointV ratio = angle_over_sine(hn::Abs(cosine));
    const PointV beyond = hn::MulSub(hn::Set(d, pi), inverse_root(squared_sine), ratio);
    const PointV angle = hn::IfThenElse(hn::Lt(cosine, hn::Zero(d)), beyond, ratio);
    double* out = seen.edges + e * edge_size + lane;
    hn::StoreU(c.x, d, out);
    hn::StoreU(c.y, d, out + bind_lanes);
    hn::StoreU(c.z, d, out + 2 * bind_lanes);
    hn::StoreU(hn::Mul(hn::Set(d, 0.5), angle), d, out + 3 * bind_lanes);
    hn::StoreU(squared_sine, d, out + 4 * bind_lanes);
  }
}

// Adds s_i to the weights of the corners. Returns the lanes in which p may be in the triangle's plane.
static HWY_INLINE hn::Mask<PointTag> add_triangle(const MeanValueTriangle& t, std::size_t lane,
                                                  const Seen& seen, double* weights) {
  const PointTag d;
  lanes::Three<PointV> c[3], m{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  PointV squared_sine[3];
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const double* edge = seen.edges + t.edge[i] * edge_size + lane;
    c[i] = load_three(edge);
    const PointV factor = hn::Mul(hn::Set(d, t.sign[i]), hn::LoadU(d, edge + 3 * bind_lanes));
    m = {hn::MulAdd(factor, c[i].x, m.x), hn::MulAdd(factor, c[i].y, m.y), hn::MulAdd(factor, c[i].z, m.z)};
    squared_sine[i] = hn::LoadU(d, edge + 4 * bind_lanes);
  }
  const PointV volume = dot(load_three(seen.directions + t.corner[0] * corner_size + lane), c[0]);
  const PointV signed_inverse = hn::Div(hn::Set(d, t.sign[0]), volume);
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    double* w = weights + t.corner[i] * bind_lanes + lane;
    const PointV share = hn::Mul(dot(c[i], m), hn::Mul(hn::Set(d, t.sign[i]), signed_inverse));
    hn::StoreU(hn::Add(hn::LoadU(d, w), share), d, w);
  }
  const PointV sines = hn::Max(hn::Mul(squared_sine[0], squared_sine[1]),
                               hn::Mul(squared_sine[2], hn::Max(squared_sine[0], squared_sine[1])));
  return hn::Not(hn::Gt(hn::Mul(volume, volume), hn::Mul(sines, hn::Set(d, in_plane * in_plane))));
}

static unsigned mean_value(const MeanValueJob& job, double* weights) {
  const PointTag d;
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
    PointV sum = hn::Zero(d), size = hn::Zero(d);
    for (std::size_t j = 0; j < job.corner_count; ++j) {
      double* w = weights + j * bind_lanes + lane;
      const PointV weight =
          hn::Mul(hn::LoadU(d, w), hn::LoadU(d, seen.directions + j * corner_size + 3 * bind_lanes + lane));
      hn::StoreU(weight, d, w);
      sum = hn::Add(sum, weight);
      size = hn::Add(size, hn::Abs(weight));
    }
    unclear = hn::Or(unclear, hn::Not(hn::Gt(hn::Abs(sum), hn::Mul(size, hn::Set(d, vanishing)))));
    scale(hn::Div(hn::Set(d, 1.0), sum), job.corner_count, weights + lane);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, unclear, bits);
    left |= unsigned(bits[0]) << lane;
  }
  return left;
}

static constexpr BindKernel bind = {.inverse_distance = inverse_distance,
                                    .inverse_distance_rows = inverse_distance_rows,
                                    .cut_off = cut_off,
                                    .cut_off_rows = cut_off_rows,
                                    .mean_value = mean_value,
                                    .in_space = in_space,
                                    .to_rows = to_rows,
                                    .take_out = take_out,
                                    .solve = solve};

}  // namespace viete::weights::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace viete::weights {

const BindKernel& bind_kernel(const sym3::Kernel& kernel) {
  VIETE_RETURN_COMPILED(bind, kernel.highway_target);
}

}  // namespace viete::weights

#endif
