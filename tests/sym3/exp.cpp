#include <limits>
#include <string>

#include "sym3/arranged.h"
#include "sym3/exp.h"
#include "sym3/highway_targets.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

#include "sym3/exp_derivative-inl.h"  // includes Highway, so highway_targets.h must come first

using sym3::Method;

namespace {

constexpr Method all_methods[] = {Method::diag, Method::sd, Method::improved_sd, Method::improved_sd_faithful,
                                  Method::fast};

template <class T>
std::vector<double> worst_errors(const std::vector<Sym3<T>>& matrices) {
  std::vector<double> worst(sym3::kernels().size(), 0);
  for (const auto& s : matrices) {
    const QuadSym exact = quad_exp(to_quad(s));
    for (std::size_t k = 0; k < worst.size(); ++k) {
      const double error = error_in_u(exp_with(sym3::kernels()[k], s), exact);
      worst[k] = std::max(worst[k], std::isnan(error) ? INFINITY : error);
    }
  }
  return worst;
}

template <class T>
void check_bound(const std::string& what, const std::vector<Sym3<T>>& matrices, double fused_bound,
                 double plain_bound) {
  const auto worst = worst_errors(matrices);
  for (std::size_t k = 0; k < worst.size(); ++k) {
    const auto& kernel = sym3::kernels()[k];
    CAPTURE(kernel.name);
    CAPTURE(what);
    CHECK(worst[k] <= (kernel.fused ? fused_bound : plain_bound));
  }
}

template <class T>
void check_spread(double spread, double lowest) {
  const std::string what = "spread " + std::to_string(spread) + " from " + std::to_string(lowest);
  check_bound(what, spreads<T>(spread, lowest, 600), 6 + 2 * spread, 8 + 2.5 * spread);
}

namespace lanes = viete::sym3::HWY_NAMESPACE;

template <class T>
void check_lanes(double spread) {
  const hwy::HWY_NAMESPACE::CappedTag<T, 1> d;
  const auto all = spreads<T>(spread, -spread / 2, 100);
  const sym3::Kernel& kernel = sym3::kernels().back();
  using V = hwy::HWY_NAMESPACE::Vec<std::remove_const_t<decltype(d)>>;
  const auto load = [&](const Sym3<T>& s) {
    const auto set = [&](T x) { return hwy::HWY_NAMESPACE::Set(d, x); };
    return lanes::Six<V>(set(s.xx), set(s.xy), set(s.xz), set(s.yy), set(s.yz), set(s.zz));
  };
  const auto store = [](const lanes::Six<V>& s) {
    using hwy::HWY_NAMESPACE::GetLane;
    return Sym3<T>{GetLane(s.xx), GetLane(s.xy), GetLane(s.xz), GetLane(s.yy), GetLane(s.yz), GetLane(s.zz)};
  };
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const auto point = lanes::exp_point(d, load(all[i]));
    Sym3<T> expected;
    sym3::functions<T>(kernel).derivative->one(&all[i].xx, &all[i + 1].xx, &expected.xx, sym3::Of::exp, 0);
    CHECK(store(lanes::exp_derivative(d, point, load(all[i + 1]))) == expected);
    CHECK(error_in_u(store(lanes::exp_value(d, point)), quad_exp(to_quad(all[i]))) <= 8 + 2.5 * spread);
  }
}

template <class T>
constexpr T inf = std::numeric_limits<T>::infinity();

/// Checks that an entry overflows to an infinity of the correct sign, and leaves other entries finite.
template <class T>
void check_overflow(const sym3::Kernel& kernel, const Sym3<T>& s) {
  const auto computed = entries_of(exp_with(kernel, s));
  const auto exact = entries_of(quad_exp(to_quad(s)));
  const double largest = static_cast<double>(std::numeric_limits<T>::max());
  for (int i = 0; i < 6; ++i) {
    CHECK_FALSE(std::isnan(computed[i]));
    if (fabsq(exact[i]) > 1.001 * Quad(largest)) CHECK(computed[i] == (exact[i] > 0 ? inf<T> : -inf<T>));
    if (fabsq(exact[i]) < 0.999 * Quad(largest)) CHECK(std::isfinite(computed[i]));
  }
}

}  // namespace

TEST_CASE("every_method_is_found_by_its_name") {
  for (const Method method : all_methods) CHECK(sym3::method_from_name(sym3::name(method)) == method);
  CHECK(sym3::name(Method::improved_sd) == "improved_sd");
  CHECK_FALSE(sym3::method_from_name("improved sd"));
  CHECK_FALSE(sym3::method_from_name(""));
}

TEST_CASE_TEMPLATE("default_is_fast_by_the_running_kernel", T, double, float) {
  for (const auto& s : paper_ensemble<T>(100)) {
    CHECK(sym3::exp(s) == sym3::exp(s, Method::fast));
    CHECK(sym3::exp(s) == exp_with(sym3::kernel(), s));
  }
}

TEST_CASE_TEMPLATE("batch_has_the_bits_of_the_single_call_also_in_place", T, double, float) {
  auto matrices = paper_ensemble<T>(50);
  matrices.push_back({});
  matrices.push_back({std::numeric_limits<T>::quiet_NaN(), 0, 0, 0, 0, 0});
  matrices.push_back(diagonal(T(710), T(0), T(0)));
  for (const Method method : all_methods) {
    std::vector<Sym3<T>> out(matrices.size()), in_place = matrices;
    sym3::exp<T>(matrices, out, method);
    sym3::exp<T>(in_place, in_place, method);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      CHECK(same_or_nan<T>(out[i], sym3::exp(matrices[i], method)));
      CHECK(same_or_nan<T>(in_place[i], out[i]));
    }
  }
}

TEST_CASE_TEMPLATE("nan_and_infinity_give_six_nan_by_every_method", T, double, float) {
  for (const Method method : all_methods)
    for (const T bad : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity()}) {
      CHECK(all_nan(sym3::exp(Sym3<T>{1, bad, 0, 2, 0, 3}, method)));
      CHECK(all_nan(sym3::exp(Sym3<T>{1, 0, 0, 2, 0, bad}, method)));
    }
}

TEST_CASE_TEMPLATE("papers_ensemble_is_exact_to_8_u", T, double, float) {
  check_bound("paper", paper_ensemble<T>(20000), 8, 12);
}

TEST_CASE_TEMPLATE("any_gap_at_spread_up_to_3_is_exact_to_6_u", T, double, float) {
  for (int digits = 1; digits <= 16; ++digits) {
    const double gap = std::pow(10.0, -digits);
    check_bound("pair " + std::to_string(digits), pairs<T>(gap, 500), 6, 10);
    check_bound("triple " + std::to_string(digits), triples<T>(gap, 500), 6, 10);
  }
  for (const double spread : {0.1, 1.0, 2.0, 3.0})
    check_bound("spread", spreads<T>(spread, -spread / 3, 1000), 6, 10);
}

TEST_CASE_TEMPLATE("tiny_matrices_are_exact_to_6_u", T, double, float) {
  for (const double size : {1e-3, 1e-8, 1e-30, 1e-37})
    check_bound("tiny", spreads<T>(size, -size / 2, 300), 6, 6);
}

TEST_CASE("error_grows_by_2_u_per_spread_at_any_trace") {
  for_spreads<double>({0.0, 1.0, 4.9, 6.0, 10.0, 20.0, 50.0, 100.0, 300.0, 600.0, 900.0, 1300.0},
                      check_spread<double>);
  for_spreads<float>({0.0, 1.0, 6.9, 10.0, 20.0, 50.0, 80.0, 110.0, 140.0}, check_spread<float>);
}

TEST_CASE("just_below_overflow_and_just_above_underflow_the_bounds_hold") {
  for (const double spread : {0.0, 3.0, 10.0}) {
    check_spread<double>(spread, 709 - spread);
    check_spread<double>(spread, -707.5);
    check_spread<float>(spread, 88 - spread);
    check_spread<float>(spread, -87);
  }
}

TEST_CASE_TEMPLATE("rank_one_and_diagonal_matrices_keep_the_bounds", T, double, float) {
  Random random(11);
  std::vector<Sym3<T>> rank_one, diagonals;
  for (int i = 0; i < 1000; ++i) {
    const T x = T(uniform(random, -1, 1)), y = T(uniform(random, -1, 1)), z = T(uniform(random, -1, 1));
    rank_one.push_back({x * x, x * y, x * z, y * y, y * z, z * z});
    diagonals.push_back(diagonal(3 * x, 3 * y, 3 * z));
  }
  check_bound("rank one", rank_one, 8, 10);
  check_bound("diagonal", diagonals, 18, 23);
}

TEST_CASE_TEMPLATE("exp_and_its_derivative_of_registers_come_from_one_point", T, double, float) {
  for (const double spread : {0.0, 1.0, 4.9, 30.0}) check_lanes<T>(spread);
}

TEST_CASE_TEMPLATE("zero_gives_exactly_the_identity", T, double, float) {
  for (const Method method : {Method::diag, Method::sd, Method::improved_sd, Method::fast})
    CHECK(sym3::exp(Sym3<T>{}, method) == sym3::identity<T>());
  for (const auto& kernel : sym3::kernels()) {
    CHECK(exp_with(kernel, Sym3<T>{}) == sym3::identity<T>());
    CHECK(exp_with(kernel, diagonal(T(-0.0), T(0), T(-0.0))) == sym3::identity<T>());
  }
}

TEST_CASE_TEMPLATE("subnormal_entries_give_the_identity", T, double, float) {
  const T tiny = std::numeric_limits<T>::denorm_min();
  for (const auto& kernel : sym3::kernels()) {
    const auto e = exp_with(kernel, Sym3<T>{tiny, -tiny, tiny, tiny, tiny, -tiny});
    CHECK(e.xx == 1);
    CHECK(e.yy == 1);
    CHECK(e.zz == 1);
    CHECK(std::fabs(e.xy) <= 2 * tiny);
  }
}

TEST_CASE("diagonal_overflow_stays_in_its_entry") {
  for (const auto& kernel : sym3::kernels()) {
    CHECK(exp_with(kernel, diagonal(710.0, 0.0, 0.0)) == diagonal(inf<double>, 1.0, 1.0));
    CHECK(exp_with(kernel, diagonal(0.0, 1e300, 0.0)) == diagonal(1.0, inf<double>, 1.0));
    CHECK(exp_with(kernel, diagonal(0.0, 0.0, -1e200)) == diagonal(1.0, 1.0, 0.0));
    CHECK(exp_with(kernel, diagonal(89.0f, 0.0f, 0.0f)) == diagonal(inf<float>, 1.0f, 1.0f));
    CHECK(exp_with(kernel, diagonal(800.0, 800.0, 800.0)) == diagonal(inf<double>, inf<double>, inf<double>));
    CHECK(exp_with(kernel, diagonal(-800.0, -800.0, -800.0)) == Sym3<double>{});
  }
}

TEST_CASE("overflow_in_one_block_leaves_the_other_exact") {
  const double e1 = static_cast<double>(expq(2) * coshq(1)), e2 = static_cast<double>(expq(2) * sinhq(1));
  for (const auto& kernel : sym3::kernels())
    for (const double big : {712.0, 1e5, 1e150, 1.7e308}) {
      const auto e = exp_with(kernel, Sym3<double>{big, 0, 0, 2, 1, 2});
      CHECK(e.xx == inf<double>);
      CHECK(e.xy == 0);
      CHECK(e.yy == doctest::Approx(e1).epsilon(1e-14));
      CHECK(e.yz == doctest::Approx(e2).epsilon(1e-14));
    }
}

TEST_CASE("overflow_gives_signed_infinities_and_never_nan") {
  Random random(31);
  for (const auto& kernel : sym3::kernels())
    for (int i = 0; i < 300; ++i) {
      const double a = uniform(random, 680, 730), b = uniform(random, -400, 730),
                   c = uniform(random, 600, 730);
      check_overflow(kernel, with_eigenvalues<double>({a, b, c}, random));
      check_overflow(kernel, with_eigenvalues<float>({a / 8, b / 8, c / 8}, random));
    }
}

TEST_CASE("entries_near_the_largest_number_overflow_no_intermediate_step") {
  const double d = std::numeric_limits<double>::max();
  const float f = std::numeric_limits<float>::max();
  for (const auto& kernel : sym3::kernels()) {
    CHECK(exp_with(kernel, diagonal(d, d, d)) == diagonal(inf<double>, inf<double>, inf<double>));
    CHECK(exp_with(kernel, diagonal(-d, -d, -d)) == Sym3<double>{});
    CHECK(exp_with(kernel, diagonal(d, -d, 1.0)) == diagonal(inf<double>, 0.0, std::exp(1.0)));
    CHECK(exp_with(kernel, diagonal(f, -f, 0.0f)) == diagonal(inf<float>, 0.0f, 1.0f));
    const auto positive = exp_with(kernel, Sym3<double>{d, d, d, d, d, d});
    CHECK(positive ==
          Sym3<double>{inf<double>, inf<double>, inf<double>, inf<double>, inf<double>, inf<double>});
    const auto mixed = exp_with(kernel, Sym3<double>{d, -d, 0, d, 0, d});
    CHECK(none_nan(mixed));
    CHECK(mixed.xy == -inf<double>);
    CHECK(none_nan(exp_with(kernel, Sym3<float>{f, -f, f, f, -f, f})));
  }
}

TEST_CASE("underflow_is_gradual") {
  for (const auto& kernel : sym3::kernels())
    for (const double mean : {-707.0, -710.0, -720.0, -740.0, -744.0}) {
      const Sym3<double> s{mean, 0.25, 0, mean, 0, mean};
      const auto exact = entries_of(quad_exp(to_quad(s)));
      const auto computed = entries_of(exp_with(kernel, s));
      for (int i = 0; i < 6; ++i) {
        const double error = std::fabs(static_cast<double>(Quad(computed[i]) - exact[i]));
        CHECK(error <= 0x1p-1074 + 0x1p-50 * static_cast<double>(fabsq(exact[i])));
      }
    }
}

TEST_CASE_TEMPLATE("any_finite_bits_give_no_nan", T, double, float) {
  Random random(32);
  for (int i = 0; i < 4000; ++i) {
    const auto s = any_finite<T>(random);
    for (const auto& kernel : sym3::kernels()) CHECK(none_nan(exp_with(kernel, s)));
  }
}

namespace {

struct Errors {
  double worst = 0;  ///< in u, without NaN
  int nan = 0;
};

template <class T>
Errors errors_of(sym3::Method method, const std::vector<Sym3<T>>& matrices) {
  Errors errors;
  for (const auto& s : matrices) {
    const double error = error_in_u(sym3::exp(s, method), quad_exp(to_quad(s)));
    if (std::isnan(error))
      ++errors.nan;
    else
      errors.worst = std::max(errors.worst, error);
  }
  return errors;
}

}  // namespace

TEST_CASE_TEMPLATE("diag_errs_by_20_u_and_20_u_per_size_of_eigenvalue", T, double, float) {
  const auto check = [](const std::vector<Sym3<T>>& matrices, double size) {
    const Errors errors = errors_of(Method::diag, matrices);
    CHECK(errors.nan == 0);
    CHECK(errors.worst <= 20 + 20 * size);
  };
  check(paper_ensemble<T>(5000), 5);
  for (const double gap : {1e-1, 1e-4, 1e-8, 1e-16}) {
    check(pairs<T>(gap, 500), 3);
    check(triples<T>(gap, 500), 3);
  }
  for (const double spread : {1.0, 10.0, 80.0}) check(spreads<T>(spread, 0, 500), spread);
  if (sizeof(T) == 8) {
    check(spreads<T>(5, -700, 500), 700);
    check(spreads<T>(300, 400, 500), 700);
  }
}

TEST_CASE("spectral_forms_agree_with_the_truth_on_the_papers_ensemble") {
  const auto matrices = paper_ensemble<double>(5000);
  for (const auto method : {Method::sd, Method::improved_sd, Method::improved_sd_faithful}) {
    const Errors errors = errors_of(method, matrices);
    CHECK(errors.nan == 0);
    CHECK(errors.worst <= 2e4);
  }
}

TEST_CASE("guarded_spectral_forms_err_by_at_most_one_percent_on_clusters_and_are_never_nan") {
  for (const auto method : {Method::sd, Method::improved_sd})
    for (int digits = 1; digits <= 16; ++digits) {
      const double gap = std::pow(10.0, -digits);
      for (const auto& matrices : {pairs<double>(gap, 200), triples<double>(gap, 200)}) {
        const Errors errors = errors_of(method, matrices);
        CHECK(errors.nan == 0);
        CHECK(errors.worst * 0x1p-53 <= 1e-2);
      }
    }
}

TEST_CASE("closed_form_loses_digits_on_a_cluster_of_three") {
  CHECK(errors_of(Method::improved_sd, triples<double>(1e-5, 300)).worst * 0x1p-53 > 1e-6);
}

TEST_CASE("improved_sd_is_its_faithful_form_where_that_needs_no_guard") {
  for (const auto& s : paper_ensemble<double>(2000)) {
    const auto guarded = sym3::exp(s, Method::improved_sd),
               faithful = sym3::exp(s, Method::improved_sd_faithful);
    CHECK((all_nan(faithful) || guarded == faithful));
  }
}

TEST_CASE_TEMPLATE("faithful_form_gives_nan_for_multiples_of_the_identity", T, double, float) {
  CHECK(all_nan(sym3::exp(Sym3<T>{}, Method::improved_sd_faithful)));
  CHECK(all_nan(sym3::exp(diagonal(T(2), T(2), T(2)), Method::improved_sd_faithful)));
  CHECK(sym3::exp(diagonal(T(2), T(2), T(2)), Method::improved_sd).xx == std::exp(T(2)));
}

TEST_CASE("faithful_form_gives_nan_for_many_double_eigenvalues") {
  const int nan = errors_of(Method::improved_sd_faithful, pairs<double>(1e-12, 400)).nan;
  CHECK(nan > 100);
  CHECK(nan < 300);
}

TEST_CASE("all_three_cases_of_the_switch_are_right") {
  const Sym3<double> one = diagonal(1.5, 1.5, 1.5), two = diagonal(1.0, 2.0, 2.0),
                     three = diagonal(1.0, 2.0, 4.0);
  for (const auto& s : {one, two, three, diagonal(2.0, 1.0, 2.0), diagonal(2.0, 2.0, 1.0)})
    for (const auto method : {Method::sd, Method::improved_sd})
      CHECK(error_in_u(sym3::exp(s, method), quad_exp(to_quad(s))) * 0x1p-53 < 1e-7);
}
