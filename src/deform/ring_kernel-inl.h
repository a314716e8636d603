// Normals from the triangles around each vertex, in vector registers. frame_kernel.cpp includes this file
// once per instruction set. (No #pragma once: see sym3/exp-inl.h.)
#if defined(VIETE_DEFORM_RING_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VIETE_DEFORM_RING_KERNEL_INL_H
#undef VIETE_DEFORM_RING_KERNEL_INL_H
#else
#define VIETE_DEFORM_RING_KERNEL_INL_H
#endif

#include <cstring>

#include "deform/frame_jobs.h"
#include "sym3/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace viete::deform::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float smallest = 1e-18f, largest = 1e18f;  // areas outside this range count as 0

// A block of four lanes contains one point as x y z x. Cross products need y z x: the block rotated left by
// one lane. A register contains as many blocks as fit.
#if HWY_TARGET == HWY_SCALAR

struct OnePoint {};
using ManyPoints = OnePoint;
struct Points {
  float x, y, z, w;
};
constexpr std::size_t points(OnePoint) {
  return 1;
}
static HWY_INLINE Points load(OnePoint, const float* p) {
  return {p[0], p[1], p[2], p[3]};
}
template <std::size_t floats, class Index>
static HWY_INLINE Points gather(OnePoint d, const float* positions, const Index* neighbours) {
  return load(d, positions + floats * *neighbours);
}
static HWY_INLINE void store(OnePoint, const Points& a, float* p) {
  p[0] = a.x;
  p[1] = a.y;
  p[2] = a.z;
  p[3] = a.w;
}
static HWY_INLINE Points zero(OnePoint) {
  return {0, 0, 0, 0};
}
static HWY_INLINE Points minus(const Points& a, const Points& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
}
static HWY_INLINE Points turned(const Points& a) {
  return {a.y, a.z, a.w, a.x};
}
static HWY_INLINE Points add_product(const Points& a, const Points& b, const Points& c) {
  return {a.x * b.x + c.x, a.y * b.y + c.y, a.z * b.z + c.z, a.w * b.w + c.w};
}
static HWY_INLINE Points scaled(OnePoint, const Points& a, float s) {
  return {a.x * s, a.y * s, a.z * s, a.w * s};
}

// Stores vertices. The absolute values of each normal must sum to 1, see base::pack_normal().
static HWY_INLINE void store_vertices(OnePoint, const Points& position, const Points& normal,
                                      const std::uint32_t* order, pose::FrameVertex* vertices) {
  const float fold = normal.z < 0 ? -normal.z : 0;
  const auto packed = [&](float x) {
    return static_cast<std::int16_t>(__builtin_rintf(32767 * (x + __builtin_copysignf(fold, x))));
  };
  vertices[*order] = {{position.x, position.y, position.z}, {packed(normal.x), packed(normal.y)}};
}

// Returns 1 / (|x| + |y| + |z|) for each of 4 area vectors with lanes z x y 0, or 0 if its area is 0.
static HWY_INLINE Points inverse_sums(OnePoint, const Points (&areas)[4]) {
  float inverse[4];
  for (int k = 0; k < 4; ++k) {
    const Points& a = areas[k];
    const float sum = __builtin_fabsf(a.x) + __builtin_fabsf(a.z) + __builtin_fabsf(a.y);
    inverse[k] = sum > smallest && sum < largest ? 1 / sum : 0.0f;
  }
  return {inverse[0], inverse[1], inverse[2], inverse[3]};
}

// Normalises vectors, and reorders their lanes from z x y 0 to x y z 0. If inverse_sum is 0, writes 0 0 1 0.
static HWY_INLINE void normalise(OnePoint, const Points& inverse_sum, Points (&areas)[4]) {
  const float scale[4] = {inverse_sum.x, inverse_sum.y, inverse_sum.z, inverse_sum.w};
  for (int k = 0; k < 4; ++k) {
    const Points a = areas[k];
    areas[k] = scale[k] == 0 ? Points{0, 0, 1, 0} : Points{a.y * scale[k], a.z * scale[k], a.x * scale[k], 0};
  }
}

#else

using OnePoint = hn::FixedTag<float, 4>;
using ManyPoints = hn::CappedTag<float, 4 * weights::ring_group>;

template <class D>
constexpr std::size_t points(D) {
  return hn::MaxLanes(D()) / 4;
}
template <class D>
static HWY_INLINE hn::Vec<D> load(D d, const float* p) {
  return hn::Load(d, p);
}
// Loads neighbour k into block k. Each load also fills the later blocks, which later loads replace.
template <std::size_t floats, class D, class Index>
static HWY_INLINE hn::Vec<D> gather(D d, const float* positions, const Index* neighbours) {
  auto all = hn::LoadDup128(d, positions + floats * neighbours[0]);
  for (std::size_t k = 1; k < points(d); ++k) {
    const auto from_here_on = hn::Not(hn::FirstN(d, 4 * k));
    all = hn::IfThenElse(from_here_on, hn::LoadDup128(d, positions + floats * neighbours[k]), all);
  }
  return all;
}
template <class D>
static HWY_INLINE void store(D d, hn::Vec<D> a, float* p) {
  hn::Store(a, d, p);
}
template <class D>
static HWY_INLINE hn::Vec<D> zero(D d) {
  return hn::Zero(d);
}
template <class V>
static HWY_INLINE V minus(V a, V b) {
  return hn::Sub(a, b);
}
template <class V>
static HWY_INLINE V turned(V a) {
  return hn::Shuffle0321(a);
}
template <class V>
static HWY_INLINE V add_product(V a, V b, V c) {
  return hn::MulAdd(a, b, c);
}
template <class D>
static HWY_INLINE hn::Vec<D> scaled(D d, hn::Vec<D> a, float s) {
  return hn::Mul(a, hn::Set(d, s));
}

template <class D, class V = hn::Vec<D> >
static HWY_INLINE void store_blocks(D d, const V& blocks, const std::uint32_t* order,
                                    pose::FrameVertex* vertices) {
  if constexpr (points(d) == 1) {
    hn::Store(blocks, d, vertices[*order].position);  // also stores the normal, which is the last lane
  } else {
    const hn::Half<D> half;
    store_blocks(half, hn::LowerHalf(half, blocks), order, vertices);
    store_blocks(half, hn::UpperHalf(half, blocks), order + points(half), vertices);
  }
}

// Stores vertices. The absolute values of each normal must sum to 1, see base::pack_normal().
template <class D, class V = hn::Vec<D> >
static HWY_INLINE void store_vertices(D d, const V& positions, const V& normals, const std::uint32_t* order,
                                      pose::FrameVertex* vertices) {
  HWY_ALIGN static constexpr std::int32_t last[] = {0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1};
  const hn::RebindToSigned<D> whole;
  const V fold = hn::Max(hn::Neg(hn::Broadcast<2>(normals)), hn::Zero(d));
  const V folded = hn::Add(normals, hn::CopySign(fold, normals));
  const auto rounded = hn::NearestInt(hn::Mul(folded, hn::Set(d, 32767.0f)));
  const auto packed = hn::Or(hn::And(hn::Broadcast<0>(rounded), hn::Set(whole, 0xffff)),
                             hn::ShiftLeft<16>(hn::Broadcast<1>(rounded)));
  const auto is_last = hn::MaskFromVec(hn::BitCast(d, hn::Load(whole, last)));
  store_blocks(d, hn::IfThenElse(is_last, hn::BitCast(d, packed), positions), order, vertices);
}

// Lane k of block b of the result is the sum of the four lanes of block b of s[k].
template <class D, class V = hn::Vec<D> >
static HWY_INLINE V block_sums(D d, const V (&s)[4]) {
  const hn::RepartitionToWide<D> pairs;
  const V a = hn::Add(hn::InterleaveLower(d, s[0], s[1]), hn::InterleaveUpper(d, s[0], s[1]));
  const V b = hn::Add(hn::InterleaveLower(d, s[2], s[3]), hn::InterleaveUpper(d, s[2], s[3]));
  const auto first = hn::InterleaveLower(pairs, hn::BitCast(pairs, a), hn::BitCast(pairs, b));
  const auto second = hn::InterleaveUpper(pairs, hn::BitCast(pairs, a), hn::BitCast(pairs, b));
  return hn::Add(hn::BitCast(d, first), hn::BitCast(d, second));
}

template <int k, class D, class V = hn::Vec<D> >
static HWY_INLINE void scale_one(D d, V scale, bool all_have_area, V& area) {
  HWY_ALIGN static constexpr std::int32_t z_last[] = {1, 2, 0, 3, 5, 6, 4, 7, 9, 10, 8, 11, 13, 14, 12, 15};
  HWY_ALIGN static constexpr float up[] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  const V factor = hn::Broadcast<k>(scale);
  area = hn::TableLookupLanes(hn::Mul(area, factor), hn::SetTableIndices(d, z_last));
  if (HWY_LIKELY(all_have_area)) return;
  area = hn::IfThenElse(hn::Eq(factor, hn::Zero(d)), hn::Load(d, up), area);
}

// Returns 1 / (|x| + |y| + |z|) of vectors z x y 0, or 0 if the area is 0. Lane k of a block is for areas[k].
template <class D, class V = hn::Vec<D> >
static HWY_INLINE V inverse_sums(D d, const V (&areas)[4]) {
  const V sums = block_sums(d, {hn::Abs(areas[0]), hn::Abs(areas[1]), hn::Abs(areas[2]), hn::Abs(areas[3])});
  const auto has_area = hn::And(hn::Gt(sums, hn::Set(d, smallest)), hn::Lt(sums, hn::Set(d, largest)));
  return hn::IfThenElseZero(has_area, hn::Div(hn::Set(d, 1.0f), sums));
}

// Normalises vectors, and reorders their lanes from z x y 0 to x y z 0. If inverse_sum is 0, writes 0 0 1 0.
template <class D, class V = hn::Vec<D> >
static HWY_INLINE void normalise(D d, V inverse_sum, V (&areas)[4]) {
  const bool all_have_area = hn::AllFalse(d, hn::Eq(inverse_sum, hn::Zero(d)));
  scale_one<0>(d, inverse_sum, all_have_area, areas[0]);
  scale_one<1>(d, inverse_sum, all_have_area, areas[1]);
  scale_one<2>(d, inverse_sum, all_have_area, areas[2]);
  scale_one<3>(d, inverse_sum, all_have_area, areas[3]);
}

#endif

// A sum of cross products with lanes z x y 0. Two separate sums hide latency.
template <class V>
struct Areas {
  V plus, minus_part;

  HWY_INLINE void add_cross(const V& a, const V& b) {
    plus = add_product(a, turned(b), plus);
    minus_part = add_product(turned(a), b, minus_part);
  }
};

// Returns twice the sum of the area vectors of the triangles around `self`. Two consecutive triangles form a
// quadrilateral. The cross product of its diagonals is twice its area vector, so half as many products
// suffice. Neighbour i is at positions + floats * neighbours[i * stride]. Open rings must have odd lengths.
template <bool closed, std::size_t stride, std::size_t floats, class D, class V, class Index>
static HWY_INLINE V areas_around(D d, const float* positions, const Index* neighbours, std::size_t length,
                                 const V& self) {
  Areas<V> areas{zero(d), zero(d)};
  if (length == 0) return areas.plus;
  const V first = gather<floats>(d, positions, neighbours);
  V last = first;
#pragma GCC unroll 8
  for (std::size_t i = 1; i + 1 < length; i += 2) {
    const V middle = gather<floats>(d, positions, neighbours + i * stride);
    const V next = gather<floats>(d, positions, neighbours + (i + 1) * stride);
    areas.add_cross(minus(middle, self), minus(next, last));
    last = next;
  }
  if (closed && length % 2 == 0) {
    const V middle = gather<floats>(d, positions, neighbours + (length - 1) * stride);
    areas.add_cross(minus(middle, self), minus(first, last));
  } else if (closed) {
    areas.add_cross(minus(first, self), minus(self, last));
  }
  return minus(areas.plus, areas.minus_part);
}

// Makes common lengths compile-time constants, so that the compiler unrolls the loops.
template <class D, class V>
static HWY_INLINE V areas_of_group(D d, const float* positions, const std::uint16_t* neighbours,
                                   std::size_t length, const V& self) {
  constexpr std::size_t stride = weights::ring_group, floats = weights::index_floats;
  switch (length) {
    case weights::closed_ring + 4:
      return areas_around<true, stride, floats>(d, positions, neighbours, 4, self);
    case weights::closed_ring + 5:
      return areas_around<true, stride, floats>(d, positions, neighbours, 5, self);
    case weights::closed_ring + 6:
      return areas_around<true, stride, floats>(d, positions, neighbours, 6, self);
    case weights::closed_ring + 7:
      return areas_around<true, stride, floats>(d, positions, neighbours, 7, self);
    case weights::closed_ring + 8:
      return areas_around<true, stride, floats>(d, positions, neighbours, 8, self);
    default: break;
  }
  if (length < weights::closed_ring)
    return areas_around<false, stride, floats>(d, positions, neighbours, length, self);
  return areas_around<true, stride, floats>(d, positions, neighbours, length - weights::closed_ring, self);
}

// Returns the area vectors of the slots in the register at slot s. Advances `neighbours` after each group.
template <class D>
static HWY_INLINE auto next_areas(D d, const RingRun& run, std::size_t s, const std::uint16_t*& neighbours) {
  const float* positions = run.positions + 4 * run.first;
  const std::size_t length = run.lengths[s / weights::ring_group];
  const auto areas =
      areas_of_group(d, positions, neighbours + s % weights::ring_group, length, load(d, positions + 4 * s));
  if ((s + points(d)) % weights::ring_group == 0)
    neighbours += weights::ring_group * (length % weights::closed_ring);
  return areas;
}

// Copies ghosts from other leaves, and prefetches later ghosts. Returns false if no slot or ghost has moved.
static HWY_INLINE bool copy_ghosts(const RingRun& run) {
  constexpr std::size_t ahead = 128;
  const OnePoint d;
  float* out = run.positions + 4 * (run.first + run.slots);
  const std::size_t count = run.count - run.slots;
  if (!run.moved) {
    std::size_t i = 0;
    while (i < count &&
           std::memcmp(run.positions + 4 * std::size_t(run.ghosts[i]), out + 4 * i, 4 * sizeof(float)) == 0)
      ++i;
    if (i == count) return false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (i + ahead < run.ghosts_left) hwy::Prefetch(run.positions + 4 * std::size_t(run.ghosts[i + ahead]));
    store(d, load(d, run.positions + 4 * std::size_t(run.ghosts[i])), out + 4 * i);
  }
  return true;
}

template <class D>
static HWY_INLINE void load_four(D d, const float* from, decltype(zero(D())) (&out)[4]) {
#pragma GCC unroll 4
  for (std::size_t k = 0; k < 4; ++k) out[k] = load(d, from + 4 * k * points(d));
}

// Stores the slots of 4 registers to vertices[order[0]], vertices[order[1]] and so on. The first slot is s.
static HWY_INLINE void store_registers(const RingRun& run, std::size_t s, const float* areas,
                                       const float* inverse_sum, const std::uint32_t* order,
                                       pose::FrameVertex* vertices) {
  const ManyPoints d;
  decltype(zero(d)) normals[4], positions[4];
  load_four(d, areas, normals);
  load_four(d, run.positions + 4 * (run.first + s), positions);
  normalise(d, load(d, inverse_sum), normals);
#pragma GCC unroll 4
  for (std::size_t k = 0; k < 4; ++k)
    store_vertices(d, scaled(d, positions[k], run.unit), normals[k], order + k * points(d), vertices);
}

constexpr std::size_t ring_block = 128;  // slots; a leaf has a multiple of 32 slots

// Computes up to ring_block slots from `begin` on. Runs each step for all slots, to hide latency.
static HWY_INLINE void ring_slots(const RingRun& run, std::size_t begin, const std::uint16_t*& neighbours,
                                  pose::FrameVertex* HWY_RESTRICT vertices) {
  const ManyPoints d;
  constexpr std::size_t at_once = 4 * points(d);
  const std::size_t slots = std::min(ring_block, run.slots - begin);
  const std::size_t filled = std::min(slots, run.vertices - begin);
  const std::uint32_t* order = run.order + begin;
  HWY_ALIGN float areas[4 * ring_block], inverse[ring_block];
  for (std::size_t i = 0; i < slots; i += points(d)) {
    for (std::size_t k = 0; k < points(d); ++k) hwy::Prefetch(vertices + order[i + k]);
    store(d, next_areas(d, run, begin + i, neighbours), areas + 4 * i);
  }
  for (std::size_t i = 0; i < slots; i += at_once) {
    decltype(zero(d)) four[4];
    load_four(d, areas + 4 * i, four);
    store(d, inverse_sums(d, four), inverse + i);
  }
  std::size_t i = 0;
  for (; i + at_once <= filled; i += at_once)
    store_registers(run, begin + i, areas + 4 * i, inverse + i, order + i, vertices);
  if (i == filled) return;
  static constexpr std::uint32_t in_a_row[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  pose::FrameVertex last[at_once];
  store_registers(run, begin + i, areas + 4 * i, inverse + i, in_a_row, last);
  for (std::size_t k = 0; i + k < filled; ++k) vertices[order[i + k]] = last[k];
}

static void ring_vertices(const RingRun& leaf, pose::FrameVertex* HWY_RESTRICT vertices) {
  const RingRun run = leaf;  // a local copy that cannot alias the vertices
  if (!copy_ghosts(run)) return;
  const std::uint16_t* neighbours = run.neighbours;
  for (std::size_t begin = 0; begin < run.vertices; begin += ring_block)
    ring_slots(run, begin, neighbours, vertices);
}

static void ring_high_valence(const float* positions, const std::uint32_t* neighbours, std::size_t length,
                              std::uint32_t position, pose::FrameVertex& vertex) {
  const OnePoint d;
  const auto self = load(d, positions + 4 * std::size_t(position));
  decltype(zero(d)) areas[4] = {areas_around<false, 1, 4>(d, positions, neighbours, length, self), zero(d),
                                zero(d), zero(d)};
  normalise(d, inverse_sums(d, areas), areas);
  const std::uint32_t only = 0;
  store_vertices(d, load(d, vertex.position), areas[0], &only, &vertex);
}

}  // namespace viete::deform::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
