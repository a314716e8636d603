// What method `fast` answers where there is no ordinary number to answer; every kernel.
#include <limits>

#include "sym3/each_kernel.h"
#include "sym3/entries_of.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

namespace {

template <class T>
constexpr T inf = std::numeric_limits<T>::infinity();

template <class T>
T& entry(Sym3<T>& s, int i) {
  T* const all[] = {&s.xx, &s.xy, &s.xz, &s.yy, &s.yz, &s.zz};
  return *all[i];
}

/// As exp rounds each entry on its own: infinite above the largest number, with the sign of the exact one.
template <class T>
void check_overflow(const sym3::Kernel& kernel, const Sym3<T>& s) {
  const auto computed = entries_of(exp_with(kernel, s));
  const auto exact = entries_of(quad_exp(to_quad(s)));
  const double largest = static_cast<double>(std::numeric_limits<T>::max());
  for (int i = 0; i < 6; ++i) {
    CHECK_FALSE(std::isnan(computed[i]));
    if (fabsq(exact[i]) > 1.001 * Quad(largest)) CHECK(computed[i] == (exact[i] > 0 ? inf<T> : -inf<T>));
    if (fabsq(exact[i]) < 0.999 * Quad(largest)) CHECK(std::isfinite(computed[i]));
  }
}

}  // namespace

TEST_CASE_TEMPLATE("zero_gives_exactly_the_identity", T, double, float) {
  for (const auto& kernel : sym3::kernels()) {
    CHECK(exp_with(kernel, Sym3<T>{}) == sym3::identity<T>());
    CHECK(exp_with(kernel, diagonal(T(-0.0), T(0), T(-0.0))) == sym3::identity<T>());
  }
}

TEST_CASE_TEMPLATE("subnormal_entries_give_the_identity", T, double, float) {
  const T tiny = std::numeric_limits<T>::denorm_min();
  for (const auto& kernel : sym3::kernels()) {
    const auto e = exp_with(kernel, Sym3<T>{tiny, -tiny, tiny, tiny, tiny, -tiny});
    CHECK(e.xx == 1);
    CHECK(e.yy == 1);
    CHECK(e.zz == 1);
    CHECK(std::fabs(e.xy) <= 2 * tiny);
  }
}

TEST_CASE_TEMPLATE("one_nan_or_infinity_anywhere_gives_six_nan", T, double, float) {
  for (const auto& kernel : sym3::kernels()) {
    for (const T bad : {std::numeric_limits<T>::quiet_NaN(), inf<T>, -inf<T>}) {
      for (int i = 0; i < 6; ++i) {
        for (const auto& base : {Sym3<T>{}, Sym3<T>{1, 2, 3, 4, 5, 6}, Sym3<T>{100, 0, 0, -200, 0, 900}}) {
          Sym3<T> s = base;
          entry(s, i) = bad;
          CHECK(all_nan(exp_with(kernel, s)));
        }
      }
    }
  }
}

TEST_CASE("diagonal_overflow_stays_in_its_entry") {
  for (const auto& kernel : sym3::kernels()) {
    CHECK(exp_with(kernel, diagonal(710.0, 0.0, 0.0)) == diagonal(inf<double>, 1.0, 1.0));
    CHECK(exp_with(kernel, diagonal(0.0, 1e300, 0.0)) == diagonal(1.0, inf<double>, 1.0));
    CHECK(exp_with(kernel, diagonal(0.0, 0.0, -1e200)) == diagonal(1.0, 1.0, 0.0));
    CHECK(exp_with(kernel, diagonal(89.0f, 0.0f, 0.0f)) == diagonal(inf<float>, 1.0f, 1.0f));
    CHECK(exp_with(kernel, diagonal(800.0, 800.0, 800.0)) == diagonal(inf<double>, inf<double>, inf<double>));
    CHECK(exp_with(kernel, diagonal(-800.0, -800.0, -800.0)) == Sym3<double>{});
  }
}

TEST_CASE("overflow_in_one_block_leaves_the_other_exact") {
  const double e1 = static_cast<double>(expq(2) * coshq(1)), e2 = static_cast<double>(expq(2) * sinhq(1));
  for (const auto& kernel : sym3::kernels()) {
    for (const double big : {712.0, 1e5, 1e150, 1.7e308}) {
      const auto e = exp_with(kernel, Sym3<double>{big, 0, 0, 2, 1, 2});
      CHECK(e.xx == inf<double>);
      CHECK(e.xy == 0);
      CHECK(e.yy == doctest::Approx(e1).epsilon(1e-14));
      CHECK(e.yz == doctest::Approx(e2).epsilon(1e-14));
    }
  }
}

TEST_CASE("overflow_gives_signed_infinities_and_never_nan") {
  Random random(31);
  for (const auto& kernel : sym3::kernels()) {
    for (int i = 0; i < 300; ++i) {
      const double a = uniform(random, 680, 730), b = uniform(random, -400, 730),
                   c = uniform(random, 600, 730);
      check_overflow(kernel, with_eigenvalues<double>({a, b, c}, random));
      check_overflow(kernel, with_eigenvalues<float>({a / 8, b / 8, c / 8}, random));
    }
  }
}

TEST_CASE("entries_near_the_largest_number_overflow_no_step_on_the_way") {
  const double d = std::numeric_limits<double>::max();
  const float f = std::numeric_limits<float>::max();
  for (const auto& kernel : sym3::kernels()) {
    CHECK(exp_with(kernel, diagonal(d, d, d)) == diagonal(inf<double>, inf<double>, inf<double>));
    CHECK(exp_with(kernel, diagonal(-d, -d, -d)) == Sym3<double>{});
    CHECK(exp_with(kernel, diagonal(d, -d, 1.0)) == diagonal(inf<double>, 0.0, std::exp(1.0)));
    CHECK(exp_with(kernel, diagonal(f, -f, 0.0f)) == diagonal(inf<float>, 0.0f, 1.0f));
    const auto positive = exp_with(kernel, Sym3<double>{d, d, d, d, d, d});
    CHECK(positive ==
          Sym3<double>{inf<double>, inf<double>, inf<double>, inf<double>, inf<double>, inf<double>});
    const auto mixed = exp_with(kernel, Sym3<double>{d, -d, 0, d, 0, d});
    CHECK(none_nan(mixed));
    CHECK(mixed.xy == -inf<double>);
    CHECK(none_nan(exp_with(kernel, Sym3<float>{f, -f, f, f, -f, f})));
  }
}

TEST_CASE("underflow_is_gradual") {
  for (const auto& kernel : sym3::kernels()) {
    for (const double mean : {-707.0, -710.0, -720.0, -740.0, -744.0}) {
      const Sym3<double> s{mean, 0.25, 0, mean, 0, mean};
      const auto exact = entries_of(quad_exp(to_quad(s)));
      const auto computed = entries_of(exp_with(kernel, s));
      for (int i = 0; i < 6; ++i) {
        const double error = std::fabs(static_cast<double>(Quad(computed[i]) - exact[i]));
        CHECK(error <= 0x1p-1074 + 0x1p-50 * static_cast<double>(fabsq(exact[i])));
      }
    }
  }
}

TEST_CASE_TEMPLATE("any_finite_bits_give_no_nan", T, double, float) {
  Random random(32);
  for (int i = 0; i < 4000; ++i) {
    const auto any = [&] {
      const double sign = random() % 2 ? 1 : -1;
      return T(sign * std::exp2(uniform(random, -150, sizeof(T) == 8 ? 1023.9 : 127.9)));
    };
    const Sym3<T> s{any(), any(), any(), any(), any(), any()};
    for (const auto& kernel : sym3::kernels()) CHECK(none_nan(exp_with(kernel, s)));
  }
}
