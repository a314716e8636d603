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
