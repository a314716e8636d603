// log, roots and powers of every kernel: error bounds, and equal bits for single matrices and batches.
#include "sym3/log.h"

#include <limits>
#include <utility>

#include "sym3/arranged.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"
#include "sym3/with_condition.h"

namespace {

enum class Which { log, sqrt, inv_sqrt, pow };
constexpr Which all[] = {Which::log, Which::sqrt, Which::inv_sqrt, Which::pow};
constexpr double power = -1.7;

template <class T>
void run(Which which, sym3::SymView<const T> in, sym3::SymView<T> out, std::size_t count,
         const sym3::Batch& batch) {
  if (which == Which::log) return sym3::log(in, out, count, batch);
  if (which == Which::sqrt) return sym3::sqrt(in, out, count, batch);
  if (which == Which::inv_sqrt) return sym3::inv_sqrt(in, out, count, batch);
  sym3::pow(in, power, out, count, batch);
}

template <class T>
Sym3<T> one(Which which, const sym3::Kernel& kernel, const Sym3<T>& s) {
  const auto& f = sym3::functions<T>(kernel);
  Sym3<T> out;
  if (which == Which::log) f.log->one(&s.xx, &out.xx);
  if (which == Which::sqrt) f.sqrt->one(&s.xx, &out.xx);
  if (which == Which::inv_sqrt) f.inv_sqrt->one(&s.xx, &out.xx);
  if (which == Which::pow) f.pow->one(&s.xx, &out.xx, power);
  return out;
}

QuadSym exact(Which which, const QuadSym& s) {
  if (which == Which::log) return quad_log(s);
  if (which == Which::sqrt) return quad_function(s, sqrtq);
  if (which == Which::inv_sqrt) return quad_inv_sqrt(s);
  return quad_function(s, [](Quad x) { return expq(Quad(power) * logq(x)); });
}

double pow_bound(double p, double k, double size) {
  return 8 * (std::fabs(p) * k + 1 + std::fabs(p) * size);
}

/// Returns the bound in log.h for the condition k. `size` is |log S|.
double log_bound(Which which, double k, double size) {
  if (which == Which::log) return 6 * std::max(1.0, k / size);
  if (which == Which::sqrt) return 6 * std::sqrt(k);
  if (which == Which::inv_sqrt) return 8 * k;
  return pow_bound(power, k, size);
}

template <class T>
void check_bounds(double condition) {
  const auto in = with_condition<T>(condition, 60);
  for (const Which which : all) {
    std::vector<QuadSym> truth;
    for (const auto& s : in) truth.push_back(exact(which, to_quad(s)));
    for (const auto& kernel : sym3::kernels()) {
      std::vector<Sym3<T>> out(in.size());
      run<T>(which, sym3::packed(in.data()), sym3::packed(out.data()), in.size(), {&kernel});
      for (std::size_t i = 0; i < in.size(); ++i) {
        const auto values = quad_eigen(to_quad(in[i])).values;
        const auto [low, high] = std::minmax({values[0], values[1], values[2]});
        if (!(low > 0)) continue;
        const double size = static_cast<double>(quad_frobenius(quad_log(to_quad(in[i]))));
        CAPTURE(int(which));
        CAPTURE(kernel.name);
        CAPTURE(condition);
        CHECK(error_in_u(out[i], truth[i]) <= log_bound(which, static_cast<double>(high / low), size));
      }
    }
  }
}

}  // namespace

TEST_CASE_TEMPLATE("functions_of_a_batch_keep_their_bounds_at_every_condition_and_gap", T, double, float) {
  for (const double condition : {1 + 1e-9, 1.0001, 1.1, 2.0, 4.0, 10.0, 100.0, 3e3})
    check_bounds<T>(condition);
}

TEST_CASE("functions_of_a_batch_keep_their_bounds_up_to_condition_1e12_in_double") {
  for (const double condition : {1e5, 1e7, 1e9, 1e11, 1e12}) check_bounds<double>(condition);
}

TEST_CASE_TEMPLATE("powers_from_minus_100_to_100_keep_their_bound_at_every_condition_gap_and_size", T, double,
                   float) {
  constexpr double range = sizeof(T) == 8 ? 690 : 80, most_digits = sizeof(T) == 8 ? 15 : 6;
  Random random(57);
  const double exponents[] = {-100, -99.5, -40, -10, -5,  -2.5, -1, -0.3, -1e-3,
                              1e-3, 0.3,   1,   2,   3.5, 10,   64, 100};
  for (const double p : exponents) {
    const double digits = std::min(most_digits, range / std::fabs(p) / std::log(10));  // S^p in range
    for (int i = 0; i < 150; ++i) {
      const double k = 1 + std::pow(10.0, uniform(random, -12, digits)) * (i % 3 ? 1 : 1e-3);
      const double near = (k - 1) * std::pow(10.0, uniform(random, -16, -1));
      const double middle[] = {1, k, 1 + near, k - near, std::sqrt(k)};
      const double size = std::pow(10.0, i % 2 ? uniform(random, -digits, digits) : 0);
      const auto s = with_eigenvalues<T>({size / k, size / k * middle[i % 5], size}, random);
      const QuadEigen e = quad_eigen(to_quad(s));
      const auto [low, high] = std::ranges::minmax(e.values);
      if (!(low > 0) || fabsq(p * logq(low)) > range || fabsq(p * logq(high)) > range) continue;
      const QuadSym truth = quad_function(to_quad(s), [&](Quad x) { return expq(Quad(p) * logq(x)); });
      const double log_norm = static_cast<double>(quad_frobenius(quad_log(to_quad(s))));
      CAPTURE(p);
      CAPTURE(k);
      CAPTURE(size);
      for (const auto& kernel : sym3::kernels()) {
        Sym3<T> out;
        sym3::functions<T>(kernel).pow->one(&s.xx, &out.xx, p);
        CHECK(error_in_u(out, truth) <= pow_bound(p, static_cast<double>(high / low), log_norm));
      }
    }
  }
}

TEST_CASE("log_of_a_batch_is_relatively_exact_near_the_identity") {
  Random random(55);
  for (int digits = 1; digits <= 15; ++digits) {
    const auto in = near_identity(std::pow(10.0, -digits), 40, random);
    std::vector<Sym3<double>> out(40);
    sym3::log(sym3::packed(in.data()), sym3::packed(out.data()), in.size());
    for (int i = 0; i < 40; ++i) CHECK(error_in_u(out[i], quad_log(to_quad(in[i]))) <= 12);
  }
}

TEST_CASE_TEMPLATE("beyond_the_range_of_the_kernels_a_batch_has_the_answers_by_jacobi", T, double, float) {
  const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
  const T big = std::numeric_limits<T>::max() / 4, small = std::numeric_limits<T>::min() * 4;
  const std::vector<Sym3<T>> in = {{},
                                   diagonal(T(1), T(1), T(0)),
                                   diagonal(T(1), T(-1), T(2)),
                                   diagonal(T(1), nan, T(1)),
                                   diagonal(inf, T(1), T(1)),
                                   diagonal(big, T(1), T(1)),
                                   diagonal(big, big / 2, big / 3),
                                   diagonal(small, 2 * small, 3 * small),
                                   {1, 2, 0, 1, 0, 1},
                                   {2, 0, 0, nan, 0, 1}};
  const std::pair<Which, void (*)(const T*, T*)> by_jacobi[] = {{Which::log, sym3::log_by_jacobi},
                                                                {Which::sqrt, sym3::sqrt_by_jacobi},
                                                                {Which::inv_sqrt, sym3::inv_sqrt_by_jacobi}};
  for (const auto& [which, function] : by_jacobi)
    for (const auto& kernel : sym3::kernels()) {
      std::vector<Sym3<T>> out(in.size());
      run<T>(which, sym3::packed(in.data()), sym3::packed(out.data()), in.size(), {&kernel});
      for (std::size_t i = 0; i < in.size(); ++i) {
        CAPTURE(i);
        CAPTURE(int(which));
        Sym3<T> expected;
        function(&in[i].xx, &expected.xx);
        CHECK(same_or_nan<T>(out[i], expected));
      }
    }
}

TEST_CASE_TEMPLATE("one_matrix_and_a_batch_in_every_layout_and_length_get_the_same_bits_of_functions", T,
                   double, float) {
  auto in = with_condition<T>(20, 80);
  in[17] = {};
  in[40] = diagonal(T(1), T(2), T(-3));
  in[55] = diagonal(T(1e-3), T(1), std::numeric_limits<T>::max());
  for (const Which which : all)
    for (const auto& kernel : sym3::kernels()) {
      std::vector<Sym3<T>> expected;
      for (const auto& s : in) expected.push_back(one(which, kernel, s));
      CAPTURE(kernel.name);
      CAPTURE(int(which));
      check_every_batch<T>(in, expected, [&](const auto& from, const auto& to, std::size_t count) {
        run<T>(which, from, to, count, {&kernel});
      });
    }
}

TEST_CASE_TEMPLATE("the_single_call_is_that_of_the_running_kernel_of_functions", T, double, float) {
  for (const auto& s : with_condition<T>(50, 30)) {
    CHECK(sym3::log(s) == one(Which::log, sym3::kernel(), s));
    CHECK(sym3::sqrt(s) == one(Which::sqrt, sym3::kernel(), s));
    CHECK(sym3::inv_sqrt(s) == one(Which::inv_sqrt, sym3::kernel(), s));
    CHECK(sym3::pow(s, power) == one(Which::pow, sym3::kernel(), s));
  }
}

TEST_CASE_TEMPLATE("log_of_the_identity_is_exactly_zero_by_every_kernel", T, double, float) {
  for (const auto& kernel : sym3::kernels()) {
    CHECK(one(Which::log, kernel, sym3::identity<T>()) == Sym3<T>{});
    CHECK(one(Which::inv_sqrt, kernel, sym3::identity<T>()) == sym3::identity<T>());
  }
}

TEST_CASE_TEMPLATE("log_by_qr_is_as_exact_as_the_condition_lets_it", T, double, float) {
  for (const double condition : {1.5, 10.0, 1e3})
    for (const auto& s : with_condition<T>(condition, 100)) {
      const auto exact = quad_log(to_quad(s));
      const double size = static_cast<double>(quad_frobenius(exact));
      CHECK(error_in_u(sym3::log_qr(s), exact) <= 24 * std::max(1.0, condition / size));
    }
}

TEST_CASE_TEMPLATE("sqrt_takes_semi_definite_matrices", T, double, float) {
  CHECK(sym3::sqrt(Sym3<T>{}) == Sym3<T>{});
  CHECK(sym3::sqrt(diagonal(T(4), T(0), T(9))) == diagonal(T(2), T(0), T(3)));
  Random random(56);
  for (int i = 0; i < 200; ++i) {
    const T x = T(uniform(random, -1, 1)), y = T(uniform(random, -1, 1)), z = T(uniform(random, -1, 1));
    const auto root = sym3::sqrt(Sym3<T>{x * x, x * y, x * z, y * y, y * z, z * z});
    CHECK(none_nan(root));
    CHECK(root.xx == doctest::Approx(x * x / std::sqrt(x * x + y * y + z * z)).epsilon(1e-3));
  }
  CHECK(all_nan(sym3::sqrt(diagonal(T(1), T(-1e-3), T(1)))));
}
