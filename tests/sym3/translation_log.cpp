#include "sym3/translation_log.h"

#include <numbers>

#include "sym3/preamble.h"
#include "sym3/small_matrices.h"

using sym3::Mat3, sym3::Vec3, sym3::norm, sym3::plus, sym3::phi_times, sym3::even_part;
using Vector = Vec3<double>;

namespace {

Vector random_vector(Random& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

// Returns phi(M) x. Adds 120 terms of the series in long double.
Vector series(const Mat3<double>& m, const Vector& x) {
  std::array<long double, 3> term{x[0], x[1], x[2]}, sum = term;
  for (int n = 2; n <= 120; ++n) {
    const auto before = term;
    for (int i = 0; i < 3; ++i) {
      term[i] = 0;
      for (int j = 0; j < 3; ++j) term[i] += m[3 * i + j] * before[j] / n;
      sum[i] += term[i];
    }
  }
  return {double(sum[0]), double(sum[1]), double(sum[2])};
}

Mat3<double> random_matrix(Random& random, double size) {
  Mat3<double> m;
  for (double& entry : m) entry = uniform(random, -size, size);
  return m;
}

}  // namespace

TEST_CASE("phi_is_its_series") {
  Random random(3);
  for (const double size : {0.0, 1e-9, 1e-3, 0.2, 1.0, 3.0, 6.0})
    for (int n = 0; n < 50; ++n) {
      const auto m = random_matrix(random, size);
      const Vector x = random_vector(random, 1);
      CHECK(norm(plus(phi_times(m, x), -1, series(m, x))) < 1e-15 * std::exp(norm(m)) * (10 + 10 * size));
    }
}

TEST_CASE("the_even_part_less_half_the_log_undoes_phi_up_to_300_degrees") {
  Random random(4);
  for (int n = 0; n < 300; ++n) {
    const Vector v = random_vector(random, 1), w = sym3::times(uniform(random, 0, 5.23) / norm(v), v);
    const Vector x = random_vector(random, 1);
    for (const bool rotation : {true, false}) {
      if (!rotation && norm(w) > 4) continue;  // m and w have different rotation angles
      const auto m = plus(sym3::cross_matrix(w), 1, random_matrix(random, rotation ? 0 : 0.4));
      const Vector y = phi_times(m, x);
      const Vector back = plus(sym3::product(even_part(m, w), y), -0.5, sym3::product(m, y));
      CHECK(norm(plus(back, -1, x)) < (rotation ? 1e-13 : 1e-11));
      CHECK(norm(plus(sym3::inverse_phi_times(m, w, y), -1, x)) < 1e-11);
    }
  }
}

TEST_CASE("the_even_part_is_bounded_and_continuous_through_two_whole_turns") {
  const Vector axis = sym3::times(1 / norm(Vector{1, -2, 0.5}), Vector{1, -2, 0.5});
  const Mat3<double> stretch{0.3, 0.1, 0, 0.1, -0.2, 0, 0, 0, 0.05};
  for (const double size : {0.0, 1.0}) {
    Mat3<double> before;
    for (int step = 0; step <= 4 * 3600; ++step) {
      const Vector w = sym3::times(0.05 * step * std::numbers::pi / 180, axis);
      const auto now = even_part(plus(sym3::cross_matrix(w), size, stretch), w);
      CHECK(norm(now) < 18);
      for (int i = 0; i < 9 && step > 0; ++i) CHECK(std::abs(now[i] - before[i]) < 0.05);
      before = now;
    }
  }
}
