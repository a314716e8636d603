// The kernels' fallback for log and roots, called directly: accurate at any condition number and gap.
#include "sym3/fallback.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sym3/entries_of.h"
#include "sym3/log.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"
#include "sym3/small_matrices.h"
#include "sym3/with_condition.h"

namespace {

template <class T>
constexpr double bound = sizeof(T) == 8 ? 24 : 1.5;

template <class T>
Sym3<T> by(void (*function)(const T*, T*), const Sym3<T>& s) {
  Sym3<T> out;
  function(&s.xx, &out.xx);
  return out;
}

template <class T>
Sym3<T> jacobi_log(const Sym3<T>& s) {
  return by<T>(sym3::log_by_jacobi, s);
}

template <class T>
Sym3<T> jacobi_sqrt(const Sym3<T>& s) {
  return by<T>(sym3::sqrt_by_jacobi, s);
}

template <class T>
Sym3<T> jacobi_inv_sqrt(const Sym3<T>& s) {
  return by<T>(sym3::inv_sqrt_by_jacobi, s);
}

template <class T>
void check(const Sym3<T>& s) {
  CHECK(error_in_u(jacobi_log(s), quad_log(to_quad(s))) <= bound<T>);
  CHECK(error_in_u(jacobi_inv_sqrt(s), quad_inv_sqrt(to_quad(s))) <= bound<T>);
  CHECK(error_in_u(jacobi_sqrt(s), quad_function(to_quad(s), sqrtq)) <= bound<T>);
}

}  // namespace

TEST_CASE_TEMPLATE("log_and_roots_by_jacobi_keep_their_bounds_at_every_condition_and_gap", T, double, float) {
  for (const double condition : {1.0001, 1.1, 1.5, 2.0, 4.0, 7.0, 9.0, 12.0, 20.0, 1e2, 1e4, 1e6}) {
    for (const auto& s : with_condition<T>(condition, 300)) check(s);
  }
}

TEST_CASE("log_and_roots_by_jacobi_keep_their_bounds_up_to_condition_1e15") {
  for (const double condition : {1e8, 1e10, 1e12, 1e14, 1e15}) {
    for (const auto& s : with_condition<double>(condition, 200)) {
      const auto values = quad_eigen(to_quad(s)).values;
      if (*std::min_element(values.begin(), values.end()) > 0) check(s);
    }
  }
}

TEST_CASE("log_by_jacobi_is_relatively_exact_near_the_identity") {
  for (int digits = 1; digits <= 15; ++digits) {
    Random random(52);
    for (int i = 0; i < 50; ++i) {
      const double size = std::pow(10.0, -digits);
      Sym3<double> s = with_eigenvalues<double>({size, uniform(random, -size, size), -size}, random);
      s.xx += 1, s.yy += 1, s.zz += 1;
      CHECK(error_in_u(jacobi_log(s), quad_log(to_quad(s))) <= bound<double>);
    }
  }
}

TEST_CASE("log_by_jacobi_keeps_its_bound_across_the_border_of_near_the_identity") {
  Random random(53);
  for (int i = 0; i < 4000; ++i) {
    const double off = uniform(random, 0.05, 0.3), d = std::pow(10.0, uniform(random, -4, -0.5));
    const auto any = [&random](double size) { return uniform(random, -size, size); };
    const Sym3<double> s = {1 + any(d), off, any(off), 1 + any(d), any(off) * (i % 2), 1 + any(d)};
    CHECK(error_in_u(jacobi_log(s), quad_log(to_quad(s))) <= bound<double>);
  }
}

TEST_CASE_TEMPLATE("log_by_jacobi_of_the_identity_is_exactly_zero", T, double, float) {
  CHECK(jacobi_log(sym3::identity<T>()) == Sym3<T>{});
  CHECK(jacobi_inv_sqrt(sym3::identity<T>()) == sym3::identity<T>());
}

TEST_CASE_TEMPLATE("by_jacobi_matrices_that_are_not_positive_definite_give_six_nan", T, double, float) {
  const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
  for (const auto& s :
       {Sym3<T>{}, diagonal(T(1), T(1), T(0)), diagonal(T(1), T(-1), T(2)), Sym3<T>{1, 2, 0, 1, 0, 1},
        Sym3<T>{1, 1, 1, 1, 1, 1}, diagonal(T(1), nan, T(1)), diagonal(inf, T(1), T(1))}) {
    CHECK(all_nan(jacobi_log(s)));
    CHECK(all_nan(jacobi_inv_sqrt(s)));
  }
}

TEST_CASE("very_large_and_very_small_matrices_keep_the_bounds") {
  for (const double size : {1e-290, 1e-160, 1e160, 1e290}) {
    for (const double condition : {3.0, 1e6}) {
      for (const auto& s : with_condition<double>(condition, 50, size)) check(s);
    }
  }
  CHECK(jacobi_inv_sqrt(diagonal(1e300, 1.0, 1e-300)).zz == doctest::Approx(1e150).epsilon(1e-15));
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
