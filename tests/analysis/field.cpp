#include "analysis/field.h"

#include <doctest/doctest.h>

#include <set>

#include "sym3/exp.h"
#include "sym3/jacobi.h"

using namespace viete;
using analysis::Field;
using Matrices = std::vector<sym3::Sym3<double>>;

namespace {

analysis::FieldValues of_matrices(Field field, const Matrices& matrices,
                                  sym3::Method method = sym3::Method::fast,
                                  base::Progress* progress = nullptr) {
  analysis::FieldInput input{};
  input.matrices = matrices;
  input.method = method;
  input.progress = progress;
  return analysis::measure(field, input);
}

analysis::FieldValues of_shares(const std::vector<double>& shares) {
  analysis::FieldInput input{};
  input.shares = shares;
  return analysis::measure(Field::influence, input);
}

double determinant(const sym3::Sym3<sym3::DoubleDouble>& m) {
  const auto d = m.xx * (m.yy * m.zz - m.yz * m.yz) - m.xy * (m.xy * m.zz - m.yz * m.xz) +
                 m.xz * (m.xy * m.yz - m.yy * m.xz);
  return static_cast<double>(d.hi);
}

}  // namespace

TEST_CASE("fields_have_unique_names_in_order") {
  std::set<std::string_view> words;
  const auto all = choices(Field::none);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto field = static_cast<Field>(i);
    CHECK(analysis::entry(field).choice.word == all[i].word);
    CHECK(words.insert(all[i].word).second);
    CHECK((analysis::entry(field).compute == nullptr) == (field == Field::none));
  }
  CHECK(all.size() == static_cast<std::size_t>(Field::signed_difference) + 1);
  CHECK(analysis::entry(Field::gap).choice.word == "gap");
  CHECK(analysis::measure(Field::none, {}).values.empty());
}

TEST_CASE("exp_error_is_computed_for_every_matrix") {
  Matrices matrices;
  for (int i = 0; i < 3000; ++i) matrices.push_back({0.3, 0.1 + 1e-4 * i, -0.2, 0.4, 1e-5 * i, -0.1});
  for (const auto method : {sym3::Method::fast, sym3::Method::improved_sd}) {
    const auto map = of_matrices(Field::exp_error, matrices, method);
    REQUIRE(map.values.size() == matrices.size());
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      const double error = sym3::relative_error(sym3::exp(matrices[i], method), matrices[i]);
      CHECK(map.values[i] == doctest::Approx(std::log10(std::max(error, 1e-20))).epsilon(1e-5));
    }
    CHECK(map.stats.most == double(*std::ranges::max_element(map.values)));
    CHECK(double(map.values[map.stats.worst]) == map.stats.most);
    CHECK(map.stats.vertices == 3000);
    CHECK(map.stats.method == method);
    CHECK(std::accumulate(map.stats.counts.begin(), map.stats.counts.end(), 0u) == 3000);
  }
}

TEST_CASE("nan_values_are_flagged") {
  const auto map = of_matrices(Field::exp_error, Matrices(3), sym3::Method::improved_sd_faithful);
  CHECK(map.stats.is_nan);
  CHECK(map.values == std::vector<float>(3, 0.0F));
  CHECK(of_matrices(Field::exp_error, {}).stats.vertices == 0);
}

TEST_CASE("exp_error_can_be_cancelled") {
  base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(of_matrices(Field::exp_error, Matrices(3000), sym3::Method::fast, &progress),
                  base::Cancelled);
}

TEST_CASE("error_range_covers_all_methods") {
  Matrices easy, hard;
  for (int i = 0; i < 300; ++i) {
    easy.push_back({0.3, 0.1 + 1e-3 * i, -0.2, 0.9, 0.05, -0.6});
    hard.push_back({0.3, 0, 0, 0.3 + 2e-6, 1e-9 * i, 0.3 - 2e-6});
  }
  const auto range = [](const Matrices& matrices, sym3::Method method) {
    const auto stats = of_matrices(Field::exp_error, matrices, method).stats;
    return std::pair(stats.low, stats.high);
  };
  CHECK(range(easy, sym3::Method::fast) == range(easy, sym3::Method::sd));
  CHECK(range(hard, sym3::Method::fast) == range(hard, sym3::Method::sd));
  CHECK(range(hard, sym3::Method::fast).second > range(easy, sym3::Method::fast).second + 2);
  CHECK(std::round(range(hard, sym3::Method::fast).second) == range(hard, sym3::Method::fast).second);
}

TEST_CASE("volume_is_the_determinant_of_the_exponential") {
  Matrices matrices;
  for (int i = 0; i < 50; ++i) {
    const double a = std::sin(1.0 + i), b = std::cos(3.0 * i), c = std::sin(0.7 * i * i);
    matrices.push_back({a, 0.3 * b, 0.2 * c, -0.5 * b, 0.4 * a, 0.6 * c});
  }
  const auto map = of_matrices(Field::volume, matrices);
  for (std::size_t i = 0; i < matrices.size(); ++i)
    CHECK(std::exp2(double(map.values[i])) ==
          doctest::Approx(determinant(sym3::exp_reference(matrices[i]))).epsilon(1e-6));
  CHECK(map.stats.low == -map.stats.high);
}

TEST_CASE("gap_is_the_smallest_eigenvalue_gap_and_its_worst_is_the_least") {
  const Matrices matrices = {
      {3, 0, 0, 1, 0, 2.9}, {-4, 0, 0, 1, 0, 2}, {0, 0, 0, 0, 0, 0}, {1, 0, 0, 1, 0, 1}};
  const auto map = of_matrices(Field::gap, matrices);
  CHECK(double(map.values[0]) == doctest::Approx(std::log10(0.1 / 3)).epsilon(1e-6));
  CHECK(double(map.values[1]) == doctest::Approx(std::log10(0.25)).epsilon(1e-6));
  CHECK(map.values[2] == -17.0F);
  CHECK(map.values[3] < -15.0F);
  CHECK(map.stats.worst >= 2);
}

TEST_CASE("ranges_exclude_outliers_and_are_never_empty") {
  std::vector<double> shares(1000, 0.1);
  for (std::size_t i = 0; i < 500; ++i) shares[i] = 0.002 * double(i) / 10;
  shares[700] = 50;
  const auto map = of_shares(shares);
  CHECK(map.stats.low == 0);
  CHECK(map.stats.high >= 0.1);
  CHECK(map.stats.high < 0.13);
  CHECK(map.stats.worst == 700);
  CHECK(map.stats.most == doctest::Approx(50));
  const auto nothing = of_shares(std::vector<double>(10, 0));
  CHECK(nothing.stats.high > nothing.stats.low);
  CHECK(nothing.stats.counts[0] == 10);
}

TEST_CASE("values_are_formatted_for_display") {
  CHECK(analysis::text(Field::area, 1) == "2 x");
  CHECK(analysis::text(Field::turn, 12.52) == "12.5\u00b0");
  CHECK(analysis::text(Field::displacement, 0.032) == "3.2 %");
  CHECK(analysis::text(Field::exp_error, -16) == "1.0e-16");
}
