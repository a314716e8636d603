#include "sym3/kernel.h"

#include <cstdlib>

#include "sym3/exp_kernels.h"

namespace viete::sym3 {

namespace {

bool machine_has_fma() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
#else
  return true;
#endif
}

bool can_run_fma() {
  return fma::compiled && machine_has_fma();
}

const Kernel& choose() {
  if (const char* wanted = std::getenv("VIETE_KERNEL")) {
    for (const Kernel& k : kernels()) {
      if (k.name == wanted) return k;
    }
  }
  return kernels().front();
}

}  // namespace

std::span<const Kernel> kernels() {
  static const Kernel all[] = {{"fma", fma::exp, fma::exp}, {"portable", portable::exp, portable::exp}};
  static const std::size_t skipped = can_run_fma() ? 0 : 1;
  return std::span(all).subspan(skipped);
}

const Kernel& kernel() {
  static const Kernel& chosen = choose();
  return chosen;
}

std::string_view kernel_name() {
  return kernel().name;
}

}  // namespace viete::sym3
