#include "deform/translation_log.h"

#include <doctest/doctest.h>

#include "deform/matrix_log.h"
#include "deform/shapes.h"

using namespace viete;
using namespace viete::test;

namespace {

using sym3::Mat3;

Mat3<double> full(const sym3::Sym3<double>& s) {
  return {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz};
}

Mat3<double> turning(const Vec3& w) {
  return {0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0};
}

Vec3 product(const Mat3<double>& m, const Vec3& x) {
  return {m[0] * x[0] + m[1] * x[1] + m[2] * x[2], m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
          m[6] * x[0] + m[7] * x[1] + m[8] * x[2]};
}

// The first 120 terms, in long double.
Vec3 series(const Mat3<double>& m, const Vec3& x) {
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
  for (double& entry : m) entry = random(-size, size);
  return m;
}

double size_of(const Mat3<double>& m) {
  double squares = 0;
  for (const double entry : m) squares += entry * entry;
  return std::sqrt(squares);
}

}  // namespace

TEST_CASE("phi_is_its_series") {
  Random random(3);
  for (const double size : {0.0, 1e-9, 1e-3, 0.2, 1.0, 3.0, 6.0}) {
    for (int n = 0; n < 50; ++n) {
      const auto m = random_matrix(random, size);
      const Vec3 x = random.vector(1), w = random.vector(size);
      CHECK(norm(phi_times(m, x) - series(m, x)) < 1e-15 * std::exp(size_of(m)) * (10 + 10 * size));
      CHECK(norm(phi_times(w, x) - series(turning(w), x)) < 1e-14);
    }
  }
}

TEST_CASE("the_even_part_less_half_the_log_undoes_phi_up_to_300_degrees") {
  Random random(4);
  for (int n = 0; n < 300; ++n) {
    const Vec3 w = random(0, 5.23) * (1 / 1.0) * [&] {
      const Vec3 v = random.vector(1);
      return (1 / norm(v)) * v;
    }();
    const Vec3 x = random.vector(1), y = phi_times(w, x);
    CHECK(norm(product(full(even_part(w)), y) - 0.5 * cross(w, y) - x) < 1e-13);
    auto m = random_matrix(random, 0.4);
    const auto t = turning(w);
    for (int i = 0; i < 9; ++i) m[i] += t[i];
    if (norm(w) > 4) continue;  // the angle that m turns by is not that of w
    const Vec3 z = phi_times(m, x);
    const Vec3 back = product(even_part(m, w), z) - 0.5 * product(m, z);
    CHECK(norm(back - x) < 1e-11);
  }
}

TEST_CASE("the_even_part_is_bounded_and_continuous_through_two_whole_turns") {
  const Vec3 axis = (1 / norm(Vec3{1, -2, 0.5})) * Vec3{1, -2, 0.5};
  auto before = full(even_part(Vec3{0, 0, 0}));
  auto before_general = before;
  const Mat3<double> stretch{0.3, 0.1, 0, 0.1, -0.2, 0, 0, 0, 0.05};
  bool first = true;
  for (int step = 0; step <= 4 * 3600; ++step) {
    const Vec3 w = (0.05 * step * degree) * axis;
    const auto now = full(even_part(w));
    auto log = turning(w);
    for (int i = 0; i < 9; ++i) log[i] += stretch[i];
    const auto general = even_part(log, w);
    CHECK(size_of(now) < 18);
    CHECK(size_of(general) < 18);
    for (int i = 0; i < 9; ++i) {
      CHECK(std::abs(now[i] - before[i]) < 0.04);
      if (!first) CHECK(std::abs(general[i] - before_general[i]) < 0.05);
    }
    before = now, before_general = general;
    first = false;
  }
}

TEST_CASE("of_no_log_the_even_part_is_the_identity_and_near_none_it_is_next_to_it") {
  CHECK(full(even_part(Vec3{0, 0, 0})) == Mat3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  CHECK(even_part(Mat3<double>{}, Vec3{0, 0, 0}) == Mat3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  for (const double tiny : {1e-300, 1e-160, 1e-20, 1e-8}) {
    const auto e = full(even_part(Vec3{tiny, 0, -tiny}));
    for (int i = 0; i < 9; ++i) CHECK(std::abs(e[i] - (i % 4 == 0)) < 1e-15);
  }
}
