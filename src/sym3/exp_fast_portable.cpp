// The kernel "portable": separate multiplications and additions, for every machine.
#define VIETE_KERNEL_FUSED 0
#define VIETE_KERNEL_NAMESPACE portable
#include "sym3/exp_kernel-inl.h"
