// Derivatives: their bounds over gap, spread, condition and scale for every kernel, the laws that they obey,
// and that one matrix and many, one direction and several, in any layout, get the same bits.
#include "sym3/derivative.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "sym3/arranged.h"
#include "sym3/call_kernel.h"
#include "sym3/entries_of.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/log.h"
#include "sym3/preamble.h"
#include "sym3/quad_derivative.h"
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

/// What a single call does under that kernel.
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

/// A direction for each matrix: any, of one entry, along S itself, or the identity.
template <class T>
Sym3<T> some_direction(Random& random, const Sym3<T>& s, std::size_t i) {
  if (i % 8 == 6) return s;
  if (i % 8 == 7) return sym3::identity<T>();
  Sym3<T> e = i % 8 < 3 ? Sym3<T>{} : random_direction<T>(random);
  if (i % 8 < 3) (&e.xx)[random() % 6] = 1;
  return e;
}

/// The worst error of each kernel; NaN counts as infinite.
template <class T>
std::vector<double> worst_of_derivatives(Of f, const std::vector<Sym3<T>>& matrices, double p = exponent) {
  Random random(71);
  std::vector<double> worst(sym3::kernels().size(), 0);
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const auto e = some_direction(random, matrices[i], i);
    const auto exact = quad_derivative(f, p, to_quad(matrices[i]), to_quad(e));
    for (std::size_t k = 0; k < worst.size(); ++k) {
      const double error =
          derivative_error(derived(f, sym3::kernels()[k], matrices[i], e, p), exact, to_quad(e));
      worst[k] = std::max(worst[k], std::isnan(error) ? INFINITY : error);
    }
  }
  return worst;
}

template <class T>
void check_derivatives(const std::string& what, const std::vector<Sym3<T>>& matrices, double fused,
                       double plain) {
  const auto worst = worst_of_derivatives(Of::exp, matrices);
  for (std::size_t k = 0; k < worst.size(); ++k) {
    const auto& kernel = sym3::kernels()[k];
    CAPTURE(kernel.name);
    CAPTURE(what);
    CHECK(worst[k] <= (kernel.fused ? fused : plain));
  }
}

template <class T>
bool same_numbers(const Sym3<T>& a, const Sym3<T>& b) {
  return a == b || (all_nan(a) && all_nan(b));
}

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

namespace {

/// What a derivative is right up to, in u of T relative to the norms of the map and of the direction.
template <class T>
double bound_of(Of f, double condition, double size) {
  (void)size;
  return f == Of::exp ? 0 : 8 * condition;
}

template <class T>
double inner(const Sym3<T>& a, const Sym3<T>& b) {
  return double(a.xx) * b.xx + double(a.yy) * b.yy + double(a.zz) * b.zz +
         2 * (double(a.xy) * b.xy + double(a.xz) * b.xz + double(a.yz) * b.yz);
}

template <class T>
double norm(const Sym3<T>& a) {
  return std::sqrt(inner(a, a));
}

}  // namespace

TEST_CASE_TEMPLATE("a_derivative_is_its_own_adjoint", T, double, float) {
  Random random(72);
  for (const Of f : every_function) {
    for (const auto& kernel : sym3::kernels()) {
      for (int i = 0; i < 100; ++i) {
        const auto s = with_eigenvalues<T>({1, uniform(random, 1, 3), uniform(random, 1, 3)}, random);
        const auto e = random_direction<T>(random), g = random_direction<T>(random);
        const double there = inner(g, derived(f, kernel, s, e)), back = inner(e, derived(f, kernel, s, g));
        CHECK(std::fabs(there - back) <= 1000 * unit_roundoff<T> * norm(e) * norm(g));
      }
    }
  }
}

TEST_CASE_TEMPLATE("a_tangent_has_the_derivatives_by_each_number_of_the_matrix", T, double, float) {
  Random random(73);
  for (const Of f : every_function) {
    for (const auto& kernel : sym3::kernels()) {
      for (int i = 0; i < 50; ++i) {
        const double spread = i % 5 ? 2 : 30;
        const auto s = with_eigenvalues<T>({1, uniform(random, 1, 1 + spread), 1 + spread}, random);
        const auto tangent = tangent_of(f, kernel, s);
        for (int k = 0; k < 6; ++k) {
          Sym3<T> e;
          (&e.xx)[k] = 1;
          const auto exact = quad_derivative(f, exponent, to_quad(s), to_quad(e));
          CHECK(derivative_error(tangent[k], exact, to_quad(e)) <= (f == Of::exp ? 12 + 5 * spread : 300));
        }
      }
    }
  }
}

TEST_CASE_TEMPLATE("derivatives_of_log_undo_those_of_exp", T, double, float) {
  Random random(74);
  for (const auto& s : spreads<T>(2, -1, 200)) {
    const auto e = random_direction<T>(random);
    const auto back = sym3::log_derivative(sym3::exp(s), sym3::exp_derivative(s, e));
    CHECK(static_cast<double>(quad_distance(to_quad(back), to_quad(e))) <= 300 * unit_roundoff<T> * norm(e));
  }
}

TEST_CASE_TEMPLATE("derivatives_at_multiples_of_the_identity_are_multiples_of_the_direction", T, double,
                   float) {
  Random random(75);
  for (const auto& kernel : sym3::kernels()) {
    const auto e = random_direction<T>(random);
    CHECK(derived(Of::exp, kernel, Sym3<T>{}, e) == e);
    const auto of_log = derived(Of::log, kernel, sym3::identity<T>(), e);
    CHECK(static_cast<double>(quad_distance(to_quad(of_log), to_quad(e))) <= 8 * unit_roundoff<T>);
  }
}
