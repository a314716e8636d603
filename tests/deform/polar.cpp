#include "deform/polar.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "deform/maps.h"
#include "deform/shapes.h"

using namespace viete::test;
using Matrix = viete::sym3::Mat3<double>;

namespace {

Matrix transposed(const Matrix& m) {
  return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
}

Matrix diagonal(const Vec3& d) {
  return {d[0], 0, 0, 0, d[1], 0, 0, 0, d[2]};
}

double difference(const Matrix& a, const Matrix& b) {
  double d = 0;
  for (int i = 0; i < 9; ++i) d = std::max(d, std::abs(a[i] - b[i]));
  return d;
}

double determinant(const Matrix& m) {
  return dot({m[0], m[1], m[2]}, cross({m[3], m[4], m[5]}, {m[6], m[7], m[8]}));
}

Matrix stretch(const Polar& p) {
  return times(times(p.axes, diagonal(p.stretches)), transposed(p.axes));
}

const Matrix unity = diagonal({1, 1, 1});

}  // namespace

TEST_CASE("rotation_times_stretch_is_the_matrix") {
  Random random(6);
  for (int n = 0; n < 200; ++n) {
    Matrix m;
    for (double& x : m) x = random(-1, 1);
    if (determinant(m) < 0) m = times(m, diagonal({1, 1, -1}));
    const Polar p = polar(m);
    CHECK(difference(times(p.rotation, stretch(p)), m) < 5e-15);
    CHECK(difference(times(p.rotation, transposed(p.rotation)), unity) < 5e-15);
    CHECK(determinant(p.rotation) == doctest::Approx(1));
  }
}

TEST_CASE("identity_has_exactly_the_identity_and_log_zero") {
  const Polar p = polar(unity);
  CHECK(p.rotation == unity);
  CHECK(log_stretch(p) == viete::sym3::Sym3<double>{});
}

TEST_CASE("a_similarity_has_its_rotation_and_an_isotropic_log_at_any_scale") {
  for (const double s : {1e-30, 1e-3, 1.0, 1e3, 1e30}) {
    const auto map = similarity({1, 2, 3}, 2.5, s);
    const Polar p = polar(map.linear);
    CHECK(difference(p.rotation, similarity({1, 2, 3}, 2.5).linear) < 3e-15);
    const auto x = log_stretch(p);
    CHECK(x.xx == doctest::Approx(std::log(s)).epsilon(1e-14));
    CHECK(x.zz == doctest::Approx(std::log(s)).epsilon(1e-14));
    CHECK(std::abs(x.xy) < 1e-15 * (1 + std::abs(std::log(s))) * 10);
  }
}

TEST_CASE("a_mirror_has_the_closest_proper_rotation") {
  const Polar p = polar(diagonal({3, 2, -1}));
  CHECK(difference(p.rotation, unity) < 1e-15);
  CHECK(determinant(polar(diagonal({-1, -2, -3})).rotation) == doctest::Approx(1));
}

TEST_CASE("a_matrix_that_is_not_finite_has_no_rotation_and_no_stretch") {
  for (const double odd :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Polar p = polar({1, 0, 0, 0, odd, 0, 0, 0, 1});
    for (const double x : p.rotation) CHECK(std::isnan(x));
    for (const double x : p.stretches) CHECK(std::isnan(x));
  }
}

TEST_CASE("singular_matrices_have_a_proper_rotation_and_zero_has_the_identity") {
  CHECK(polar({0, 0, 0, 0, 0, 0, 0, 0, 0}).rotation == unity);
  for (const Matrix& m : {diagonal({1, 0, 0}), diagonal({1, 1, 0}), Matrix{1, 2, 3, 2, 4, 6, 3, 6, 9}}) {
    const Polar p = polar(m);
    CHECK(determinant(p.rotation) == doctest::Approx(1));
    CHECK(difference(times(p.rotation, stretch(p)), m) < 1e-13);
  }
}
