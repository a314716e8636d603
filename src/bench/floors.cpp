#include "bench/floors.h"

#include "deform/sparse/sparse_kernel.h"
#include "sym3/highway_targets.h"
#define HWY_TARGET_INCLUDE "bench/floors.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace viete::bench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using V = hn::Vec<Tag>;

#if HWY_TARGET <= HWY_AVX3
constexpr std::size_t chains = 24;
#else
constexpr std::size_t chains = 12;
#endif

static float read_all(const float* data, std::size_t count) {
  const Tag d;
  V a = hn::Zero(d), b = a, c = a, e = a;
  const std::size_t step = hn::Lanes(d);
  for (std::size_t i = 0; i < count; i += 4 * step) {
    a = hn::Max(a, hn::Load(d, data + i));
    b = hn::Max(b, hn::Load(d, data + i + step));
    c = hn::Max(c, hn::Load(d, data + i + 2 * step));
    e = hn::Max(e, hn::Load(d, data + i + 3 * step));
  }
  return hn::GetLane(hn::MaxOfLanes(d, hn::Max(hn::Max(a, b), hn::Max(c, e))));
}

static float multiply_add(std::size_t count) {
  const Tag d;
  const V w = hn::Set(d, 0.999f), t = hn::Set(d, 0.5f);
  V s[chains];
  for (std::size_t i = 0; i < chains; ++i) s[i] = hn::Set(d, static_cast<float>(i));
  for (std::size_t n = 0; n < count; n += chains * hn::Lanes(d)) {
#pragma GCC unroll 24
    for (std::size_t i = 0; i < chains; ++i) s[i] = hn::MulAdd(s[i], w, t);
  }
  for (std::size_t i = 1; i < chains; ++i) s[0] = hn::Add(s[0], s[i]);
  return hn::GetLane(s[0]);
}

}  // namespace viete::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace viete::bench {

float run_read_floor(const float* data, std::size_t count, const sym3::Kernel& kernel) {
  const auto compiled = [&]() -> float (*)(const float*, std::size_t) {
    VIETE_RETURN_COMPILED(read_all, kernel.highway_target);
  };
  return compiled()(data, count);
}

float run_multiply_add_floor(std::size_t count, const sym3::Kernel& kernel) {
  const auto compiled = [&]() -> float (*)(std::size_t) {
    VIETE_RETURN_COMPILED(multiply_add, kernel.highway_target);
  };
  return compiled()(count);
}

}  // namespace viete::bench
#endif
