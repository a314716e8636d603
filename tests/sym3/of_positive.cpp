// The batched log, roots and powers: their bars by condition, for every kernel, and that a batch is one
// function.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "sym3/ensembles.h"
#include "sym3/entries_of.h"
#include "sym3/kernel.h"
#include "sym3/log.h"
#include "sym3/quad_reference.h"

using namespace viete;
using namespace viete::sym3::ensembles;
using namespace viete::test;
using sym3::Sym3;

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
Sym3<T> one(Which which, const Sym3<T>& s) {
  if (which == Which::log) return sym3::log(s);
  if (which == Which::sqrt) return sym3::sqrt(s);
  if (which == Which::inv_sqrt) return sym3::inv_sqrt(s);
  return sym3::pow(s, power);
}

QuadSym exact(Which which, const QuadSym& s) {
  if (which == Which::log) return quad_log(s);
  if (which == Which::sqrt) return quad_function(s, sqrtq);
  if (which == Which::inv_sqrt) return quad_inv_sqrt(s);
  return quad_function(s, [](Quad x) { return expq(Quad(power) * logq(x)); });
}

/// The promise of log.h for condition k and |log S| = size.
double bar(Which which, double k, double size) {
  if (which == Which::log) return 6 * std::max(1.0, k / size);
  if (which == Which::sqrt) return 6 * std::sqrt(k);
  if (which == Which::inv_sqrt) return 6 * k;
  return 10 * (k + 1 + std::fabs(power) * size);
}

template <class T>
std::vector<Sym3<T>> with_condition(double condition, int count) {
  Random random(54);
  std::vector<Sym3<T>> all;
  for (int i = 0; i < count; ++i) {
    const double near = (condition - 1) * std::pow(10.0, uniform(random, -16, -1));
    const double middle[] = {1, condition, 1 + near, condition - near, std::sqrt(condition)};
    const double size = i % 2 ? 1 : std::pow(10.0, uniform(random, -3, 3));
    all.push_back(with_eigenvalues<T>({size, size * middle[i % 5], size * condition}, random));
  }
  return all;
}

template <class T>
void check_bars(double condition) {
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
        CHECK(error_in_u(out[i], truth[i]) <= bar(which, static_cast<double>(high / low), size));
      }
    }
  }
}

template <class T>
bool same_or_both_nan(const Sym3<T>& a, const Sym3<T>& b) {
  return a == b || (all_nan(a) && all_nan(b));
}

}  // namespace

TEST_CASE_TEMPLATE("functions_of_a_batch_keep_their_bars_at_every_condition_and_gap", T, double, float) {
  for (const double condition : {1 + 1e-9, 1.0001, 1.1, 2.0, 4.0, 10.0, 100.0, 3e3}) check_bars<T>(condition);
}

TEST_CASE("functions_of_a_batch_keep_their_bars_up_to_condition_1e12_in_double") {
  for (const double condition : {1e5, 1e7, 1e9, 1e11, 1e12}) check_bars<double>(condition);
}

TEST_CASE("log_of_a_batch_is_relatively_exact_near_the_identity") {
  Random random(55);
  for (int digits = 1; digits <= 15; ++digits) {
    const double size = std::pow(10.0, -digits);
    std::vector<Sym3<double>> in, out(40);
    for (int i = 0; i < 40; ++i) {
      in.push_back(with_eigenvalues<double>({size, uniform(random, -size, size), -size}, random));
      in[i].xx += 1, in[i].yy += 1, in[i].zz += 1;
    }
    sym3::log(sym3::packed(in.data()), sym3::packed(out.data()), in.size());
    for (int i = 0; i < 40; ++i) CHECK(error_in_u(out[i], quad_log(to_quad(in[i]))) <= 12);
  }
}

TEST_CASE_TEMPLATE("beyond_the_range_of_the_kernels_a_batch_has_the_single_answers", T, double, float) {
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
  for (const Which which : all) {
    for (const auto& kernel : sym3::kernels()) {
      std::vector<Sym3<T>> out(in.size());
      run<T>(which, sym3::packed(in.data()), sym3::packed(out.data()), in.size(), {&kernel});
      for (std::size_t i = 0; i < in.size(); ++i) {
        CAPTURE(i);
        CAPTURE(int(which));
        if (which != Which::pow) CHECK(same_or_both_nan(out[i], one(which, in[i])));
        if (which == Which::pow) CHECK(all_nan(out[i]) == all_nan(one(which, in[i])));
      }
    }
  }
}

TEST_CASE_TEMPLATE("every_length_of_a_batch_of_functions_gives_the_bits_of_one", T, double, float) {
  auto in = with_condition<T>(20, 80);
  in[17] = {}, in[40] = diagonal(T(1), T(2), T(-3));
  for (const Which which : all) {
    for (const auto& kernel : sym3::kernels()) {
      std::vector<Sym3<T>> expected(in.size());
      for (std::size_t i = 0; i < in.size(); ++i) {
        run<T>(which, sym3::packed(&in[i]), sym3::packed(&expected[i]), 1, {&kernel});
      }
      for (std::size_t count = 0; count <= in.size(); count += count < 40 ? 1 : 8) {
        const std::size_t stride = 83;
        std::vector<T> planes(6 * stride, T(-9)), out(6 * stride, T(-9));
        for (std::size_t i = 0; i < in.size(); ++i) {
          for (int k = 0; k < 6; ++k) planes[k * stride + i] = entries_of(in[i])[k];
        }
        run<T>(which, sym3::SymView<const T>(planes.data(), stride), sym3::SymView<T>(out.data(), stride),
               count, {&kernel});
        bool same = true;
        for (std::size_t i = 0; i < count; ++i) {
          same = same && same_or_both_nan(Sym3<T>{out[i], out[stride + i], out[2 * stride + i], out[3 * stride + i],
                                           out[4 * stride + i], out[5 * stride + i]},
                                   expected[i]);
        }
        CHECK(same);
        CHECK(out[count] == T(-9));
      }
    }
  }
}

TEST_CASE_TEMPLATE("the_single_root_and_power_keep_their_bars", T, double, float) {
  for (const double condition : {1.0001, 3.0, 30.0, 1e4, 1e6}) {
    for (const auto& s : with_condition<T>(condition, 50)) {
      CHECK(error_in_u(sym3::sqrt(s), exact(Which::sqrt, to_quad(s))) <= (sizeof(T) == 8 ? 24 : 1.5));
      CHECK(error_in_u(sym3::pow(s, power), exact(Which::pow, to_quad(s))) <= (sizeof(T) == 8 ? 26 : 1.5));
    }
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
