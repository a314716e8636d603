#include "app/method_measuring.h"

#include <doctest/doctest.h>

#include "sym3/exp.h"

using namespace viete;

namespace {

using Matrices = std::vector<sym3::Sym3<double>>;

Matrices some_matrices(int count) {
  Matrices matrices;
  for (int i = 0; i < count; ++i) matrices.push_back({0.3, 0.1 + 1e-4 * i, -0.2, 0.4, 1e-5 * i, -0.1});
  return matrices;
}

}  // namespace

TEST_CASE("every_method_is_measured_by_its_own_errors") {
  const Matrices matrices = some_matrices(101);
  const auto stats = app::measure_methods(matrices);
  CHECK(stats.matrices == 101);
  CHECK(app::measure_methods({}).matrices == 0);
  for (std::size_t m = 0; m < analysis::compared_methods.size(); ++m) {
    std::vector<double> errors;
    for (const auto& s : matrices)
      errors.push_back(sym3::relative_error(sym3::exp(s, analysis::compared_methods[m]), s));
    std::sort(errors.begin(), errors.end());
    CHECK(stats.samples[m].worst_error == errors.back());
    CHECK(stats.samples[m].median_error == errors[50]);
    CHECK(stats.samples[m].ns_per_matrix > 0);
  }
}

TEST_CASE("a_nan_result_makes_both_errors_nan") {
  Matrices matrices = some_matrices(3);
  matrices[1].xx = std::numeric_limits<double>::quiet_NaN();
  for (const auto& sample : app::measure_methods(matrices).samples) {
    CHECK(std::isnan(sample.worst_error));
    CHECK(std::isnan(sample.median_error));
  }
}

TEST_CASE("times_of_a_busy_computer_are_measured_again_at_growing_intervals_and_not_forever") {
  app::Retry retry;
  double now = 100;
  CHECK(retry.at > 1e9);
  for (const double wait : {2, 4, 8, 16, 32, 64}) {
    retry = retry.after(true, now);
    CHECK(retry.at == now + wait);
    now = retry.at;
  }
  CHECK(retry.after(true, now).at > 1e9);
  CHECK(retry.after(false, now).at > 1e9);
  CHECK(retry.after(false, now).after(true, now).at == now + 2);
}
