// The kernel "fma": this file is compiled with the flags for AVX2 and FMA on x86-64 (see CMakeLists.txt).
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
#define VIETE_KERNEL_FUSED 1
#else
#define VIETE_KERNEL_FUSED 0
#endif
#define VIETE_KERNEL_NAMESPACE fma
#include "sym3/exp_kernel-inl.h"

namespace viete::sym3::fma {
extern const bool compiled = VIETE_KERNEL_FUSED;
}
