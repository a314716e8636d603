// Binding in vector registers: included by bind_kernel.cpp for each instruction set. Internal. (No #pragma once:
// see sym3/exp-inl.h.)
#if defined(VIETE_DEFORM_BIND_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_DEFORM_BIND_KERNEL_INL_H
#undef VIETE_DEFORM_BIND_KERNEL_INL_H
#else
#define VIETE_DEFORM_BIND_KERNEL_INL_H
#endif

#include "deform/bind_kernel.h"
#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = viete::sym3::HWY_NAMESPACE;

constexpr std::size_t row_lanes = 16;

using PointTag = hn::CappedTag<double, bind_lanes>;
using PointV = hn::Vec<PointTag>;
using Points = lanes::Three<PointV>;

static HWY_INLINE Points relative(const Points& p, const double* to) {
  const PointTag d;
  return {hn::Sub(p.x, hn::Set(d, to[0])), hn::Sub(p.y, hn::Set(d, to[1])), hn::Sub(p.z, hn::Set(d, to[2]))};
}

static HWY_INLINE PointV along(const Points& p, const double* v) {
  const PointTag d;
  return lanes::sum_of_products(p.x, hn::Set(d, v[0]), p.y, hn::Set(d, v[1]), p.z, hn::Set(d, v[2]));
}

// Of points relative to the edge's first corner.
static HWY_INLINE PointV squared_distance_to_edge(const Points& p, const double* edge, double inverse) {
  const PointTag d;
  const PointV t = hn::Min(hn::Max(hn::Mul(along(p, edge), hn::Set(d, inverse)), hn::Zero(d)), hn::Set(d, 1.0));
  const PointV x = hn::NegMulAdd(t, hn::Set(d, edge[0]), p.x), y = hn::NegMulAdd(t, hn::Set(d, edge[1]), p.y);
  const PointV z = hn::NegMulAdd(t, hn::Set(d, edge[2]), p.z);
  return lanes::sum_of_products(x, x, y, y, z, z);
}

// To the plane where the foot lies inside, else to the nearest edge: no matter which where it lies on one.
static HWY_INLINE PointV squared_distance(const Points& p, const DistanceTriangle& t) {
  const PointTag d;
  const Points a = relative(p, t.corner[0]), b = relative(p, t.corner[1]), c = relative(p, t.corner[2]);
  const PointV height = along(a, t.normal);
  const PointV depth = hn::Min(along(a, t.inward[0]), hn::Min(along(b, t.inward[1]), along(c, t.inward[2])));
  const PointV edges = hn::Min(squared_distance_to_edge(a, t.edge[0], t.inverse[0]),
                               hn::Min(squared_distance_to_edge(b, t.edge[1], t.inverse[1]),
                                       squared_distance_to_edge(c, t.edge[2], t.inverse[2])));
  return hn::IfThenElse(hn::Ge(depth, hn::Set(d, t.outside)), hn::Mul(height, height), edges);
}

static void inverse_distance(const WeightJob& job, double* weights) {
  const PointTag d;
  for (std::size_t l = 0; l < bind_lanes; l += hn::Lanes(d)) {
    const double* at = job.points + l;
    const Points p{hn::LoadU(d, at), hn::LoadU(d, at + bind_lanes), hn::LoadU(d, at + 2 * bind_lanes)};
    const PointV contact = hn::Set(d, job.squared_contact);
    PointV nearest = hn::Set(d, 1e300), sum = hn::Zero(d);
    for (std::size_t i = 0; i < job.count; ++i) {
      const PointV square = hn::Max(contact, squared_distance(p, job.triangles[i]));
      hn::StoreU(square, d, weights + i * bind_lanes + l);
      if (job.triangles[i].degenerate == 0) nearest = hn::Min(nearest, square);
    }
    for (std::size_t i = 0; i < job.count; ++i) {
      double* w = weights + i * bind_lanes + l;
      const PointV ratio = job.triangles[i].degenerate == 0 ? hn::Div(nearest, hn::LoadU(d, w)) : hn::Zero(d);
      sum = hn::Add(sum, ratio);
      hn::StoreU(ratio, d, w);
    }
    const PointV scale = hn::Div(hn::Set(d, 1.0), sum);
    for (std::size_t i = 0; i < job.count; ++i) {
      double* w = weights + i * bind_lanes + l;
      hn::StoreU(hn::Mul(scale, hn::LoadU(d, w)), d, w);
    }
  }
}

static void to_rows(const RowJob& job) {
  const PointTag d;
  const hn::Rebind<float, PointTag> narrow;
  for (std::size_t l = 0; l < bind_lanes; l += hn::Lanes(d)) {
    PointV x = hn::Zero(d), y = x, z = x;
    for (std::size_t j = 0; j < job.count; ++j) {
      const auto w = hn::DemoteTo(narrow, hn::LoadU(d, job.weights + j * bind_lanes + l));
      hn::StoreU(w, narrow, job.rows + j * row_lanes + l);
      const PointV back = hn::PromoteTo(d, w);
      x = hn::MulAdd(back, hn::Set(d, job.handles[j][0]), x);
      y = hn::MulAdd(back, hn::Set(d, job.handles[j][1]), y);
      z = hn::MulAdd(back, hn::Set(d, job.handles[j][2]), z);
    }
    hn::StoreU(x, d, job.sums + l);
    hn::StoreU(y, d, job.sums + bind_lanes + l);
    hn::StoreU(z, d, job.sums + 2 * bind_lanes + l);
  }
}

using RowTag = hn::CappedTag<float, row_lanes>;
using RowV = hn::Vec<RowTag>;

// Four chains of sums: one would wait for itself.
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
  for (; j < columns; ++j) s[0] = hn::MulAdd(hn::Load(d, rows + j * row_lanes), hn::Set(d, unit_row[j]), s[0]);
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

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
