#include <cstdlib>
#include <limits>
#include <set>

#include "sym3/arranged.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

TEST_CASE("kernels_have_names_and_the_last_runs_everywhere") {
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
  CHECK(has("avx2") == (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")));
  CHECK(has("avx512") == (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")));
}
#endif

TEST_CASE("fused_kernels_agree_in_every_bit_and_so_do_the_others") {
  for (const double spread : {0.0, 1e-9, 3.0, 6.0, 40.0, 700.0, 1500.0})
    for (const auto& s : spreads<double>(spread, -0.5 * spread, 100))
      for (const auto& a : sym3::kernels())
        for (const auto& b : sym3::kernels())
          if (a.fused == b.fused) CHECK(exp_with(a, s) == exp_with(b, s));
}

using namespace viete::sym3;

TEST_CASE("a_route_reports_the_case_of_the_paper_and_the_squarings_of_fast") {
  const Sym3<double> apart{0.5, 0.1, 0, -0.2, 0.05, 0.9}, pair{1, 0, 0, 1, 0, 3}, all{2, 0, 0, 2, 0, 2};
  for (const Method method : {Method::sd, Method::improved_sd}) {
    CHECK(route(apart, method).distinct == 3);
    CHECK(route(pair, method).distinct == 2);
    CHECK(route(all, method).distinct == 1);
    // The threshold in the paper is 1e-6.
    CHECK(route({1, 0, 0, 1 + 3e-6, 0, 3}, method).distinct == 3);
    CHECK(route({1, 0, 0, 1 + 3e-7, 0, 3}, method).distinct == 2);
  }
  CHECK(route(apart, Method::diag) == Route{});
  CHECK(route(apart, Method::fast) == Route{.degree = 21});
  CHECK(route(all, Method::fast) == Route{.degree = 21});
  // If p = |A|^2 / 2 is at most 8, there are no squarings. Each halving of A divides p by four.
  const auto spread = [](double x) { return Sym3<double>{x, 0.1, 0, -x, 0, 0}; };
  CHECK(route(spread(2.8), Method::fast).squarings == 0);
  CHECK(route(spread(2.9), Method::fast).squarings == 1);
  CHECK(route(spread(12), Method::fast).squarings == 3);
  CHECK(route(spread(1e4), Method::fast).by_jacobi);
  CHECK(route({20, 0, 0, -20, 0, 1}, Method::fast).by_jacobi);  // diagonal
  CHECK(route({800, 0.1, 0, 0, 0, 0}, Method::fast).by_jacobi);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(route({nan, 0, 0, 0, 0, 0}, Method::fast).by_jacobi);
  CHECK(route({nan, 0, 0, 0, 0, 0}, Method::sd) == Route{});
}

namespace {

double reference_error(const Sym3<double>& s) {
  const auto r = sym3::exp_reference(s);
  const QuadSym exact = quad_exp(test::to_quad(s));
  const QuadSym computed = {to_quad(r.xx), to_quad(r.xy), to_quad(r.xz),
                            to_quad(r.yy), to_quad(r.yz), to_quad(r.zz)};
  return static_cast<double>(quad_distance(computed, exact) / quad_frobenius(exact));
}

}  // namespace

TEST_CASE("reference_is_exact_to_1e_28_for_spreads_to_1000") {
  for (const auto& s : paper_ensemble<double>(500)) CHECK(reference_error(s) < 1e-30);
  for (const double gap : {1e-2, 1e-6, 1e-12})
    for (const auto& s : triples<double>(gap, 100)) CHECK(reference_error(s) < 1e-30);
  for (const double spread : {0.0, 10.0, 100.0, 300.0, 1000.0})
    for (const double top : {0.0, 700.0, -600.0})
      for (const auto& s : spreads<double>(spread, top - spread, 100)) CHECK(reference_error(s) < 1e-28);
}

TEST_CASE("reference_is_the_identity_for_zero_and_nan_for_nan") {
  const auto one = sym3::exp_reference({});
  CHECK(one.xx.hi == 1);
  CHECK(one.xx.lo == 0);
  CHECK(one.xy.hi == 0);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e7}) {
    CHECK(std::isnan(sym3::exp_reference({1, 0, bad, 1, 0, 1}).yy.hi));
    CHECK(std::isnan(sym3::exp_reference({1, 0, 0, 1, 0, bad}).xx.hi));
  }
}

TEST_CASE("reference_overflows_to_infinity") {
  const auto r = sym3::exp_reference({720, 0.5, 0, 720, 0, 1});
  CHECK(r.xx.hi == std::numeric_limits<double>::infinity());
  CHECK(r.xx.lo == 0);
  CHECK(std::isfinite(r.zz.hi));
}

TEST_CASE("relative_error_is_the_distance_over_the_norm") {
  for (const auto& s : paper_ensemble<double>(200)) {
    Sym3<double> e = sym3::exp(s);
    const double by_quad = error_in_u(e, quad_exp(test::to_quad(s))) * 0x1p-53;
    CHECK(sym3::relative_error(e, s) == doctest::Approx(by_quad).epsilon(1e-10));
    e.xy += 1e-3;
    const double by_quad_moved = error_in_u(e, quad_exp(test::to_quad(s))) * 0x1p-53;
    CHECK(sym3::relative_error(e, s) == doctest::Approx(by_quad_moved).epsilon(1e-10));
  }
}

TEST_CASE("relative_error_survives_large_results_and_reports_nan") {
  const Sym3<double> s{600, 20, 10, 650, 30, 690};
  CHECK(sym3::relative_error(sym3::exp(s), s) < 1e-12);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(sym3::relative_error({1, nan, 0, 1, 0, 1}, {})));
  CHECK(sym3::relative_error(sym3::identity<double>(), {}) == 0);
}
