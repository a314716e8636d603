#include "sym3/rotation.h"

#include <limits>
#include <numbers>

#include "sym3/arranged.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

using sym3::Mat3;
using sym3::Vec3;

namespace {

constexpr double pi = std::numbers::pi;
using QuadVec = std::array<Quad, 3>;

Quad length(const QuadVec& v) {
  return sqrtq(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

template <class T>
QuadVec vector_to_quad(const Vec3<T>& v) {
  return {v[0], v[1], v[2]};
}

/// Returns a vector of length `angle`: along an axis, in a coordinate plane, or in a random direction.
template <class T>
Vec3<T> vector_of_angle(double angle, int i, Random& random) {
  const auto f = random_rotation(random);
  if (i % 4 == 0) {
    Vec3<T> w{};
    w[i / 4 % 3] = T(i % 8 ? angle : -angle);
    return w;
  }
  if (i % 4 == 1) return {T(0), T(angle * std::cos(double(i))), T(angle * std::sin(double(i)))};
  return {T(f[0][0] * angle), T(f[1][0] * angle), T(f[2][0] * angle)};
}

template <class T>
double exp_error(const Vec3<T>& w) {
  const auto exact = quad_rotation(vector_to_quad(w));
  const auto computed = sym3::exp_rotation(w);
  Quad sum = 0;
  for (int k = 0; k < 9; ++k) sum += (computed[k] - exact[k]) * (computed[k] - exact[k]);
  return static_cast<double>(sqrtq(sum)) / unit_roundoff<T>;
}

template <class T>
Vec3<T> log_with(const sym3::Kernel& kernel, const Mat3<T>& r) {
  Vec3<T> w;
  sym3::log_rotation(sym3::MatView<const T>(sym3::Layout::packed, r.data()),
                     sym3::VecView<T>(sym3::Layout::packed, w.data()), 1, {&kernel});
  return w;
}

template <class T>
Mat3<T> rounded_rotation(const Vec3<T>& w) {
  const auto exact = quad_rotation(vector_to_quad(w));
  Mat3<T> rounded;
  for (int k = 0; k < 9; ++k) rounded[k] = static_cast<T>(exact[k]);
  return rounded;
}

/// Returns the error in u. Near half a turn, also accepts w - 2 pi w / |w|, almost the same rotation as w.
template <class T>
double log_error(const Vec3<T>& computed, const Vec3<T>& w) {
  const QuadVec x = vector_to_quad(computed), y = vector_to_quad(w);
  const Quad angle = length(y);
  const Quad turn = angle > 3.14159 ? 1 - 2 * acosq(Quad(-1)) / angle : Quad(1);
  const QuadVec direct = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
  const QuadVec other = {x[0] - turn * y[0], x[1] - turn * y[1], x[2] - turn * y[2]};
  return static_cast<double>(std::min(length(direct), length(other))) / unit_roundoff<T>;
}

}  // namespace

TEST_CASE_TEMPLATE("exp_rotation_keeps_its_bound_at_every_angle", T, double, float) {
  Random random(61);
  for (const double angle : {1e-30,     1e-9, 1e-4, 0.1,  0.5,  1.0, 1.5,    2.0,  2.5,   3.0,
                             pi - 1e-6, pi,   3.2,  3.24, 3.25, 4.0, 2 * pi, 10.0, 100.0, 1e4}) {
    for (int i = 0; i < 300; ++i) CHECK(exp_error(vector_of_angle<T>(angle, i, random)) <= 8 + 5 * angle);
  }
}

TEST_CASE_TEMPLATE("zero_vector_and_identity_map_to_each_other_exactly", T, double, float) {
  CHECK(sym3::exp_rotation(Vec3<T>{}) == Mat3<T>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  CHECK(sym3::log_rotation(Mat3<T>{1, 0, 0, 0, 1, 0, 0, 0, 1}) == Vec3<T>{});
}

TEST_CASE_TEMPLATE("log_rotation_keeps_its_bound_up_to_half_a_turn", T, double, float) {
  Random random(62);
  for (const double angle : {1e-30, 1e-12, 1e-6, 1e-3, 0.1, 0.7, 1.5, 2.0, 2.2, 2.5, 3.0, 3.1, pi - 1e-3,
                             pi - 1e-6, pi - 1e-9, pi - 1e-12, pi}) {
    for (int i = 0; i < 300; ++i) {
      const auto w = vector_of_angle<T>(angle, i, random);
      const auto r = rounded_rotation(w);
      for (const auto& kernel : sym3::kernels()) {
        CAPTURE(kernel.name);
        CAPTURE(angle);
        CHECK(log_error(log_with(kernel, r), w) <= 6 * angle);
      }
      CHECK(sym3::log_rotation(r) == log_with(sym3::kernel(), r));
    }
  }
}

TEST_CASE_TEMPLATE("at_exactly_half_a_turn_the_first_component_is_positive", T, double, float) {
  const double h = std::numbers::sqrt2 / 2;
  const std::array<double, 3> axes[] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {-1, 0, 0}, {0, -1, 0},
                                        {0, 0, -1}, {h, -h, 0}, {-h, h, 0}, {0, -h, h}, {-0.6, 0, 0.8}};
  for (const auto& axis : axes) {
    const auto [x, y, z] = std::array{T(axis[0]), T(axis[1]), T(axis[2])};
    const Mat3<T> r = {2 * x * x - 1, 2 * x * y, 2 * x * z, 2 * x * y,    2 * y * y - 1,
                       2 * y * z,     2 * x * z, 2 * y * z, 2 * z * z - 1};
    for (const auto& kernel : sym3::kernels()) {
      CAPTURE(kernel.name);
      const auto w = log_with(kernel, r);
      const T first = w[0] != 0 ? w[0] : w[1] != 0 ? w[1] : w[2];
      CHECK(first > 0);
      const T sign = (x != 0 ? x : y != 0 ? y : z) > 0 ? T(pi) : -T(pi);
      CHECK(std::fabs(w[0] - sign * x) + std::fabs(w[1] - sign * y) + std::fabs(w[2] - sign * z) <
            32 * unit_roundoff<T>);
    }
  }
}

TEST_CASE_TEMPLATE("near_rotations_have_near_logarithms", T, double, float) {
  Random random(66);
  for (const double size : {0.03, 1e-3, 1e-5})
    for (int i = 0; i < 1000; ++i) {
      const auto w = vector_of_angle<T>(uniform(random, 0, 3), i, random);  // less than half a turn
      Mat3<T> r = rounded_rotation(w);
      double moved = 0;
      for (T& x : r) {
        const double change = uniform(random, -size, size);
        x += T(change);
        moved += change * change;
      }
      const double by = log_error(sym3::log_rotation(r), w) * unit_roundoff<T>;
      CHECK(by <= 2 * std::sqrt(moved) + 20 * unit_roundoff<T>);
    }
}

TEST_CASE_TEMPLATE("logs_of_nan_infinity_and_overflow_are_three_nan", T, double, float) {
  const T big = std::numeric_limits<T>::max(), infinity = std::numeric_limits<T>::infinity();
  const Mat3<T> turns[] = {{1, 0, 0, 0, 1, 0, 0, 0, 1},
                           {1, 0, 0, 0, -1, 0, 0, 0, -1},
                           {-1, 0, 0, 0, 1, 0, 0, 0, -1},
                           {-1, 0, 0, 0, -1, 0, 0, 0, 1}};
  for (const auto& kernel : sym3::kernels())
    for (const auto& turn : turns)
      for (const T bad : {std::numeric_limits<T>::quiet_NaN(), infinity, -infinity, big, -big})
        for (int i = 0; i < 9; ++i) {
          Mat3<T> r = turn;
          r[i] = bad;
          for (const T x : log_with(kernel, r)) CHECK(std::isnan(x));
        }
}

TEST_CASE("huge_angles_still_give_a_rotation") {
  for (const Vec3<double>& w :
       {Vec3<double>{1e200, -2e200, 5e199}, {1.7e308, 1.7e308, 1.7e308}, {-1.7e308, 1, 1.2e308}}) {
    CHECK(determinant(sym3::exp_rotation(w)) == doctest::Approx(1).epsilon(1e-13));
  }
  for (const float x : sym3::exp_rotation(Vec3<float>{3.3e38F, 3.3e38F, -3.3e38F})) CHECK(std::isfinite(x));
}

TEST_CASE_TEMPLATE("every_kernel_length_and_layout_of_a_batch_of_rotations_and_logs_gives_the_bits_of_one", T,
                   double, float) {
  Random random(65);
  std::vector<Vec3<T>> w(150);
  std::vector<Mat3<T>> r(w.size());
  for (std::size_t i = 0; i < w.size(); ++i) {
    for (T& x : w[i]) x = T(uniform(random, -1.5, 1.5));
    if (i % 40 == 7) w[i][0] = T(50);
    r[i] = sym3::exp_rotation(vector_of_angle<T>(i % 5 ? uniform(random, 0, 3.2) : pi, int(i), random));
    if (i % 50 == 7) r[i] = {-1, 0, 0, 0, 1, 0, 0, 0, -1};
  }
  for (const auto& kernel : sym3::kernels()) {
    CAPTURE(kernel.name);
    const auto exp_many = [&](const sym3::VecView<const T>& from, const sym3::MatView<T>& to,
                              std::size_t count) { sym3::exp_rotation(from, to, count, {&kernel}); };
    const auto log_many = [&](const sym3::MatView<const T>& from, const sym3::VecView<T>& to,
                              std::size_t count) { sym3::log_rotation(from, to, count, {&kernel}); };
    std::vector<Mat3<T>> rotations(w.size());
    std::vector<Vec3<T>> logs;
    for (std::size_t i = 0; i < w.size(); ++i) {
      exp_many({sym3::Layout::packed, w[i].data()}, {sym3::Layout::packed, rotations[i].data()}, 1);
      logs.push_back(log_with(kernel, r[i]));
    }
    check_every_batch<T>(w, rotations, exp_many);
    check_every_batch<T>(r, logs, log_many);
  }
}

TEST_CASE_TEMPLATE(
    "kernels_with_fused_multiply_add_agree_on_logs_of_rotations_to_the_bit_and_so_do_those_without", T,
    double, float) {
  Random random(68);
  for (int i = 0; i < 2000; ++i) {
    const auto r = rounded_rotation(vector_of_angle<T>(i % 7 ? uniform(random, 0, 3.15) : pi, i, random));
    const sym3::Kernel* last[2] = {};
    for (const auto& kernel : sym3::kernels()) {
      if (last[kernel.fused]) CHECK(log_with(kernel, r) == log_with(*last[kernel.fused], r));
      last[kernel.fused] = &kernel;
    }
  }
}
