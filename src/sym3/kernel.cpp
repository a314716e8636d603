#include "sym3/kernel.h"

#include <cstdlib>

#include "sym3/highway_targets.h"
#include "sym3/kernel_table.h"
#define HWY_TARGET_INCLUDE "sym3/kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

namespace viete::sym3::HWY_NAMESPACE {

#define VIETE_FUNCTION(name, ...)                           \
  extern const Function<double, __VA_ARGS__> name##_double; \
  extern const Function<float, __VA_ARGS__> name##_float;
VIETE_FUNCTION(exp, 6, 6)
VIETE_FUNCTION(log, 6, 6)
VIETE_FUNCTION(sqrt, 6, 6)
VIETE_FUNCTION(inv_sqrt, 6, 6)
VIETE_FUNCTION(pow, 6, 6, double)
VIETE_FUNCTION(eigenvalues, 6, 3)
VIETE_FUNCTION(exp_rotation, 3, 9)
VIETE_FUNCTION(log_rotation, 9, 3)
VIETE_FUNCTION(rotation_of, 9, 9)
VIETE_FUNCTION(tangent, 6, 36, Of, double)
#undef VIETE_FUNCTION
extern const Decomposition<double, 9, 9, 6> polar_double;
extern const Decomposition<float, 9, 9, 6> polar_float;
extern const Decomposition<double, 6, 3, 9> eigh_double;
extern const Decomposition<float, 6, 3, 9> eigh_float;
extern const Decomposition<double, 9, 9, 3, 9> svd_double;
extern const Decomposition<float, 9, 9, 3, 9> svd_float;
extern const DerivativeFunction<double> derivative_double;
extern const DerivativeFunction<float> derivative_float;

#define VIETE_FUNCTIONS_OF(T)                                                                               \
  {                                                                                                         \
    &exp_##T, &log_##T, &sqrt_##T, &inv_sqrt_##T, &pow_##T, &eigenvalues_##T, &exp_rotation_##T,            \
        &log_rotation_##T, &rotation_of_##T, &polar_##T, &eigh_##T, &svd_##T, &derivative_##T, &tangent_##T \
  }
static const KernelTable table = {VIETE_FUNCTIONS_OF(double), VIETE_FUNCTIONS_OF(float)};
#undef VIETE_FUNCTIONS_OF

}  // namespace viete::sym3::HWY_NAMESPACE

#if HWY_ONCE
namespace viete::sym3 {

namespace {

constexpr Kernel compiled[] = {
#if HWY_TARGETS & HWY_AVX3
    {"avx512", true, HWY_AVX3, &N_AVX3::table},
#endif
#if HWY_TARGETS & HWY_AVX2
    {"avx2", true, HWY_AVX2, &N_AVX2::table},
#endif
#if HWY_TARGETS & HWY_NEON
    {"neon", true, HWY_NEON, &N_NEON::table},
#endif
#if HWY_TARGETS & HWY_SCALAR  // not compiled if all processors of the platform support another kernel
    {"scalar", false, HWY_SCALAR, &N_SCALAR::table},
#endif
};

bool machine_can_run(const Kernel& k) {
#if defined(__x86_64__) || defined(__i386__)
  const bool avx2 = __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("avx2") &&
                    __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2") &&
                    __builtin_cpu_supports("bmi");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  if (k.highway_target == HWY_AVX3) return avx512;
  if (k.highway_target == HWY_AVX2) return avx2;
#endif
  return k.highway_target == HWY_SCALAR || k.highway_target == HWY_NEON;
}

// Returns the supported kernels. If a processor supports a kernel, it also supports all kernels after it.
std::span<const Kernel> find() {
  const std::span<const Kernel> all(compiled);
  std::size_t skipped = 0;
  while (!machine_can_run(all[skipped])) ++skipped;
  return all.subspan(skipped);
}

}  // namespace

std::span<const Kernel> kernels() {
  static const std::span<const Kernel> all = find();
  return all;
}

const Kernel* kernel_from_name(std::string_view name) {
  for (const Kernel& k : kernels()) {
    if (k.name == name) return &k;
  }
  return nullptr;
}

const Kernel& kernel() {
  static const Kernel* const chosen = [] {
    const char* wanted = std::getenv("VIETE_KERNEL");
    const Kernel* k = wanted ? kernel_from_name(wanted) : nullptr;
    return k ? k : &kernels().front();
  }();
  return *chosen;
}

std::string_view kernel_name() {
  return kernel().name;
}

}  // namespace viete::sym3
#endif
