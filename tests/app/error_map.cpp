#include "app/error_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sym3/reference.h"

using namespace viete;

TEST_CASE("an_error_map_holds_the_error_of_every_matrix") {
  std::vector<sym3::Sym3<double>> matrices;
  for (int i = 0; i < 3000; ++i) matrices.push_back({0.3, 0.1 + 1e-4 * i, -0.2, 0.4, 1e-5 * i, -0.1});
  for (const auto method : {sym3::Method::fast, sym3::Method::improved_sd}) {
    const auto map = app::error_map(matrices, method);
    REQUIRE(map.log10.size() == matrices.size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      errors.push_back(sym3::relative_error(sym3::exp(matrices[i], method), matrices[i]));
      CHECK(map.log10[i] == doctest::Approx(std::log10(std::max(errors[i], 1e-20))).epsilon(1e-5));
    }
    std::sort(errors.begin(), errors.end());
    CHECK(map.stats.worst == errors.back());
    CHECK(map.stats.median == errors[errors.size() / 2]);
    CHECK(map.stats.vertices == 3000);
    CHECK(map.stats.method == method);
  }
}

TEST_CASE("an_answer_that_is_no_number_makes_the_map_say_so") {
  const auto map = app::error_map(std::vector<sym3::Sym3<double>>(3), sym3::Method::improved_sd_faithful);
  CHECK(std::isnan(map.stats.worst));
  CHECK(map.log10 == std::vector<float>(3, 0.0F));
  CHECK(app::error_map({}, sym3::Method::fast).stats.vertices == 0);
}

TEST_CASE("an_error_map_that_is_cancelled_ends") {
  base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(app::error_map(std::vector<sym3::Sym3<double>>(3000), sym3::Method::fast, &progress),
                  base::Cancelled);
}

TEST_CASE("the_range_of_an_error_map_is_that_of_all_methods_whichever_runs") {
  std::vector<sym3::Sym3<double>> easy, hard;
  for (int i = 0; i < 300; ++i) {
    easy.push_back({0.3, 0.1 + 1e-3 * i, -0.2, 0.9, 0.05, -0.6});
    hard.push_back({0.3, 0, 0, 0.3 + 2e-6, 1e-9 * i, 0.3 - 2e-6});
  }
  const auto range = [](const auto& matrices, sym3::Method method) {
    const auto stats = app::error_map(matrices, method).stats;
    return std::pair(stats.low, stats.high);
  };
  CHECK(range(easy, sym3::Method::fast) == range(easy, sym3::Method::sd));
  CHECK(range(hard, sym3::Method::fast) == range(hard, sym3::Method::sd));
  CHECK(range(hard, sym3::Method::fast).second > range(easy, sym3::Method::fast).second + 2);
  CHECK(std::round(range(hard, sym3::Method::fast).second) == range(hard, sym3::Method::fast).second);
}
