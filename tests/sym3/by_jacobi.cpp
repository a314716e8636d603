#include <type_traits>

#include "sym3/arranged.h"
#include "sym3/jacobi.h"
#include "sym3/log.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"
#include "sym3/small_matrices.h"
#include "sym3/with_condition.h"

using sym3::DoubleDouble;

namespace {

DoubleDouble random_number(Random& random) {
  const double hi = uniform(random, -2, 2) * std::exp2(uniform(random, -20, 20));
  return sym3::quick_two_sum(hi, hi * 0x1p-54 * uniform(random, -1, 1));
}

double relative(Quad computed, Quad exact) {
  return static_cast<double>(fabsq((computed - exact) / exact));
}

/// Returns the larger of |S - V diag(values) V^T| / |S| and |V^T V - I|.
template <class Real>
double residual(const Sym3<double>& s) {
  const auto e = sym3::eigen_by_jacobi<Real>(s);
  const QuadSym original = test::to_quad(s);
  QuadSym product{}, gram{};
  const auto v = [&](int i, int k) { return to_quad(e.vectors[i][k]); };
  Quad* const p[] = {&product.xx, &product.xy, &product.xz, &product.yy, &product.yz, &product.zz};
  Quad* const g[] = {&gram.xx, &gram.xy, &gram.xz, &gram.yy, &gram.yz, &gram.zz};
  const int row[] = {0, 0, 0, 1, 1, 2}, column[] = {0, 1, 2, 1, 2, 2};
  for (int n = 0; n < 6; ++n)
    for (int k = 0; k < 3; ++k) {
      *p[n] += to_quad(e.values[k]) * v(row[n], k) * v(column[n], k);
      *g[n] += v(k, row[n]) * v(k, column[n]);
    }
  const Quad of_matrix = quad_distance(product, original) / quad_frobenius(original);
  return static_cast<double>(std::max(of_matrix, quad_distance(gram, {1, 0, 0, 1, 0, 1})));
}

template <class T>
Sym3<T> by(void (*function)(const std::type_identity_t<T>*, std::type_identity_t<T>*), const Sym3<T>& s) {
  Sym3<T> out;
  function(&s.xx, &out.xx);
  return out;
}

template <class T>
constexpr double bound = sizeof(T) == 8 ? 24 : 1.5;

template <class T>
void check(const Sym3<T>& s) {
  CHECK(error_in_u(by(sym3::log_by_jacobi, s), quad_log(to_quad(s))) <= bound<T>);
  CHECK(error_in_u(by(sym3::inv_sqrt_by_jacobi, s), quad_inv_sqrt(to_quad(s))) <= bound<T>);
  CHECK(error_in_u(by(sym3::sqrt_by_jacobi, s), quad_function(to_quad(s), sqrtq)) <= bound<T>);
}

}  // namespace

TEST_CASE("double_double_operations_keep_104_bits") {
  Random random(71);
  for (int i = 0; i < 5000; ++i) {
    const DoubleDouble a = random_number(random), b = random_number(random);
    const Quad x = to_quad(a), y = to_quad(b);
    CHECK(relative(to_quad(a + b), x + y) < 0x1p-103);
    CHECK(relative(to_quad(a - b), x - y) < 0x1p-103);
    CHECK(relative(to_quad(a * b), x * y) < 0x1p-102);
    CHECK(relative(to_quad(a / b), x / y) < 0x1p-101);
    CHECK(relative(to_quad(sqrt(a * a)), fabsq(x)) < 0x1p-100);
  }
}

TEST_CASE("sums_and_products_of_doubles_are_exact") {
  Random random(72);
  for (int i = 0; i < 2000; ++i) {
    const double a = uniform(random, -1, 1), b = uniform(random, -1, 1) * 1e-3;
    CHECK(to_quad(sym3::two_product(a, b)) == Quad(a) * Quad(b));
    CHECK(to_quad(sym3::two_sum(a, b)) == Quad(a) + Quad(b));
  }
}

TEST_CASE("jacobi_decomposes_to_the_precision_of_its_numbers") {
  for (const double spread : {1e-6, 1.0, 1e6})
    for (const auto& s : spreads<double>(spread, -spread / 3, 200)) {
      CHECK(residual<double>(s) < 30 * 0x1p-53);
      CHECK(residual<DoubleDouble>(s) < 40 * 0x1p-104);
    }
  for (const auto& s : triples<double>(1e-9, 100)) CHECK(residual<DoubleDouble>(s) < 40 * 0x1p-104);
}

TEST_CASE("jacobi_keeps_blocks_and_extreme_ratios") {
  const auto e = sym3::eigen_by_jacobi<DoubleDouble>({1e280, 0, 0, 2, 1, 2});
  CHECK(e.vectors[0][0].hi == 1);
  CHECK(e.vectors[0][1].hi == 0);
  CHECK(e.vectors[1][0].hi == 0);
  CHECK(e.values[0].hi == 1e280);
  CHECK(std::min(e.values[1].hi, e.values[2].hi) == 1);
  CHECK(std::max(e.values[1].hi, e.values[2].hi) == 3);
  CHECK(sym3::eigen_by_jacobi<DoubleDouble>({1e280, 1e-100, 0, 1, 0, 1}).values[1].hi == 1);
}

TEST_CASE("exp_by_jacobi_is_exact_to_16_u_at_any_spread") {
  for (const double spread : {0.0, 1e-9, 1.0, 30.0, 700.0, 1300.0})
    for (const auto& s : spreads<double>(spread, -0.6 * spread, 300))
      CHECK(error_in_u(by(sym3::exp_by_jacobi, s), quad_exp(to_quad(s))) <= 16);
}

TEST_CASE("exp_by_jacobi_works_in_place") {
  Sym3<double> s{1, 2, 3, 4, 5, 6};
  const auto copy = by(sym3::exp_by_jacobi, s);
  sym3::exp_by_jacobi(&s.xx, &s.xx);
  CHECK(s == copy);
}

TEST_CASE_TEMPLATE("log_and_roots_by_jacobi_keep_their_bounds_at_every_condition_and_gap", T, double, float) {
  for (const double condition : {1.0001, 1.1, 1.5, 2.0, 4.0, 7.0, 9.0, 12.0, 20.0, 1e2, 1e4, 1e6})
    for (const auto& s : with_condition<T>(condition, 300)) check(s);
}

TEST_CASE("log_and_roots_by_jacobi_keep_their_bounds_up_to_condition_1e15") {
  for (const double condition : {1e8, 1e10, 1e12, 1e14, 1e15})
    for (const auto& s : with_condition<double>(condition, 200)) {
      const auto values = quad_eigen(to_quad(s)).values;
      if (*std::min_element(values.begin(), values.end()) > 0) check(s);
    }
}

TEST_CASE("log_by_jacobi_is_relatively_exact_near_the_identity") {
  Random random(52);
  for (int digits = 1; digits <= 15; ++digits)
    for (const auto& s : near_identity(std::pow(10.0, -digits), 50, random))
      CHECK(error_in_u(by(sym3::log_by_jacobi, s), quad_log(to_quad(s))) <= bound<double>);
}

TEST_CASE("log_by_jacobi_keeps_its_bound_across_the_border_of_near_the_identity") {
  Random random(53);
  for (int i = 0; i < 4000; ++i) {
    const double off = uniform(random, 0.05, 0.3), d = std::pow(10.0, uniform(random, -4, -0.5));
    const auto any = [&random](double size) { return uniform(random, -size, size); };
    const Sym3<double> s = {1 + any(d), off, any(off), 1 + any(d), any(off) * (i % 2), 1 + any(d)};
    CHECK(error_in_u(by(sym3::log_by_jacobi, s), quad_log(to_quad(s))) <= bound<double>);
  }
}

TEST_CASE_TEMPLATE("log_by_jacobi_of_the_identity_is_exactly_zero", T, double, float) {
  CHECK(by(sym3::log_by_jacobi, sym3::identity<T>()) == Sym3<T>{});
  CHECK(by(sym3::inv_sqrt_by_jacobi, sym3::identity<T>()) == sym3::identity<T>());
}

TEST_CASE_TEMPLATE("by_jacobi_matrices_that_are_not_positive_definite_give_six_nan", T, double, float) {
  const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
  for (const auto& s :
       {Sym3<T>{}, diagonal(T(1), T(1), T(0)), diagonal(T(1), T(-1), T(2)), Sym3<T>{1, 2, 0, 1, 0, 1},
        Sym3<T>{1, 1, 1, 1, 1, 1}, diagonal(T(1), nan, T(1)), diagonal(inf, T(1), T(1))}) {
    CHECK(all_nan(by(sym3::log_by_jacobi, s)));
    CHECK(all_nan(by(sym3::inv_sqrt_by_jacobi, s)));
  }
}

TEST_CASE("very_large_and_very_small_matrices_keep_the_bounds") {
  for (const double size : {1e-290, 1e-160, 1e160, 1e290})
    for (const double condition : {3.0, 1e6})
      for (const auto& s : with_condition<double>(condition, 50, size)) check(s);
  CHECK(by(sym3::inv_sqrt_by_jacobi, diagonal(1e300, 1.0, 1e-300)).zz ==
        doctest::Approx(1e150).epsilon(1e-15));
}

TEST_CASE_TEMPLATE("logs_and_roots_are_numbers_where_eigenvalues_are_past_the_largest", T, double, float) {
  const T x = std::numeric_limits<T>::max() / T(1.06), more = T(8 * std::log(2.0));
  for (const auto& s : {Sym3<T>{x, x / 2, 0, x, 0, x}, Sym3<T>{x, x / 3, x / 5, x, x / 4, x}}) {
    const Sym3<T> less = sym3::times(s, std::exp2(T(-8)));
    const auto same = [](const Sym3<T>& a, const Sym3<T>& b, T factor, T shift) {
      for (int k = 0; k < 6; ++k) {
        const T expected = factor * (&b.xx)[k] + (k == 0 || k == 3 || k == 5 ? shift : T(0));
        CHECK((&a.xx)[k] == doctest::Approx(expected).epsilon(1e-5));
      }
    };
    same(sym3::log(s), sym3::log(less), 1, more);
    same(sym3::log_qr(s), sym3::log_qr(less), 1, more);
    same(sym3::sqrt(s), sym3::sqrt(less), 16, 0);
    same(sym3::inv_sqrt(s), sym3::inv_sqrt(less), T(0.0625), 0);
    same(sym3::pow(s, 0.25), sym3::pow(less, 0.25), 4, 0);
  }
  const Sym3<T> ones{x, x, x, x, x, x};
  CHECK(sym3::sqrt(ones).xy == doctest::Approx(std::sqrt(x) / std::sqrt(3.0)).epsilon(1e-5));
}

TEST_CASE("logs_by_qr_of_subnormal_matrices_are_those_by_jacobi") {
  const Sym3<double> s{1e-310, 2e-311, 0, 1e-310, 0, 3e-310};
  const auto a = sym3::log_qr(s), b = sym3::log(s);
  CHECK(a.xx == doctest::Approx(b.xx).epsilon(1e-9));
  CHECK(a.xy == doctest::Approx(b.xy).epsilon(1e-6));
  CHECK(a.zz == doctest::Approx(b.zz).epsilon(1e-9));
  CHECK(std::isnan(sym3::log_qr(Sym3<double>{0, 0, 0, 1, 0, 1}).zz));
}
