// Products of small matrices, compiled once for each instruction set.
#include "shapes/plane_kernel.h"

#include "sparse/sparse_kernel.h"
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "shapes/plane_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "sym3/exp-inl.h"
#include "sym3/exp_derivative-inl.h"
#include "sym3/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::shapes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace lanes = viete::sym3::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, group_size>;
using V = hn::Vec<Tag>;
constexpr std::size_t width = hn::MaxLanes(Tag());

static HWY_INLINE V at(const Plane& plane, std::size_t i) {
  return hn::Load(Tag(), plane + i);
}
static HWY_INLINE void put(V v, Plane& plane, std::size_t i) {
  hn::Store(v, Tag(), plane + i);
}

// Returns a * x + b * y + c * z, without fused multiply-add.
static HWY_INLINE V sum(V a, V x, V b, V y, V c, V z) {
  return hn::Add(hn::Add(hn::Mul(a, x), hn::Mul(b, y)), hn::Mul(c, z));
}

template <class D>
static HWY_INLINE void add_rows_at(D d, const ScaledRows* rows, std::size_t count, std::size_t i,
                                   double* sums) {
  auto sum = hn::LoadU(d, sums + i);
  for (std::size_t k = 0; k < count; ++k)
    sum = hn::Add(sum, hn::Mul(hn::Set(d, rows[k].factor), hn::LoadU(d, rows[k].numbers + i)));
  hn::StoreU(sum, d, sums + i);
}

static void add_rows(const ScaledRows* rows, std::size_t count, std::size_t n, double* sums) {
  std::size_t i = 0;
  for (; i + width <= n; i += width) add_rows_at(Tag(), rows, count, i, sums);
  for (; i < n; ++i) add_rows_at(hn::CappedTag<double, 1>(), rows, count, i, sums);
}

static void times_symmetric(const Plane* m, const Plane* s, Plane* product) {
  for (std::size_t i = 0; i < plane_size; i += width) {
    const V xx = at(s[0], i), xy = at(s[1], i), xz = at(s[2], i), yy = at(s[3], i), yz = at(s[4], i),
            zz = at(s[5], i);
    for (std::size_t row = 0; row < 9; row += 3) {
      const V a = at(m[row], i), b = at(m[row + 1], i), c = at(m[row + 2], i);
      put(sum(a, xx, b, xy, c, xz), product[row], i);
      put(sum(a, xy, b, yy, c, yz), product[row + 1], i);
      put(sum(a, xz, b, yz, c, zz), product[row + 2], i);
    }
  }
}

static void map(const Plane* logs, const double* r, const Plane* next, Plane* s, Plane* m) {
  V turn[9];
  for (std::size_t n = 0; r && n < 9; ++n) turn[n] = hn::Set(Tag(), r[n]);
  for (std::size_t i = 0; i < plane_size; i += width) {
    for (std::size_t n = 0; i % group_size == 0 && n < 12; ++n) hwy::Prefetch(next[n] + i);
    const lanes::Six<V> e =
        lanes::exp_lanes(Tag(), lanes::Six<V>{at(logs[0], i), at(logs[1], i), at(logs[2], i), at(logs[3], i),
                                              at(logs[4], i), at(logs[5], i)});
    put(e.xx, s[0], i);
    put(e.xy, s[1], i);
    put(e.xz, s[2], i);
    put(e.yy, s[3], i);
    put(e.yz, s[4], i);
    put(e.zz, s[5], i);
    const auto q =
        lanes::exp_rotation_lanes(Tag(), lanes::Three<V>{at(logs[6], i), at(logs[7], i), at(logs[8], i)});
    V of[9] = {sum(q.xx, e.xx, q.xy, e.xy, q.xz, e.xz), sum(q.xx, e.xy, q.xy, e.yy, q.xz, e.yz),
               sum(q.xx, e.xz, q.xy, e.yz, q.xz, e.zz), sum(q.yx, e.xx, q.yy, e.xy, q.yz, e.xz),
               sum(q.yx, e.xy, q.yy, e.yy, q.yz, e.yz), sum(q.yx, e.xz, q.yy, e.yz, q.yz, e.zz),
               sum(q.zx, e.xx, q.zy, e.xy, q.zz, e.xz), sum(q.zx, e.xy, q.zy, e.yy, q.zz, e.yz),
               sum(q.zx, e.xz, q.zy, e.yz, q.zz, e.zz)};
    for (std::size_t n = 0; n < 9; ++n) {
      const std::size_t k = n % 3, j = n - k;
      put(r ? sum(turn[j], of[k], turn[j + 1], of[3 + k], turn[j + 2], of[6 + k]) : of[n], m[n], i);
    }
  }
}

static void pull(const Plane* m, const Plane* sides, const Plane* weights, Plane* pulls) {
  const V one = hn::Set(Tag(), 1);
  for (std::size_t i = 0; i < plane_size; i += width) {
    V map[9];
    for (std::size_t n = 0; n < 9; ++n) map[n] = n % 4 == 0 ? hn::Sub(at(m[n], i), one) : at(m[n], i);
    for (std::size_t k = 0; k < 3; ++k) {
      const V x = at(sides[3 * k], i), y = at(sides[3 * k + 1], i), z = at(sides[3 * k + 2], i);
      const V weight = at(weights[k], i);
      for (std::size_t j = 0; j < 3; ++j)
        put(hn::Mul(weight, sum(map[3 * j], x, map[3 * j + 1], y, map[3 * j + 2], z)), pulls[3 * k + j], i);
    }
  }
}

static void spread(const Plane* posed, const Plane* sides, const Plane* weights, Plane* m) {
  for (std::size_t i = 0; i < plane_size; i += width)
    for (std::size_t row = 0; row < 3; ++row) {
      V p[3];
      for (std::size_t k = 0; k < 3; ++k) p[k] = hn::Mul(at(weights[k], i), at(posed[3 * k + row], i));
      for (std::size_t j = 0; j < 3; ++j)
        put(sum(p[0], at(sides[j], i), p[1], at(sides[3 + j], i), p[2], at(sides[6 + j], i)), m[3 * row + j],
            i);
    }
}

using Vector = lanes::Three<V>;

static HWY_INLINE Vector sum(V a, const Vector& x, V b, const Vector& y, V c, const Vector& z) {
  return {lanes::sum_of_products(a, x.x, b, y.x, c, z.x), lanes::sum_of_products(a, x.y, b, y.y, c, z.y),
          lanes::sum_of_products(a, x.z, b, y.z, c, z.z)};
}

static HWY_INLINE void put(const Vector& u, const Vector& v, V (&six)[6]) {
  six[0] = u.x;
  six[1] = u.y;
  six[2] = u.z;
  six[3] = v.x;
  six[4] = v.y;
  six[5] = v.z;
}

static HWY_INLINE void put(const V (&six)[6], double* planes) {
  for (std::size_t n = 0; n < 6; ++n) hn::Store(six[n], Tag(), planes + n * plane_stride);
}

// Computes the columns j of the left Jacobian J of w (T. Barfoot, State Estimation for Robotics, 7.1.5):
//   J * v = v + p * (w x v) + q * (w x (w x v)),  p = (1 - cos a) / a^2,  q = (a - sin a) / a^3,  a = |w|
static HWY_INLINE void put_left_jacobian(const Vector& w, const lanes::HalfAngle<V>& half, Vector (&j)[3]) {
  const V one = hn::Set(Tag(), 1), sine = hn::Add(half.sine, half.sine);
  const V square = lanes::sum_of_products(w.x, w.x, w.y, w.y, w.z, w.z);
  const V p = hn::Mul(half.sine, sine);
  const V q = hn::IfThenElse(hn::Lt(square, hn::Set(Tag(), 1e-8)), hn::Set(Tag(), 1.0 / 6),
                             hn::Div(hn::NegMulAdd(sine, half.cosine, one), square));
  const V rest = hn::NegMulAdd(q, square, one), px = hn::Mul(p, w.x), py = hn::Mul(p, w.y),
          pz = hn::Mul(p, w.z), qx = hn::Mul(q, w.x), qy = hn::Mul(q, w.y);
  j[0] = {hn::MulAdd(qx, w.x, rest), hn::MulAdd(qx, w.y, pz), hn::MulSub(qx, w.z, py)};
  j[1] = {hn::MulSub(qx, w.y, pz), hn::MulAdd(qy, w.y, rest), hn::MulAdd(qy, w.z, px)};
  j[2] = {hn::MulAdd(qx, w.z, py), hn::MulSub(qy, w.z, px), hn::MulAdd(hn::Mul(q, w.z), w.z, rest)};
}

// Computes the derivatives of exp at `at` by each of the six entries.
static HWY_INLINE void put_slopes(const lanes::ExpPoint<Tag>& at, lanes::Six<V> (&slopes)[6]) {
  if (HWY_LIKELY(hn::AllTrue(Tag(), at.ok))) return lanes::put_exp_tangent(Tag(), at.parts, slopes);
  const V o = hn::Zero(Tag()), i = hn::Set(Tag(), 1);
  const lanes::Six<V> directions[6] = {{i, o, o, o, o, o}, {o, i, o, o, o, o}, {o, o, i, o, o, o},
                                       {o, o, o, i, o, o}, {o, o, o, o, i, o}, {o, o, o, o, o, i}};
  for (std::size_t k = 0; k < 6; ++k) slopes[k] = lanes::exp_derivative_general(Tag(), at, directions[k]);
}

// Computes `map`, the images of u and v under M = exp(Y) * exp(X), and `tangent`, their derivatives by the
// entries of `log`: dM = exp(Y) * dexp(X) + (J * dY) x M. `log` is X in the axes u, v, u x v, and then Y.
static HWY_INLINE void put_tangent(const V (&log)[9], const Vector& u, const Vector& v, V (&map)[6],
                                   V (&tangent)[9][6]) {
  const Vector y{log[6], log[7], log[8]};
  const auto half = lanes::half_angle_lanes(Tag(), y);
  const auto r = lanes::to_matrix(Tag(), lanes::half_angle_quaternion(half.cosine, half.sine, y));
  const Vector rx{r.xx, r.yx, r.zx}, ry{r.xy, r.yy, r.zy}, rz{r.xz, r.yz, r.zz};
  const Vector ru = sum(u.x, rx, u.y, ry, u.z, rz), rv = sum(v.x, rx, v.y, ry, v.z, rz),
               rn = lanes::cross(ru, rv);
  const auto at = lanes::exp_point(Tag(), lanes::Six<V>{log[0], log[1], log[2], log[3], log[4], log[5]});
  const lanes::Six<V> s = lanes::exp_value(Tag(), at);
  const Vector mu = sum(s.xx, ru, s.xy, rv, s.xz, rn), mv = sum(s.xy, ru, s.yy, rv, s.yz, rn);
  put(mu, mv, map);
  lanes::Six<V> d[6];
  put_slopes(at, d);
  for (std::size_t k = 0; k < 6; ++k)
    put(sum(d[k].xx, ru, d[k].xy, rv, d[k].xz, rn), sum(d[k].xy, ru, d[k].yy, rv, d[k].yz, rn), tangent[k]);
  Vector j[3];
  put_left_jacobian(y, half, j);
  for (std::size_t k = 0; k < 3; ++k) put(lanes::cross(j[k], mu), lanes::cross(j[k], mv), tangent[6 + k]);
}

static void derive(const double* group, const double* weights, std::size_t count, double* changes) {
  const std::size_t next = (6 + 9 * count) * group_size;
  for (std::size_t l = 0; l < group_size; l += width, group += width, changes += width) {
    const auto read = [=](std::size_t n) HWY_ATTR { return hn::Load(Tag(), group + n * group_size); };
    V log[9], map[6], tangent[9][6];
    for (V& x : log) x = hn::Zero(Tag());
    for (std::size_t e = 0; e < count; ++e)
      for (std::size_t k = 0; k < 9; ++k)
        log[k] = hn::MulAdd(hn::Set(Tag(), weights[e]), read(6 + 9 * e + k), log[k]);
    put_tangent(log, {read(0), read(1), read(2)}, {read(3), read(4), read(5)}, map, tangent);
    put(map, changes + 6 * plane_stride * count);
    for (std::size_t e = 0; e < count; ++e) {
      V change[6];
      for (V& x : change) x = hn::Zero(Tag());
      for (std::size_t k = 0; k < 9; ++k) {
        hwy::Prefetch(group + (6 + 9 * e + k) * group_size + next);
        const V x = read(6 + 9 * e + k);
        for (std::size_t n = 0; n < 6; ++n) change[n] = hn::MulAdd(x, tangent[k][n], change[n]);
      }
      put(change, changes + 6 * plane_stride * e);
    }
  }
}

template <std::size_t N>
static HWY_INLINE void add_products_of(const double* m, const double* columns, double* sums) {
  for (std::size_t l = 0; l < group_size; l += width) {
    V sum[N][3];
    for (std::size_t n = 0; n < N; ++n)
      for (std::size_t row = 0; row < 3; ++row)
        sum[n][row] = hn::Load(Tag(), sums + (3 * n + row) * group_size + l);
    for (std::size_t i = l; i < plane_size; i += group_size)
      for (std::size_t c = 0; c < 2; ++c) {
        const double* of = m + 3 * c * plane_stride + i;
        const V x = hn::Load(Tag(), of), y = hn::Load(Tag(), of + plane_stride),
                z = hn::Load(Tag(), of + 2 * plane_stride);
        for (std::size_t n = 0; n < N; ++n) {
          const V q = hn::Load(Tag(), columns + (2 * n + c) * plane_size + i);
          sum[n][0] = hn::MulAdd(x, q, sum[n][0]);
          sum[n][1] = hn::MulAdd(y, q, sum[n][1]);
          sum[n][2] = hn::MulAdd(z, q, sum[n][2]);
        }
      }
    for (std::size_t n = 0; n < N; ++n)
      for (std::size_t row = 0; row < 3; ++row)
        hn::Store(sum[n][row], Tag(), sums + (3 * n + row) * group_size + l);
  }
}

static void add_products(const double* maps, std::size_t count, const double* columns, std::size_t n,
                         double* sums) {
  for (std::size_t e = 0; e < count; ++e, maps += 6 * plane_stride) {
    std::size_t k = 0;
    for (; k + 4 <= n; k += 4, sums += 12 * group_size)
      add_products_of<4>(maps, columns + 2 * k * plane_size, sums);
    for (; k < n; ++k, sums += 3 * group_size) add_products_of<1>(maps, columns + 2 * k * plane_size, sums);
  }
}

static constexpr PlaneKernel planes{add_rows, times_symmetric, pull, spread, map, derive, add_products};

}  // namespace viete::shapes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace viete::shapes {

const PlaneKernel& plane_kernel(const sym3::Kernel& kernel) {
  VIETE_RETURN_COMPILED(planes, kernel.highway_target);
}

}  // namespace viete::shapes
#endif
