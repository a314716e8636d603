// The error bounds of method `fast`, for every kernel that this machine can run, against 113 bits.
#include <algorithm>
#include <string>
#include <vector>

#include "sym3/each_kernel.h"
#include "sym3/entries_of.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

namespace {

/// The worst error in u of each kernel; NaN counts as infinite.
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

}  // namespace

TEST_CASE_TEMPLATE("papers_ensemble_is_exact_to_8_u", T, double, float) {
  check_bound("paper", paper_ensemble<T>(20000), 8, 12);
}

TEST_CASE_TEMPLATE("any_gap_at_spread_up_to_3_is_exact_to_6_u", T, double, float) {
  for (int digits = 1; digits <= 16; ++digits) {
    const double gap = std::pow(10.0, -digits);
    check_bound("pair " + std::to_string(digits), pairs<T>(gap, 500), 6, 10);
    check_bound("triple " + std::to_string(digits), triples<T>(gap, 500), 6, 10);
  }
  for (const double spread : {0.1, 1.0, 2.0, 3.0}) {
    check_bound("spread", spreads<T>(spread, -spread / 3, 1000), 6, 10);
  }
}

TEST_CASE_TEMPLATE("tiny_matrices_are_exact_to_6_u", T, double, float) {
  for (const double size : {1e-3, 1e-8, 1e-30, 1e-37})
    check_bound("tiny", spreads<T>(size, -size / 2, 300), 6, 6);
}

TEST_CASE("error_grows_by_2_u_per_spread_at_any_trace_in_double") {
  for (const double spread : {0.0, 1.0, 4.9, 6.0, 10.0, 20.0, 50.0, 100.0, 300.0, 600.0, 900.0, 1300.0}) {
    for (const double lowest : {0.0, -spread / 3, -spread / 2, -spread, -690.0}) {
      if (lowest + spread < 705 && lowest + spread > -700) check_spread<double>(spread, lowest);
    }
  }
}

TEST_CASE("error_grows_by_2_u_per_spread_at_any_trace_in_float") {
  for (const double spread : {0.0, 1.0, 6.9, 10.0, 20.0, 50.0, 80.0, 110.0, 140.0}) {
    for (const double lowest : {0.0, -spread / 3, -spread / 2, -spread, -80.0}) {
      if (lowest + spread < 87 && lowest + spread > -80) check_spread<float>(spread, lowest);
    }
  }
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

TEST_CASE_TEMPLATE("exp_of_minus_s_is_the_inverse", T, double, float) {
  const double u = unit_roundoff<T>;
  for (const auto& s : paper_ensemble<T>(500, 21)) {
    const auto a = to_quad(exp_with(sym3::kernels()[0], s)),
               b = to_quad(exp_with(sym3::kernels()[0], negated(s)));
    const Quad xx = a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, xy = a.xx * b.xy + a.xy * b.yy + a.xz * b.yz;
    const double size = static_cast<double>(quad_frobenius(a) * quad_frobenius(b));
    CHECK(static_cast<double>(fabsq(xx - 1)) <= 16 * u * size);
    CHECK(static_cast<double>(fabsq(xy)) <= 16 * u * size);
  }
}

TEST_CASE_TEMPLATE("a_change_of_sign_of_an_axis_changes_only_signs", T, double, float) {
  for (const auto& kernel : sym3::kernels()) {
    for (const auto& s : spreads<T>(12, -5, 200)) {
      const auto e = exp_with(kernel, s);
      const auto flipped = exp_with(kernel, Sym3<T>{s.xx, -s.xy, s.xz, s.yy, -s.yz, s.zz});
      CHECK(flipped == Sym3<T>{e.xx, -e.xy, e.xz, e.yy, -e.yz, e.zz});
    }
  }
}
