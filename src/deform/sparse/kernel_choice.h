// What each instruction set compiled, by its Highway target. Internal; no inline functions here (see
// sym3/fallback.h).
#pragma once

#include "sym3/highway_targets.h"

// Not where another one is what all machines have.
#if HWY_TARGETS & HWY_SCALAR
#define VIETE_CHOOSE_SCALAR(name) &N_SCALAR::name
#else
#define VIETE_CHOOSE_SCALAR(name) nullptr
#endif

// Use after Highway's foreach_target: returns the object `name` of the namespace of `target`.
#define VIETE_RETURN_COMPILED(name, target)               \
  return *((target) == HWY_AVX3   ? HWY_CHOOSE_AVX3(name) \
           : (target) == HWY_AVX2 ? HWY_CHOOSE_AVX2(name) \
           : (target) == HWY_SSE4 ? HWY_CHOOSE_SSE4(name) \
           : (target) == HWY_NEON ? HWY_CHOOSE_NEON(name) \
                                  : VIETE_CHOOSE_SCALAR(name))
