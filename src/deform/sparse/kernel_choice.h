// What each instruction set compiled, by its Highway target. Internal; no inline functions here (see
// sym3/fallback.h).
#pragma once

#include "sym3/highway_targets.h"

// Use after Highway's foreach_target: returns the object `name` of the namespace of `target`.
#define VIETE_RETURN_COMPILED(name, target) \
  VIETE_RETURN_AVX3(name, target)           \
  VIETE_RETURN_AVX2(name, target)           \
  VIETE_RETURN_SSE4(name, target)           \
  VIETE_RETURN_NEON(name, target)           \
  return N_SCALAR::name

#if HWY_TARGETS & HWY_AVX3
#define VIETE_RETURN_AVX3(name, target) \
  if ((target) == HWY_AVX3) return N_AVX3::name;
#else
#define VIETE_RETURN_AVX3(name, target)
#endif
#if HWY_TARGETS & HWY_AVX2
#define VIETE_RETURN_AVX2(name, target) \
  if ((target) == HWY_AVX2) return N_AVX2::name;
#else
#define VIETE_RETURN_AVX2(name, target)
#endif
#if HWY_TARGETS & HWY_SSE4
#define VIETE_RETURN_SSE4(name, target) \
  if ((target) == HWY_SSE4) return N_SSE4::name;
#else
#define VIETE_RETURN_SSE4(name, target)
#endif
#if HWY_TARGETS & HWY_NEON
#define VIETE_RETURN_NEON(name, target) \
  if ((target) == HWY_NEON) return N_NEON::name;
#else
#define VIETE_RETURN_NEON(name, target)
#endif
