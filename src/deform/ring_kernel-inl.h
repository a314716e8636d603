// Normals by a walk around each vertex, in vector registers: included by frame_kernel.cpp for each instruction
// set. Internal. (No #pragma once: see sym3/exp-inl.h.)
#if defined(VIETE_DEFORM_RING_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_DEFORM_RING_KERNEL_INL_H
#undef VIETE_DEFORM_RING_KERNEL_INL_H
#else
#define VIETE_DEFORM_RING_KERNEL_INL_H
#endif


#include "deform/frame_kernel.h"
#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float smallest = 1e-36f, largest = 1e36f;  // squared areas outside count as none
constexpr std::size_t leaf_block = 16;               // leaves are filled to multiples of it

// A point as four lanes x y z x: turned by one lane to the left they are y z x y, as a cross product wants them.
#if HWY_TARGET == HWY_SCALAR

struct Four {
  float x, y, z, w;
};
static HWY_INLINE Four load_four(const float* p) {
  return {p[0], p[1], p[2], p[3]};
}
static HWY_INLINE void store_four(const Four& a, float* p) {
  p[0] = a.x, p[1] = a.y, p[2] = a.z, p[3] = a.w;
}
static HWY_INLINE Four minus(const Four& a, const Four& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
}
static HWY_INLINE Four turned(const Four& a) {
  return {a.y, a.z, a.w, a.x};
}
static HWY_INLINE Four add_product(const Four& a, const Four& b, const Four& c) {
  return {a.x * b.x + c.x, a.y * b.y + c.y, a.z * b.z + c.z, a.w * b.w + c.w};
}
static HWY_INLINE Four times(const Four& a, const Four& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w};
}
static HWY_INLINE Four four_of(float a) {
  return {a, a, a, a};
}

#else

using FourTag = hn::FixedTag<float, 4>;
using Four = hn::Vec<FourTag>;
static HWY_INLINE Four load_four(const float* p) {
  return hn::Load(FourTag(), p);
}
static HWY_INLINE void store_four(Four a, float* p) {
  hn::Store(a, FourTag(), p);
}
static HWY_INLINE Four minus(Four a, Four b) {
  return hn::Sub(a, b);
}
static HWY_INLINE Four turned(Four a) {
  return hn::Shuffle0321(a);
}
static HWY_INLINE Four add_product(Four a, Four b, Four c) {
  return hn::MulAdd(a, b, c);
}
static HWY_INLINE Four times(Four a, Four b) {
  return hn::Mul(a, b);
}
static HWY_INLINE Four four_of(float a) {
  return hn::Set(FourTag(), a);
}

#endif

// A neighbour relative to the vertex, both ways round.
struct Spoke {
  Four plain, turned_left;
};

static HWY_INLINE Spoke spoke(const float* positions, std::size_t place, Four self) {
  const Four plain = minus(self, load_four(positions + 4 * place));
  return {plain, turned(plain)};
}

// Two chains of sums, so that the second need not wait for the first.
struct Area {
  Four plus, minus_part;
};

static HWY_INLINE void add_triangle(const Spoke& from, const Spoke& to, Area& area) {
  area.plus = add_product(from.plain, to.turned_left, area.plus);
  area.minus_part = add_product(from.turned_left, to.plain, area.minus_part);
}

// Twice the area vector around `self`, its lanes z x y 0. Unrolled for the usual lengths of a walk.
template <int length>
static HWY_INLINE Four area_around(const float* positions, const std::uint16_t* walk, Four self) {
  Area area{minus(self, self), minus(self, self)};
  Spoke from = spoke(positions, walk[0], self);
#pragma GCC unroll 16
  for (int i = 1; i < length; ++i) {
    const Spoke to = spoke(positions, walk[i], self);
    add_triangle(from, to, area);
    from = to;
  }
  return minus(area.plus, area.minus_part);
}

template <class Place>
static HWY_INLINE Four area_around(const float* positions, const Place* walk, std::size_t length, Four self) {
  Area area{minus(self, self), minus(self, self)};
  if (length == 0) return area.plus;
  Spoke from = spoke(positions, walk[0], self);
  for (std::size_t i = 1; i < length; ++i) {
    const Spoke to = spoke(positions, walk[i], self);
    add_triangle(from, to, area);
    from = to;
  }
  return minus(area.plus, area.minus_part);
}

static HWY_INLINE void areas(const RingRun& run, const FrameVertex* vertices, float* HWY_RESTRICT out) {
  const float* positions = run.positions + 4 * run.first;
  const std::uint16_t* walk = run.walk;
  for (std::size_t s = 0; s < run.slots; ++s, out += 4) {
    const std::size_t length = run.lengths[s];
    hwy::Prefetch(vertices + run.order[s]);  // written when all areas are known
    const Four self = load_four(positions + 4 * s);
    Four area;
    switch (length) {
      case 5: area = area_around<5>(positions, walk, self); break;
      case 6: area = area_around<6>(positions, walk, self); break;
      case 7: area = area_around<7>(positions, walk, self); break;
      case 8: area = area_around<8>(positions, walk, self); break;
      default: area = area_around(positions, walk, length, self);
    }
    store_four(area, out);
    walk += length;
  }
}

static HWY_INLINE void fill_halo(const RingRun& run) {
  float* out = run.positions + 4 * (run.first + run.slots);
  for (std::size_t i = 0; i < run.places - run.slots; ++i) {
    store_four(load_four(run.positions + 4 * std::size_t(run.halo[i])), out + 4 * i);
  }
}

// z x y 0 to unit x y z 0.
static HWY_INLINE void normalise(float* normals, std::size_t count) {
#if HWY_TARGET == HWY_SCALAR
  for (float* n = normals; n != normals + 4 * count; n += 4) {
    const float squared = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    const bool has_area = squared > smallest && squared < largest;
    const float scale = has_area ? 1 / __builtin_sqrtf(squared) : 0.0f;
    const float z = has_area ? scale * n[0] : 1.0f;
    n[0] = scale * n[1], n[1] = scale * n[2], n[2] = z, n[3] = 0;
  }
#else
  const hn::CappedTag<float, leaf_block> d;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    hn::Vec<decltype(d)> x, y, z, w;
    hn::LoadInterleaved4(d, normals + 4 * i, z, x, y, w);
    const auto squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    const auto has_area = hn::And(hn::Gt(squared, hn::Set(d, smallest)), hn::Lt(squared, hn::Set(d, largest)));
    const auto scale = hn::IfThenElseZero(has_area, hn::Div(one, hn::Sqrt(squared)));
    hn::StoreInterleaved4(hn::Mul(x, scale), hn::Mul(y, scale), hn::IfThenElse(has_area, hn::Mul(z, scale), one),
                          zero, d, normals + 4 * i);
  }
#endif
}

static void ring_vertices(const RingRun& run, FrameVertex* vertices) {
  HWY_ALIGN float normals[4 * leaf_slots];
  fill_halo(run);
  areas(run, vertices, normals);
  normalise(normals, run.slots);
  const Four unit = four_of(run.unit);
  const float* positions = run.positions + 4 * run.first;
  for (std::size_t s = 0; s < run.vertices; ++s) {
    FrameVertex& out = vertices[run.order[s]];
    store_four(times(unit, load_four(positions + 4 * s)), out.position);
    store_four(load_four(normals + 4 * s), out.normal);
  }
}

static void ring_hub(const float* positions, const std::uint32_t* walk, std::size_t length, std::uint32_t place,
             FrameVertex& vertex) {
  HWY_ALIGN float normals[4 * leaf_block] = {};
  store_four(area_around(positions, walk, length, load_four(positions + 4 * std::size_t(place))), normals);
  normalise(normals, leaf_block);
  store_four(load_four(normals), vertex.normal);
}

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
