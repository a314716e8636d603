// Products of small matrices, compiled once per instruction set.
#include "deform/plane_kernel.h"

#include "deform/sparse/kernel_choice.h"
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "deform/plane_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Sums of eight triangles each, whatever the width of the registers, so that all machines add in one order.
constexpr std::size_t summed_apart = 8;
using Tag = hn::CappedTag<double, summed_apart>;
using V = hn::Vec<Tag>;
constexpr std::size_t width = hn::MaxLanes(Tag());

static HWY_INLINE V at(const Plane& plane, std::size_t i) {
  return hn::Load(Tag(), plane + i);
}
static HWY_INLINE void put(V v, Plane& plane, std::size_t i) {
  hn::Store(v, Tag(), plane + i);
}

// a x + b y + c z, rounded as it is written.
static HWY_INLINE V sum(V a, V x, V b, V y, V c, V z) {
  return hn::Add(hn::Add(hn::Mul(a, x), hn::Mul(b, y)), hn::Mul(c, z));
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

static void turn(const double* r, Plane* m) {
  for (std::size_t i = 0; i < plane_size; i += width) {
    for (std::size_t k = 0; k < 3; ++k) {
      const V x = at(m[k], i), y = at(m[3 + k], i), z = at(m[6 + k], i);
      for (std::size_t j = 0; j < 9; j += 3)
        put(sum(hn::Set(Tag(), r[j]), x, hn::Set(Tag(), r[j + 1]), y, hn::Set(Tag(), r[j + 2]), z), m[j + k],
            i);
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
  for (std::size_t i = 0; i < plane_size; i += width) {
    for (std::size_t row = 0; row < 3; ++row) {
      V p[3];
      for (std::size_t k = 0; k < 3; ++k) p[k] = hn::Mul(at(weights[k], i), at(posed[3 * k + row], i));
      for (std::size_t j = 0; j < 3; ++j)
        put(sum(p[0], at(sides[j], i), p[1], at(sides[3 + j], i), p[2], at(sides[6 + j], i)), m[3 * row + j],
            i);
    }
  }
}

static void add_turning(const Plane* y, const Plane* v, const Plane* ab, const Plane* m, Plane* changed) {
  for (std::size_t i = 0; i < plane_size; i += width) {
    const V y0 = at(y[0], i), y1 = at(y[1], i), y2 = at(y[2], i), v0 = at(v[0], i), v1 = at(v[1], i),
            v2 = at(v[2], i), a = at(ab[0], i), b = at(ab[1], i);
    const V p = hn::NegMulAdd(y2, v1, hn::Mul(y1, v2)), q = hn::NegMulAdd(y0, v2, hn::Mul(y2, v0)),
            r = hn::NegMulAdd(y1, v0, hn::Mul(y0, v1));
    const V t0 = hn::MulAdd(b, hn::NegMulAdd(y2, q, hn::Mul(y1, r)), hn::MulAdd(a, p, v0));
    const V t1 = hn::MulAdd(b, hn::NegMulAdd(y0, r, hn::Mul(y2, p)), hn::MulAdd(a, q, v1));
    const V t2 = hn::MulAdd(b, hn::NegMulAdd(y1, p, hn::Mul(y0, q)), hn::MulAdd(a, r, v2));
    for (std::size_t k = 0; k < 3; ++k) {
      const V m0 = at(m[k], i), m1 = at(m[3 + k], i), m2 = at(m[6 + k], i);
      put(hn::NegMulAdd(t2, m1, hn::MulAdd(t1, m2, at(changed[k], i))), changed[k], i);
      put(hn::NegMulAdd(t0, m2, hn::MulAdd(t2, m0, at(changed[3 + k], i))), changed[3 + k], i);
      put(hn::NegMulAdd(t1, m0, hn::MulAdd(t0, m1, at(changed[6 + k], i))), changed[6 + k], i);
    }
  }
}

static void add_products(const Plane* m, const double* q, std::size_t count, double* sums) {
  constexpr std::size_t vectors = summed_apart / width;
  for (std::size_t n = 0; n < count; ++n, q += 3 * plane_size, sums += 3) {
    V lanes[3][vectors];
    for (auto& row : lanes)
      for (V& lane : row) lane = hn::Zero(Tag());
    for (std::size_t i = 0; i < plane_size; i += summed_apart) {
      for (std::size_t l = 0; l < vectors; ++l) {
        const std::size_t j = i + l * width;
        const V x = hn::LoadU(Tag(), q + j), y = hn::LoadU(Tag(), q + plane_size + j),
                z = hn::LoadU(Tag(), q + 2 * plane_size + j);
        for (std::size_t row = 0; row < 3; ++row) {
          const V xy = hn::MulAdd(at(m[3 * row + 1], j), y, hn::MulAdd(at(m[3 * row], j), x, lanes[row][l]));
          lanes[row][l] = hn::MulAdd(at(m[3 * row + 2], j), z, xy);
        }
      }
    }
    for (std::size_t row = 0; row < 3; ++row) {
      alignas(64) double apart[summed_apart];
      for (std::size_t l = 0; l < vectors; ++l) hn::Store(lanes[row][l], Tag(), apart + l * width);
      for (const double x : apart) sums[row] += x;
    }
  }
}

static constexpr PlaneKernel planes{times_symmetric, turn, pull, spread, add_turning, add_products};

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace viete::deform {

const PlaneKernel& plane_kernel(const sym3::Kernel& kernel) {
  VIETE_RETURN_COMPILED(planes, kernel.highway_target);
}

}  // namespace viete::deform
#endif
