#include "deform/matrix_log.h"

#include <doctest/doctest.h>

#include "deform/map_split.h"
#include "deform/shapes.h"

using namespace viete;
using namespace viete::test;

namespace {

// Log of M = R S, the rotation as a branch of so many whole turns more.
MapLog log_of(const sym3::Mat3<double>& m, int turns = 0) {
  std::vector<MapSplit> splits(1);
  const std::uint32_t one[] = {0};
  const AffineMap map{m, {0, 0, 0}};
  split_maps(std::span(&map, 1), one, splits);
  const Vec3& y = splits[0].turn;
  const double angle = norm(y);
  const double factor = angle > 0 ? 1 + 2 * std::numbers::pi * turns / angle : 1;
  return {splits[0].stretch, factor * y, {0, 0, 0}};
}

double entry_difference(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b) {
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

double largest_entry(const sym3::Mat3<double>& m) {
  return entry_difference(m, {});
}

}  // namespace

TEST_CASE("exp_of_a_matrix_log_is_the_matrix_on_every_branch") {
  Random random(7);
  for (int n = 0; n < 200; ++n) {
    Affine m = similarity(random.vector(1), random(0.3, 2.2), random(0.3, 3));
    for (double& x : m.linear) x += random(-0.1, 0.1) * largest_entry(m.linear);
    for (const int turns : {0, 1, -2, 3}) {
      const auto l = matrix_log(m.linear, log_of(m.linear, turns));
      CHECK(entry_difference(matrix_exp(l), m.linear) < 1e-12 * largest_entry(m.linear));
      const Vec3 turn{(l[7] - l[5]) / 2, (l[2] - l[6]) / 2, (l[3] - l[1]) / 2};
      const Vec3 asked = log_of(m.linear, turns).rotation;
      CHECK(std::abs(dot(turn - asked, asked) / norm(asked)) < std::numbers::pi);  // no other branch
    }
  }
}

TEST_CASE("of_similarities_it_is_the_sum_of_the_logs_also_at_180_degrees_and_at_rest") {
  for (const double angle : {0.0, 1e-9, 90.0, 179.999999, 180.0}) {
    const auto m = similarity({1, -2, 3}, angle * degree, 2.5).linear;
    const MapLog log = log_of(m);
    const auto l = matrix_log(m, log);
    const Vec3& y = log.rotation;
    const double x = std::log(2.5);
    CHECK(entry_difference(l, {x, -y[2], y[1], y[2], x, -y[0], -y[1], y[0], x}) < 1e-7);
    CHECK(entry_difference(matrix_exp(l), m) < 1e-12);
  }
  CHECK(matrix_log({1, 0, 0, 0, 1, 0, 0, 0, 1}, log_of({1, 0, 0, 0, 1, 0, 0, 0, 1})) == sym3::Mat3<double>{});
}

TEST_CASE("where_there_is_no_logarithm_it_is_bounded_and_continuous") {
  // Turned about z by an angle around 180 degrees, stretched along x: two negative eigenvalues in the middle.
  sym3::Mat3<double> before{};
  for (int i = 0; i <= 4000; ++i) {
    const double angle = (150 + 60.0 * i / 4000) * degree, c = std::cos(angle), s = std::sin(angle);
    const sym3::Mat3<double> m{1.5 * c, -s, 0, 1.5 * s, c, 0, 0, 0, 1};
    MapLog log = log_of(m);
    if (log.rotation[2] < 0) log = log_of(m, -1);  // on through 180 degrees
    const auto l = matrix_log(m, log);
    CHECK(largest_entry(l) < 4 * (norm(log.rotation) + 1));
    if (i > 0) CHECK(entry_difference(l, before) < 0.15);
    before = l;
  }
}

TEST_CASE("of_mirrored_and_flat_matrices_it_is_the_sum_of_the_logs_of_the_nearest_rotation_and_stretch") {
  const sym3::Mat3<double> mirrored{-1, 0.1, 0, 0.2, 1, 0.3, 0, 0.1, 1.2},
      spun{0, -1, 0.1, 1, 0, 0, 0.2, 0, -1.5}, flat{1, 0, 0, 0, 1, 0, 0, 0, 0};
  for (const auto& m : {mirrored, spun, flat}) {
    const MapLog log{{0.1, 0.02, 0, -0.2, 0, 0.3}, {0.3, -0.2, 0.9}, {0, 0, 0}};
    const auto& [x, y, center] = log;
    CHECK(matrix_log(m, log) == sym3::Mat3<double>{x.xx, x.xy - y[2], x.xz + y[1], x.xy + y[2], x.yy,
                                                   x.yz - y[0], x.xz - y[1], x.yz + y[0], x.zz});
  }
}
