#include "sym3/affine.h"

#include <numbers>

#include "sym3/general.h"
#include "sym3/preamble.h"
#include "sym3/small_matrices.h"
#include "sym3/translation_log.h"

using sym3::Affine, sym3::AffineLog;

namespace {

constexpr double turn = 2 * std::numbers::pi;

double difference(const Affine& a, const Affine& b) {
  return std::max(sym3::norm(sym3::plus(a.linear, -1, b.linear)),
                  sym3::norm(sym3::plus(a.translation, -1, b.translation)));
}

// Returns a random map: a rotation by at most `angle`, stretches, shears and a translation.
Affine any_map(Random& random, double angle = 2.5, double stretch = 3) {
  const auto some = [&] { return uniform(random, -1, 1); };
  const sym3::Vec3<double> w{some(), some(), some()};
  const double limit = std::log(stretch) / 2;
  Affine a{sym3::exp_rotation(sym3::times(uniform(random, 0, angle) / sym3::norm(w), w)),
           {some(), some(), some()}};
  const auto s =
      sym3::exp_general({some() * limit, some() * limit, some() * limit, some() * limit, some() * limit,
                         some() * limit, some() * limit, some() * limit, some() * limit});
  a.linear = sym3::product(a.linear, s);
  return a;
}

Affine about_z(double angle, const sym3::Vec3<double>& shift = {}) {
  return {sym3::exp_rotation<double>({0, 0, angle}), shift};
}

std::vector<Affine> some_maps(Random& random, int count, double angle) {
  std::vector<Affine> maps;
  for (int i = 0; i < count; ++i) maps.push_back(any_map(random, angle, 2));
  return maps;
}

std::vector<Affine> times_all(const Affine& a, std::vector<Affine> maps, const Affine& b) {
  for (Affine& m : maps) m = a * m * b;
  return maps;
}

std::vector<Affine> inverses(std::vector<Affine> maps) {
  for (Affine& m : maps) m = sym3::inverse(m);
  return maps;
}

const std::vector<double> weights{0.5, 0.3, -0.1, 0.3};

}  // namespace

TEST_CASE("exp_of_the_log_of_an_affine_map_is_the_map") {
  Random random(21);
  for (int i = 0; i < 500; ++i) {
    const Affine a = any_map(random, 3, 5);
    if (!sym3::has_log(a.linear)) continue;
    const double size = 1 + sym3::norm(sym3::log_affine(a).linear);
    CHECK(difference(sym3::exp_affine(sym3::log_affine(a)), a) < 1e-14 * size * size);
    CHECK(difference(a * sym3::inverse(a), {}) < 1e-13);
  }
  CHECK(sym3::exp_affine({}) == Affine{});
  CHECK(sym3::log_affine(Affine{}) == AffineLog{});
  const sym3::Vec3<double> shift{1, -2, 3};
  CHECK(sym3::log_affine(Affine{Affine{}.linear, shift}).translation == shift);
}

TEST_CASE("half_of_a_half_turn_is_a_quarter_turn") {
  const Affine half_turn{{-1, 0, 0, 0, -1, 0, 0, 0, 1}, {}};
  for (const double angle : {0.5, 1.0, 1 - 1e-9, 1 - 1e-6, 1 - 1e-3}) {
    const Affine whole = angle == 1 ? half_turn : about_z(turn / 2 * angle);
    const Affine half = sym3::combine(std::vector{whole}, std::vector{0.5});
    CHECK(difference(half, about_z(turn / 4 * angle)) < 1e-15);
  }
  // `screw` is half a turn about an axis with a shift along this axis. `quarter` is half of this motion.
  const Affine to{about_z(0).linear, {3, 1, 0}},
      screw = to * Affine{half_turn.linear, {0, 0, 2}} * sym3::inverse(to);
  const Affine quarter = to * about_z(turn / 4, {0, 0, 1}) * sym3::inverse(to);
  CHECK(difference(sym3::interpolate({}, screw, 0.5), quarter) < 2e-15);
}

TEST_CASE("the_branch_nearest_to_a_turn_is_followed_any_number_of_times_round") {
  sym3::Vec3<double> before{};
  for (int i = 1; i <= 72; ++i) {  // 30 degrees in each step: six turns
    const double angle = turn * i / 12;
    const Affine map = about_z(angle);
    const AffineLog log = sym3::log_affine(map, before);
    before = sym3::turn_of(log);
    CHECK(before[2] == doctest::Approx(angle).epsilon(1e-13));
    CHECK(difference(sym3::exp_affine(log), map) < 1e-13);
  }
  const Affine a = about_z(0.2, {1, 2, 3}), b = about_z(2.2, {2, 0, 1});
  CHECK(difference(sym3::interpolate(a, b, 0.5, {0, 0, 2 - turn}), sym3::interpolate(a, b, 0.5)) > 1);
  CHECK(difference(sym3::interpolate(a, b, 1, {0, 0, 2 - turn}), b) < 1e-13);
  CHECK(difference(sym3::interpolate(a, b, 1, {0, 0, 2 + 3 * turn}), b) < 1e-13);
}

TEST_CASE("interpolation_leads_from_one_map_to_the_other_in_any_coordinates") {
  Random random(22);
  for (int i = 0; i < 100; ++i) {
    const Affine a = any_map(random, 1.5, 2), b = any_map(random, 1.5, 2), c = any_map(random);
    CHECK(sym3::interpolate(a, b, 0) == a);
    CHECK(difference(sym3::interpolate(a, b, 1), b) < 1e-13);
    const Affine middle = sym3::interpolate(a, b, 0.3);
    CHECK(difference(sym3::interpolate(c * a, c * b, 0.3), c * middle) < 1e-12);
    CHECK(difference(sym3::interpolate(a * c, b * c, 0.3), middle * c) < 1e-12);
    CHECK(difference(sym3::interpolate(b, a, 0.7), middle) < 1e-13);
    CHECK(difference(sym3::interpolate(sym3::inverse(a), sym3::inverse(b), 0.3), sym3::inverse(middle)) <
          1e-12);
  }
}

TEST_CASE("the_order_of_combined_maps_does_not_matter_nor_do_coordinates_and_inverses_give_the_inverse") {
  Random random(23);
  for (int i = 0; i < 100; ++i) {
    auto maps = some_maps(random, 4, 2);
    const Affine sum = sym3::combine(maps, weights), c = any_map(random);
    CHECK(difference(sym3::combine(times_all(c, maps, sym3::inverse(c)), weights),
                     c * sum * sym3::inverse(c)) < 1e-11);
    CHECK(difference(sym3::combine(inverses(maps), weights), sym3::inverse(sum)) < 1e-12);
    std::swap(maps[0], maps[2]);
    std::swap(maps[1], maps[3]);
    CHECK(difference(sym3::combine(maps, std::vector{-0.1, 0.3, 0.5, 0.3}), sum) < 1e-15 * 10);
    CHECK(difference(sym3::combine(std::span(maps).first(1), std::vector{2.0}), maps[0] * maps[0]) < 1e-13);
  }
}

TEST_CASE("linear_maps_stay_linear") {
  Random random(24);
  auto maps = some_maps(random, 4, 2);
  for (Affine& m : maps) m.translation = {};
  const sym3::Vec3<double> zero{};
  CHECK(sym3::combine(maps, weights).translation == zero);
  CHECK(sym3::interpolate(maps[0], maps[1], 0.4).translation == zero);
  CHECK(sym3::mean(maps, weights).map.translation == zero);
}

TEST_CASE("the_mean_commutes_with_composition_and_inversion") {
  Random random(25);
  for (int i = 0; i < 60; ++i) {
    const auto maps = some_maps(random, 4, 1);
    const Affine a = any_map(random), b = any_map(random);
    const auto mean = sym3::mean(maps, weights), moved = sym3::mean(times_all(a, maps, b), weights),
               back = sym3::mean(inverses(maps), weights);
    CHECK((mean.converged && moved.converged && back.converged));
    CHECK(difference(moved.map, a * mean.map * b) < 1e-12);
    CHECK(difference(back.map, sym3::inverse(mean.map)) < 1e-12);
    const Affine middle = sym3::mean(std::span(maps).first(2), std::vector{3.0, 1.0}).map;
    CHECK(difference(middle, sym3::interpolate(maps[0], maps[1], 0.25)) < 1e-13);
  }
}

TEST_CASE("a_mean_divides_weights_of_any_size_by_their_sum") {
  Random random(27);
  const auto maps = some_maps(random, 4, 1);
  struct Case {
    std::vector<double> weights, shares;
  };
  for (const auto& [given, shares] : {Case{{1e308, 1e308, 1e308, 1e308}, {0.25, 0.25, 0.25, 0.25}},
                                      {{5e-324, 5e-324, 1e-323, 0}, {0.25, 0.25, 0.5, 0}},
                                      {{1e308, 1e-320, 1, -1e-320}, {1, 0, 0, 0}},
                                      {{1e308, 1e308, -1e308, 0}, {1, 1, -1, 0}},
                                      {{-1e308, -1e308, 0, 0}, {0.5, 0.5, 0, 0}},
                                      {{-3e-320, -3e-320, 0, 0}, {0.5, 0.5, 0, 0}}}) {
    const auto mean = sym3::mean(maps, given);
    CAPTURE(given);
    CHECK(mean.converged);
    CHECK(difference(mean.map, sym3::mean(maps, shares).map) < 1e-13);
  }
}

TEST_CASE("an_undefined_mean_does_not_converge") {
  const std::vector<Affine> maps{about_z(0.1), about_z(0.2, {1, 0, 0}), about_z(0.3)};
  for (const auto& undefined : std::vector<std::vector<double>>{{0, 0, 0},
                                                                {0.1, 0.2, -0.3},
                                                                {1e308, -1e308, 0},
                                                                {1e-320, -2e-320, 1e-320},
                                                                {HUGE_VAL, 1, 1},
                                                                {NAN, 1, 1}})
    CHECK(!sym3::mean(maps, undefined).converged);
  const Affine flat{{1, 0, 0, 0, 1, 0, 0, 0, 0}, {}};
  CHECK(!sym3::mean(std::vector{flat, Affine{}}, std::vector{2.0, 1.0}).converged);
}

TEST_CASE("terms_of_a_sum_that_overflow_cancel") {
  const std::vector<Affine> maps(3, about_z(2, {3, 0, 0}));
  CHECK(difference(sym3::combine(maps, std::vector{1e308, 0.5, -1e308}), {}) < 1e-13);
}

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
