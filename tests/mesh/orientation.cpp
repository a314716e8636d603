#include "mesh/triangle.h"

#include <doctest/doctest.h>

#include <random>

using namespace viete::mesh;

namespace {

// Integers below 2^20 are exact in __int128.
int exact_sign(const Point& a, const Point& b, const Point& c, const Point& d) {
  using Int = __int128;
  Int m[3][3];
  for (int k = 0; k < 3; ++k) {
    m[0][k] = static_cast<Int>(b[k]) - static_cast<Int>(a[k]);
    m[1][k] = static_cast<Int>(c[k]) - static_cast<Int>(a[k]);
    m[2][k] = static_cast<Int>(d[k]) - static_cast<Int>(a[k]);
  }
  const Int det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                  m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                  m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return (det > 0) - (det < 0);
}

}  // namespace

TEST_CASE("a_point_is_above_below_or_in_the_plane_of_a_triangle") {
  const Point a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  CHECK(orientation(a, b, c, {0.2, 0.2, 1e-60}) == 1);
  CHECK(orientation(a, b, c, {0.2, 0.2, -1e-60}) == -1);
  CHECK(orientation(a, b, c, {7, -3, 0}) == 0);
  CHECK(orientation(b, a, c, {0, 0, 1}) == -1);
}

TEST_CASE("the_sign_is_exact_for_almost_coplanar_points") {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> small(-3, 3), large(-(1 << 19), 1 << 19);
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    // Points of a plane spanned by two large directions, one of them off by at most one unit.
    Point a, u, v, b, c, d;
    const int s = small(random), t = small(random);
    for (int k = 0; k < 3; ++k) {
      a[k] = large(random) / 16;
      u[k] = large(random) / 16;
      v[k] = large(random) / 16;
      b[k] = a[k] + u[k];
      c[k] = a[k] + v[k];
      d[k] = a[k] + s * u[k] + t * v[k];
    }
    d[static_cast<std::size_t>(i % 3)] += small(random) / 3;
    const int expected = exact_sign(a, b, c, d);
    zeros += expected == 0;
    CHECK(orientation(a, b, c, d) == expected);
    CHECK(orientation(b, a, c, d) == -expected);
    CHECK(orientation(b, c, d, a) == -expected);
  }
  CHECK(zeros > 5000);
}

TEST_CASE("the_sign_is_exact_where_rounding_alone_decides") {
  // Halfway between neighbours of 0.5: the determinant is one product of two ulps.
  const double e = 0x1p-53;
  for (int i = -8; i <= 8; ++i) {
    for (int j = -8; j <= 8; ++j) {
      const Point2 p{0.5 + i * e, 0.5 + j * e}, q{12, 12}, r{24, 24};
      CHECK(orientation(p, q, r) == (i < j) - (i > j));
      CHECK(orientation(Point{p[0], p[1], 0}, Point{12, 12, 0}, Point{24, 24, 0}, Point{1, 1, 1}) ==
            (i < j) - (i > j));
    }
  }
}
