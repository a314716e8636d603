// Selects the instruction sets of the kernels. Include this header before all headers of Highway. Internal.
#pragma once

// With this macro, "scalar" is the fallback with every compiler. The code below disables SSE, AVX-512
// variants that are not faster than AVX3, and vectors without a fixed size (SVE).
#define HWY_BROKEN_EMU128 1
#include <hwy/detect_targets.h>

#ifdef HWY_AVX3_ZEN4
#define VIETE_HWY_AVX3_ZEN4 HWY_AVX3_ZEN4
#else
#define VIETE_HWY_AVX3_ZEN4 0
#endif
#ifdef HWY_AVX3_SPR
#define VIETE_HWY_AVX3_SPR HWY_AVX3_SPR
#else
#define VIETE_HWY_AVX3_SPR 0
#endif
#ifdef HWY_SSE2
#define VIETE_HWY_SSE2 HWY_SSE2
#else
#define VIETE_HWY_SSE2 0
#endif
// The instruction sets that the build option VIETE_KERNELS excludes.
#ifndef VIETE_KERNELS_LEFT_OUT
#define VIETE_KERNELS_LEFT_OUT 0
#endif
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS                                                                        \
  (HWY_SSSE3 | HWY_SSE4 | VIETE_HWY_SSE2 | HWY_AVX3_DL | VIETE_HWY_AVX3_ZEN4 | VIETE_HWY_AVX3_SPR | \
   HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | (VIETE_KERNELS_LEFT_OUT))

// The scalar version, or null if each computer that the build supports has a better instruction set.
#if HWY_TARGETS & HWY_SCALAR
#define VIETE_CHOOSE_SCALAR(name) &N_SCALAR::name
#else
#define VIETE_CHOOSE_SCALAR(name) nullptr
#endif
// Use after Highway's foreach_target: returns the object `name` of the namespace of `target`.
#define VIETE_RETURN_COMPILED(name, target)               \
  return *((target) == HWY_AVX3   ? HWY_CHOOSE_AVX3(name) \
           : (target) == HWY_AVX2 ? HWY_CHOOSE_AVX2(name) \
           : (target) == HWY_NEON ? HWY_CHOOSE_NEON(name) \
                                  : VIETE_CHOOSE_SCALAR(name))
