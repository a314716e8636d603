#include "sym3/reference.h"

#include <cmath>
#include <limits>

#include "sym3/entries_of.h"
#include "sym3/exp.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

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
  for (const double gap : {1e-2, 1e-6, 1e-12}) {
    for (const auto& s : triples<double>(gap, 100)) CHECK(reference_error(s) < 1e-30);
  }
  for (const double spread : {0.0, 10.0, 100.0, 300.0, 1000.0}) {
    for (const double top : {0.0, 700.0, -600.0}) {
      for (const auto& s : spreads<double>(spread, top - spread, 100)) CHECK(reference_error(s) < 1e-28);
    }
  }
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
