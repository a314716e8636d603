#include "sym3/exp.h"

#include "sym3/arranged.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

namespace {

using sym3::Method;

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
