// Tests the error bounds of derivatives with every kernel. Batches in any layout must equal single calls.
#include "sym3/derivative.h"

#include <limits>
#include <string>

#include "sym3/arranged.h"
#include "sym3/log.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"
#include "sym3/with_condition.h"

using sym3::Of;

namespace {

constexpr Of every_function[] = {Of::exp, Of::log, Of::sqrt, Of::pow};
constexpr double exponent = -1.7;

template <class T>
void derive(Of f, const sym3::SymView<const T>& s, sym3::Directions<T> directions, sym3::Derivatives<T> out,
            std::size_t count, const sym3::Batch& batch, double p = exponent) {
  if (f == Of::exp) return sym3::exp_derivative(s, directions, out, count, batch);
  if (f == Of::log) return sym3::log_derivative(s, directions, out, count, batch);
  if (f == Of::sqrt) return sym3::sqrt_derivative(s, directions, out, count, batch);
  sym3::pow_derivative(s, p, directions, out, count, batch);
}

template <class T>
Sym3<T> derived(Of f, const sym3::Kernel& kernel, const Sym3<T>& s, const Sym3<T>& direction,
                double p = exponent) {
  Sym3<T> out;
  sym3::functions<T>(kernel).derivative->one(&s.xx, &direction.xx, &out.xx, f, p);
  return out;
}

template <class T>
sym3::Tangent<T> tangent_of(Of f, const sym3::Kernel& kernel, const Sym3<T>& s, double p = exponent) {
  sym3::Tangent<T> out;
  sym3::functions<T>(kernel).tangent->one(&s.xx, &out[0].xx, f, p);
  return out;
}

template <class T>
Sym3<T> random_direction(Random& random, double size = 1) {
  Sym3<T> e;
  for (T* x : {&e.xx, &e.xy, &e.xz, &e.yy, &e.yz, &e.zz}) *x = T(uniform(random, -size, size));
  return e;
}

/// Returns a direction: a random matrix, a matrix with one nonzero number, S, or the identity.
template <class T>
Sym3<T> some_direction(Random& random, const Sym3<T>& s, std::size_t i) {
  if (i % 8 == 6 && s != Sym3<T>{}) return s;
  if (i % 8 == 7) return sym3::identity<T>();
  Sym3<T> e = i % 8 < 3 ? Sym3<T>{} : random_direction<T>(random);
  if (i % 8 < 3) (&e.xx)[random() % 6] = 1;
  return e;
}

struct OfMatrix {
  const sym3::Kernel& kernel;
  double condition, log_norm;
};

OfMatrix of_matrix(const sym3::Kernel& kernel, const std::array<Quad, 3>& values) {
  const auto [low, high] = std::minmax({values[0], values[1], values[2]});
  double squares = 0;
  for (const Quad x : values) squares += x > 0 ? std::pow(std::log(static_cast<double>(x)), 2) : 0;
  return {kernel, static_cast<double>(high / low), std::sqrt(squares)};
}

/// Checks for all kernels that the error for each matrix is within its bound.
template <class T, class Allowed>
void check_derivatives(Of f, const std::string& what, const std::vector<Sym3<T>>& matrices,
                       const Allowed& allowed, double p = exponent) {
  Random random(71);
  std::vector<double> worst(sym3::kernels().size(), 0);
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const auto e = some_direction(random, matrices[i], i);
    const auto values = quad_eigen(to_quad(matrices[i])).values;
    if (f != Of::exp && std::min({values[0], values[1], values[2]}) <= 0)
      continue;  // rounding made S indefinite
    const auto exact = quad_derivative(f, p, to_quad(matrices[i]), to_quad(e));
    for (std::size_t k = 0; k < worst.size(); ++k) {
      const auto& kernel = sym3::kernels()[k];
      const double error = derivative_error(derived(f, kernel, matrices[i], e, p), exact, to_quad(e)) /
                           allowed(of_matrix(kernel, values));
      worst[k] = std::max(worst[k], std::isnan(error) ? INFINITY : error);
    }
  }
  for (std::size_t k = 0; k < worst.size(); ++k) {
    const auto name = sym3::kernels()[k].name;
    CAPTURE(name);
    CAPTURE(what);
    CHECK(worst[k] <= 1);
  }
}

template <class T>
void check_spread_of_derivatives(double spread, double lowest) {
  const auto what = "spread " + std::to_string(spread) + " from " + std::to_string(lowest);
  check_derivatives(Of::exp, what, spreads<T>(spread, lowest, 240),
                    [=](const OfMatrix& s) { return s.kernel.fused ? 6 + 2 * spread : 8 + 2.5 * spread; });
}

/// Returns the bound in derivative.h: for log and sqrt if p is 0, otherwise for powers.
double allowed_for_power(double p, const OfMatrix& s) {
  if (p == 0) return 16 + 2 * s.condition;
  return 16 + 4 * ((1 + std::fabs(p)) * s.condition + std::fabs(p) * s.log_norm);
}

template <class T>
std::vector<Sym3<T>> matrices_of_all_kinds(std::size_t count) {
  auto all = with_condition<T>(6, static_cast<int>(count));
  const auto wide = with_condition<T>(40, static_cast<int>(count));
  for (std::size_t i = 3; i < count; i += 7) all[i] = wide[i];
  for (std::size_t i = 5; i < count; i += 17) all[i] = diagonal(T(1), T(2), T(-3));
  for (std::size_t i = 8; i < count; i += 23) all[i] = diagonal(T(1e-30), T(1), T(1000));
  for (std::size_t i = 11; i < count; i += 29) all[i].xy = std::numeric_limits<T>::quiet_NaN();
  return all;
}

/// Checks three directions at once, in all layouts.
template <class T>
struct DerivativeCase {
  Of f;
  const sym3::Kernel& kernel;
  const std::vector<Sym3<T>>& matrices;
  std::vector<std::vector<Sym3<T>>> directions{3}, expected{3};

  DerivativeCase(Of f, const sym3::Kernel& kernel, const std::vector<Sym3<T>>& matrices)
      : f(f), kernel(kernel), matrices(matrices) {
    Random random(78);
    for (int k = 0; k < 3; ++k)
      for (const auto& s : matrices) {
        directions[k].push_back(random_direction<T>(random));
        expected[k].push_back(derived(f, kernel, s, directions[k].back()));
      }
  }

  bool gives_the_bits(sym3::Layout from, sym3::Layout to, std::size_t count, bool in_place) const {
    Arranged<T> s(from, matrices, count);
    std::vector<Arranged<T>> in, out;
    std::vector<sym3::SymView<const T>> reads;
    std::vector<sym3::SymView<T>> writes;
    for (int k = 0; k < 3; ++k) {
      in.emplace_back(to, directions[k], count);
      out.emplace_back(to, count);
    }
    for (int k = 0; k < 3; ++k) {
      reads.push_back(in[k].view());
      writes.push_back(in_place ? in[k].view() : out[k].view());
    }
    derive<T>(f, s.view(), reads, writes, count, {&kernel});
    bool same = in_place || out[2].holds(count);
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < count; ++i)
        same = same && same_or_nan<T>((in_place ? in[k] : out[k]).get(i), expected[k][i]);
    return same;
  }
};

}  // namespace

TEST_CASE("the_reference_of_derivatives_is_the_limit_of_differences") {
  Random random(70);
  const Quad h = scalbnq(1, -36);
  for (const auto& s : paper_ensemble<double>(20)) {
    const auto e = random_direction<double>(random);
    const auto moved = [&](Quad t) -> QuadSym {
      return {s.xx + t * e.xx, s.xy + t * e.xy, s.xz + t * e.xz,
              s.yy + t * e.yy, s.yz + t * e.yz, s.zz + t * e.zz};
    };
    const QuadSym up = quad_exp(moved(h)), down = quad_exp(moved(-h));
    const auto slope = [&](Quad x, Quad y) { return (x - y) / (2 * h); };
    const QuadSym difference = {slope(up.xx, down.xx), slope(up.xy, down.xy), slope(up.xz, down.xz),
                                slope(up.yy, down.yy), slope(up.yz, down.yz), slope(up.zz, down.zz)};
    const auto exact = quad_derivative(Of::exp, 0, to_quad(s), to_quad(e));
    CHECK(static_cast<double>(quad_distance(difference, exact.value) / exact.norm) < 1e-18);
  }
}

TEST_CASE_TEMPLATE("derivatives_of_exp_are_exact_to_8_u_at_any_gap_and_scale", T, double, float) {
  const auto eight = [](const OfMatrix& s) { return s.kernel.fused ? 8 : 12; };
  check_derivatives(Of::exp, "paper", paper_ensemble<T>(2000),
                    [](const OfMatrix& s) { return s.kernel.fused ? 10 : 14; });
  for (int digits = 1; digits <= 16; ++digits) {
    const double gap = std::pow(10.0, -digits);
    check_derivatives(Of::exp, "pair " + std::to_string(digits), pairs<T>(gap, 200), eight);
    check_derivatives(Of::exp, "triple " + std::to_string(digits), triples<T>(gap, 200), eight);
  }
  for (const double size : {3.0, 1.0, 1e-3, 1e-8, 1e-30, 0.0})
    check_derivatives(Of::exp, "spread " + std::to_string(size), spreads<T>(size, -size / 3, 300), eight);
}

TEST_CASE("errors_of_derivatives_of_exp_grow_by_2_u_per_spread_at_any_trace") {
  for_spreads<double>({4.9, 6.0, 10.0, 20.0, 50.0, 100.0, 300.0, 600.0, 900.0, 1300.0},
                      check_spread_of_derivatives<double>);
  for_spreads<float>({4.9, 6.9, 10.0, 20.0, 50.0, 80.0, 110.0, 140.0}, check_spread_of_derivatives<float>);
}

TEST_CASE_TEMPLATE("derivatives_of_log_sqrt_and_pow_keep_their_bounds_at_every_condition_and_gap", T, double,
                   float) {
  for (const double k : {1 + 1e-12, 1 + 1e-9, 1 + 1e-6, 1.0001, 1.1, 2.0, 4.0, 10.0, 100.0, 3e3, 1e5, 1e9}) {
    if (sizeof(T) == 4 && k > 3e3) continue;
    const auto what = "condition " + std::to_string(k);
    for (const Of f : {Of::log, Of::sqrt})
      check_derivatives(f, what, with_condition<T>(k, 150),
                        [](const OfMatrix& s) { return allowed_for_power(0, s); });
    for (const double p : {-100.0, -20.0, -1.7, -0.5, 0.3, 1.0, 2.0, 7.0, 33.0, 80.0}) {
      if (std::fabs(p) * std::log(1e3 * k) > (sizeof(T) == 4 ? 50 : 500)) continue;  // results could overflow
      check_derivatives(
          Of::pow, what + ", power " + std::to_string(p), with_condition<T>(k, 60),
          [=](const OfMatrix& s) { return allowed_for_power(p, s); }, p);
    }
  }
}

TEST_CASE("beyond_the_range_of_the_kernels_derivatives_are_exact_to_16_u") {
  const auto sixteen = [](const OfMatrix&) { return 16; };
  for (const double k : {1e10, 1e11, 1e12})
    for (const Of f : {Of::log, Of::sqrt, Of::pow})
      check_derivatives(f, "condition " + std::to_string(k), with_condition<double>(k, 60), sixteen);
  for (const double size : {1e-150, 1e-90, 1e90, 1e150})
    for (const Of f : {Of::log, Of::sqrt})
      check_derivatives(f, "size " + std::to_string(size), with_condition<double>(3, 60, size), sixteen);
}

TEST_CASE_TEMPLATE("a_tangent_has_the_derivatives_by_each_number_of_the_matrix", T, double, float) {
  Random random(73);
  for (const Of f : every_function)
    for (const auto& kernel : sym3::kernels())
      for (int i = 0; i < 60; ++i) {
        const double spread = i % 5 ? 2 : 12;
        const auto s = with_eigenvalues<T>({1, uniform(random, 1, 1 + spread), 1 + spread}, random);
        const auto tangent = tangent_of(f, kernel, s);
        for (int k = 0; k < 6; ++k) {
          Sym3<T> e;
          (&e.xx)[k] = 1;
          const auto exact = quad_derivative(f, exponent, to_quad(s), to_quad(e));
          const double most =
              f == Of::exp ? 8 + 2.5 * spread : allowed_for_power(exponent, {kernel, 1 + spread, 3});
          CHECK(derivative_error(tangent[k], exact, to_quad(e)) <= most);
        }
      }
}

TEST_CASE_TEMPLATE("derivatives_that_do_not_exist_are_nan", T, double, float) {
  const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
  const Sym3<T> good = {2, 0, T(0.1), 3, 0, 4}, e = {1, 2, 3, 4, 5, 6};
  for (const auto& kernel : sym3::kernels())
    for (const Of f : every_function) {
      for (const T bad : {nan, inf, -inf})
        for (int k = 0; k < 6; ++k) {
          Sym3<T> s = good, direction = e;
          (&s.xx)[k] = bad;
          (&direction.xx)[k] = bad;
          CHECK(all_nan(derived(f, kernel, s, e)));
          CHECK(all_nan(derived(f, kernel, good, direction)));
          for (const auto& row : tangent_of(f, kernel, s)) CHECK(all_nan(row));
        }
      if (f == Of::exp) continue;
      for (const auto& s : {Sym3<T>{}, diagonal(T(1), T(1), T(0)), diagonal(T(1), T(-1), T(2))})
        CHECK(all_nan(derived(f, kernel, s, e)));
    }
}

TEST_CASE_TEMPLATE("derivatives_of_exp_of_finite_numbers_are_never_nan", T, double, float) {
  const T inf = std::numeric_limits<T>::infinity();
  Random random(77);
  for (const auto& kernel : sym3::kernels()) {
    const auto any_direction = random_direction<T>(random);
    CHECK(derived(Of::exp, kernel, Sym3<T>{}, any_direction) == any_direction);
    CHECK(derived(Of::exp, kernel, diagonal(T(710), T(0), T(0)), sym3::identity<T>()) ==
          diagonal(inf, T(1), T(1)));
    CHECK(derived(Of::exp, kernel, diagonal(T(0), T(0), T(-1e30)), sym3::identity<T>()) ==
          diagonal(T(1), T(1), T(0)));
    for (int i = 0; i < 1000; ++i) {
      const auto s = any_finite<T>(random), e = any_finite<T>(random);
      CHECK(none_nan(derived(Of::exp, kernel, s, e)));
      CHECK(none_nan(derived(Of::exp, kernel, {1, 0, T(0.5), 2, 0, 3}, e)));
    }
  }
}

TEST_CASE_TEMPLATE("several_derivatives_of_a_batch_have_the_bits_of_single_calls", T, double, float) {
  const auto in = matrices_of_all_kinds<T>(80);
  for (const Of f : every_function)
    for (const auto& kernel : sym3::kernels()) {
      const DerivativeCase<T> c(f, kernel, in);
      for (const auto from : layouts)
        for (const auto to : {from, sym3::Layout::planes, sym3::Layout::packed})
          for (const std::size_t count : {0, 1, 3, 4, 8, 15, 16, 17, 33, 64, 65, 80}) {
            CAPTURE(kernel.name);
            CAPTURE(int(f));
            CAPTURE(count);
            CHECK(c.gives_the_bits(from, to, count, false));
            CHECK(c.gives_the_bits(from, to, count, true));
          }
    }
}

TEST_CASE_TEMPLATE("derivatives_of_a_batch_may_take_the_place_of_its_matrices", T, double, float) {
  const auto in = matrices_of_all_kinds<T>(150);
  for (const auto& kernel : sym3::kernels()) {
    const DerivativeCase<T> c(Of::sqrt, kernel, in);
    for (const auto layout : layouts) {
      Arranged<T> s(layout, in, in.size()), e(layout, c.directions[0], in.size());
      const sym3::SymView<const T> direction[] = {e.view()};
      const sym3::SymView<T> out[] = {s.view()};
      derive<T>(Of::sqrt, s.view(), direction, out, in.size(), {&kernel});
      for (std::size_t i = 0; i < in.size(); ++i) CHECK(same_or_nan<T>(s.get(i), c.expected[0][i]));
    }
  }
}

TEST_CASE_TEMPLATE("fused_kernels_give_the_same_bits_of_derivatives_and_so_do_the_others", T, double, float) {
  Random random(79);
  for (const Of f : every_function)
    for (const auto& s : matrices_of_all_kinds<T>(200)) {
      const auto e = random_direction<T>(random);
      for (const auto& a : sym3::kernels())
        for (const auto& b : sym3::kernels()) {
          if (a.fused != b.fused) continue;
          CHECK(same_or_nan<T>(derived(f, a, s, e), derived(f, b, s, e)));
          const auto of_a = tangent_of(f, a, s), of_b = tangent_of(f, b, s);
          for (int k = 0; k < 6; ++k) CHECK(same_or_nan<T>(of_a[k], of_b[k]));
        }
    }
}

TEST_CASE_TEMPLATE("tangents_of_a_batch_have_the_bits_of_single_calls_in_every_layout", T, double, float) {
  const auto in = matrices_of_all_kinds<T>(80);
  for (const auto& kernel : sym3::kernels())
    for (const Of f : {Of::exp, Of::log}) {
      CAPTURE(kernel.name);
      std::vector<sym3::Tangent<T>> expected;
      for (const auto& s : in) expected.push_back(tangent_of(f, kernel, s));
      check_every_batch<T>(
          in, expected,
          [&](const sym3::SymView<const T>& from, const sym3::TangentView<T>& to, std::size_t count) {
            if (f == Of::exp) return sym3::exp_tangent(from, to, count, {&kernel});
            sym3::log_tangent(from, to, count, {&kernel});
          });
    }
}

TEST_CASE_TEMPLATE("the_single_derivatives_are_those_of_the_running_kernel_also_on_threads", T, double,
                   float) {
  Random random(80);
  for (const auto& s : with_condition<T>(5, 20)) {
    const auto e = random_direction<T>(random);
    const auto& kernel = sym3::kernel();
    CHECK(sym3::exp_derivative(s, e) == derived(Of::exp, kernel, s, e));
    CHECK(sym3::log_derivative(s, e) == derived(Of::log, kernel, s, e));
    CHECK(sym3::sqrt_derivative(s, e) == derived(Of::sqrt, kernel, s, e));
    CHECK(sym3::pow_derivative(s, exponent, e) == derived(Of::pow, kernel, s, e));
    CHECK(sym3::exp_tangent(s) == tangent_of(Of::exp, kernel, s));
    CHECK(sym3::log_tangent(s) == tangent_of(Of::log, kernel, s));
    CHECK(sym3::sqrt_tangent(s) == tangent_of(Of::sqrt, kernel, s));
    CHECK(sym3::pow_tangent(s, exponent) == tangent_of(Of::pow, kernel, s));
  }
  const auto many = paper_ensemble<T>(20011);
  std::vector<Sym3<T>> alone(many.size()), together(many.size());
  const sym3::SymView<const T> in[] = {sym3::packed(many.data())};
  const sym3::SymView<T> first[] = {sym3::packed(alone.data())}, second[] = {sym3::packed(together.data())};
  const auto backwards = [](void*, std::size_t tasks, void (*task)(void*, std::size_t), void* context) {
    for (std::size_t i = tasks; i-- > 0;) task(context, i);
  };
  const sym3::Executor executor = {backwards, nullptr, 3};
  sym3::exp_derivative(in[0], in, first, many.size());
  sym3::exp_derivative(in[0], in, second, many.size(), {nullptr, &executor});
  CHECK(alone == together);
}
