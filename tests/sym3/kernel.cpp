#include "sym3/kernel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <vector>

#include "sym3/each_kernel.h"
#include "sym3/ensembles.h"

using namespace viete;
using namespace viete::test;
using sym3::Sym3;

TEST_CASE("kernels_have_names_and_the_last_is_portable") {
  std::set<std::string_view> names;
  for (const auto& kernel : sym3::kernels()) names.insert(kernel.name);
  CHECK(names.size() == sym3::kernels().size());
  CHECK(sym3::kernels().back().name == "portable");
  CHECK(names.count(sym3::kernel_name()));
}

TEST_CASE("the_environment_can_choose_the_kernel") {
  const char* wanted = std::getenv("VIETE_KERNEL");
  CHECK(sym3::kernel_name() == (wanted ? std::string_view(wanted) : sym3::kernels().front().name));
}

#if defined(__x86_64__)
TEST_CASE("a_processor_with_fused_multiply_add_has_the_fma_kernel") {
  const bool has = __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
  CHECK((sym3::kernels().front().name == "fma") == has);
}
#endif

TEST_CASE_TEMPLATE("any_count_and_position_gives_the_same_bits", T, double, float) {
  auto matrices = paper_ensemble<T>(40);
  const auto wide = spreads<T>(40, -20, 20);
  matrices.insert(matrices.begin() + 7, wide.begin(), wide.end());
  for (const auto& kernel : sym3::kernels()) {
    std::vector<T> flat;
    for (const auto& s : matrices) flat.insert(flat.end(), {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz});
    for (std::size_t count = 0; count <= matrices.size(); ++count) {
      std::vector<T> out(6 * matrices.size(), T(-1));
      run(kernel, flat.data(), out.data(), count);
      for (std::size_t i = 0; i < matrices.size(); ++i) {
        const T* e = &out[6 * i];
        const Sym3<T> expected =
            i < count ? exp_with(kernel, matrices[i]) : Sym3<T>{T(-1), T(-1), T(-1), T(-1), T(-1), T(-1)};
        REQUIRE(Sym3<T>{e[0], e[1], e[2], e[3], e[4], e[5]} == expected);
      }
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
