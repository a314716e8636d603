#include "sym3/kernel.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <vector>

#include "sym3/call_kernel.h"
#include "sym3/each_kernel.h"
#include "sym3/preamble.h"

TEST_CASE("kernels_have_names_and_the_last_is_what_all_machines_have") {
  std::set<std::string_view> names;
  for (const auto& kernel : sym3::kernels()) {
    names.insert(kernel.name);
    CHECK(sym3::kernel_from_name(kernel.name) == &kernel);
  }
  CHECK(names.size() == sym3::kernels().size());
#ifdef __aarch64__
  CHECK(sym3::kernels().back().name == "neon");
#else
  CHECK(sym3::kernels().back().name == "scalar");
#endif
  CHECK(names.count(sym3::kernel_name()));
  CHECK(sym3::kernel_from_name("fastest") == nullptr);
}

TEST_CASE("the_environment_can_choose_the_kernel") {
  const char* wanted = std::getenv("VIETE_KERNEL");
  CHECK(sym3::kernel_name() == (wanted ? std::string_view(wanted) : sym3::kernels().front().name));
}

#if defined(__x86_64__)
TEST_CASE("a_processor_has_the_kernels_of_its_instruction_sets") {
  const auto has = [](std::string_view name) { return sym3::kernel_from_name(name) != nullptr; };
  CHECK(has("sse4") == bool(__builtin_cpu_supports("sse4.2")));
  CHECK(has("avx2") == (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")));
  CHECK(has("avx512") == (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")));
}
#endif

TEST_CASE("fused_kernels_agree_in_every_bit_and_so_do_the_others") {
  for (const double spread : {0.0, 1e-9, 3.0, 6.0, 40.0, 700.0, 1500.0}) {
    for (const auto& s : spreads<double>(spread, -0.5 * spread, 100)) {
      for (const auto& a : sym3::kernels()) {
        for (const auto& b : sym3::kernels()) {
          if (a.fused == b.fused) CHECK(exp_with(a, s) == exp_with(b, s));
        }
      }
    }
  }
}

TEST_CASE_TEMPLATE("the_single_call_of_every_kernel_has_the_bits_of_its_batch", T, double, float) {
  for (const auto& kernel : sym3::kernels()) {
    for (const auto& s : spreads<T>(12, -5, 100)) {
      Sym3<T> out;
      sym3::functions<T>(kernel).exp->one(&s.xx, &out.xx);
      CHECK(out == exp_with(kernel, s));
    }
  }
}

TEST_CASE("kernels_differ_by_rounding_only") {
  for (const auto& s : paper_ensemble<double>(500)) {
    const auto a = exp_with(sym3::kernels().front(), s), b = exp_with(sym3::kernels().back(), s);
    CHECK(std::fabs(a.xx - b.xx) <= 0x1p-49 * std::max({a.xx, a.yy, a.zz}));
    CHECK(std::fabs(a.yz - b.yz) <= 0x1p-49 * std::max({a.xx, a.yy, a.zz}));
  }
}
