#include "mesh/triangle.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

namespace {

Vec3 point(const Closest& c, const Vec3& a, const Vec3& b, const Vec3& d) {
  return c.barycentric[0] * a + c.barycentric[1] * b + c.barycentric[2] * d;
}

// Returns the smallest distance from p to the points of a fine grid on the triangle.
double sampled(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr int n = 60;
  double best = HUGE_VAL;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const double s = double(i) / n, t = double(j) / n;
      best = std::min(best, norm(p - ((1 - s - t) * a + s * b + t * c)));
    }
  return best;
}

// Returns six times the signed volume, exactly. Coordinates must be integers below 2^20.
__int128 volume_of(const Point& a, const Point& b, const Point& c, const Point& d) {
  __int128 m[3][3];
  for (int k = 0; k < 3; ++k) {
    m[0][k] = static_cast<__int128>(b[k]) - static_cast<__int128>(a[k]);
    m[1][k] = static_cast<__int128>(c[k]) - static_cast<__int128>(a[k]);
    m[2][k] = static_cast<__int128>(d[k]) - static_cast<__int128>(a[k]);
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

std::mt19937_64 pair_engine(5);

// Returns a triangle on a coarse lattice. Contacts, common edges and common planes are frequent there.
Corners lattice_triangle(int size) {
  std::uniform_int_distribution<int> number(0, size);
  Corners t;
  for (Point& p : t) p = {1.0 * number(pair_engine), 1.0 * number(pair_engine), 1.0 * number(pair_engine)};
  return t;
}

// Returns the smallest distance between points of grids on the triangles.
double sampled_distance(const Corners& s, const Corners& t) {
  constexpr int n = 12;
  double least = HUGE_VAL;
  const auto place = [](const Corners& c, int i, int j) {
    const double u = i / double(n), v = j / double(n);
    return (1 - u - v) * c[0] + u * c[1] + v * c[2];
  };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      for (int k = 0; k <= n; ++k)
        for (int l = 0; k + l <= n; ++l) least = std::min(least, norm(place(s, i, j) - place(t, k, l)));
  return least;
}

bool segment_through(const Point& p, const Point& q, const Corners& t) {
  const auto a = volume_of(t[0], t[1], t[2], p), b = volume_of(t[0], t[1], t[2], q);
  if ((a > 0) == (b > 0) || a == 0 || b == 0) return false;
  const auto u = volume_of(p, q, t[0], t[1]), v = volume_of(p, q, t[1], t[2]),
             w = volume_of(p, q, t[2], t[0]);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

bool in_one_plane(const Corners& s, const Corners& t) {
  return std::ranges::all_of(t, [&](const Point& p) { return volume_of(s[0], s[1], s[2], p) == 0; });
}

}  // namespace

TEST_CASE("distance_agrees_with_a_sampled_triangle_on_both_sides") {
  test::Random random(2);
  for (int n = 0; n < 200; ++n) {
    const Vec3 a = random.vector(1), b = random.vector(1), c = random.vector(1), p = random.vector(2);
    const Closest closest = closest_on_triangle(p, a, b, c);
    const double d = std::sqrt(closest.squared_distance), grid = sampled(p, a, b, c);
    CHECK(d <= grid + 1e-14);
    CHECK(d >= grid - 0.05);
    CHECK(norm(p - point(closest, a, b, c)) == doctest::Approx(d).epsilon(1e-12));
    const auto& w = closest.barycentric;
    CHECK(w[0] + w[1] + w[2] == doctest::Approx(1).epsilon(1e-15));
    CHECK(std::min({w[0], w[1], w[2]}) >= -1e-15);
  }
}

TEST_CASE("distance_to_corners_and_edges_is_exact") {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  CHECK(closest_on_triangle({-3, -4, 0}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({7, 0, 4}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({0, 8, 3}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({2, -3, 4}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({-3, 2, 4}, a, b, c).squared_distance == 25);
  CHECK(closest_on_triangle({5, 5, 0}, a, b, c).squared_distance == 18);
}

TEST_CASE("a_triangle_without_area_is_a_segment_or_a_point") {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{3, 0, 0};
  for (const auto& [x, d2] : {std::pair{2.0, 1.0}, {-1.0, 2.0}, {4.0, 2.0}, {0.5, 1.0}}) {
    CHECK(closest_on_triangle({x, 1, 0}, a, b, c).squared_distance == doctest::Approx(d2));
    CHECK(closest_on_triangle({x, 1, 0}, c, a, b).squared_distance == doctest::Approx(d2));
    CHECK(closest_on_triangle({x, 1, 0}, b, c, a).squared_distance == doctest::Approx(d2));
  }
  CHECK(closest_on_triangle({1, 2, 2}, a, a, a).squared_distance == 9);
  CHECK(closest_on_triangle({1, 2, 0}, a, a, c).squared_distance == 4);
}

TEST_CASE("distance_scales_with_the_scene_from_1e-30_to_1e30") {
  test::Random random(4);
  for (const double s : {1e-30, 1e-10, 1e10, 1e30})
    for (int n = 0; n < 50; ++n) {
      const Vec3 a = random.vector(1), b = random.vector(1), c = random.vector(1), p = random.vector(2);
      const double d = std::sqrt(closest_on_triangle(p, a, b, c).squared_distance);
      CHECK(std::sqrt(closest_on_triangle(s * p, s * a, s * b, s * c).squared_distance) ==
            doctest::Approx(s * d).epsilon(1e-9));
    }
}

TEST_CASE("has_area_is_false_only_up_to_rounding_at_every_scale") {
  for (const double scale : {1e-300, 1e-30, 1.0, 1e30, 1e99}) {
    const Vec3 a{0, 0, 0}, b{scale, 0, 0}, c{2 * scale, 0, 0};
    CHECK(has_area(a, b, {0, scale, 0}));
    CHECK(has_area(a, b, {0.5 * scale, 2e-12 * scale, 0}));
    CHECK_FALSE(has_area(a, b, {0.5 * scale, 0.5e-12 * scale, 0}));
    CHECK_FALSE(has_area(a, b, c));
    CHECK_FALSE(has_area(a, b, b));
    CHECK_FALSE(has_area(b, b, b));
  }
}

TEST_CASE("orientation_is_exact_for_almost_coplanar_points") {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> small(-3, 3), large(-(1 << 19), 1 << 19);
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    // Point d is in the plane of a, b and c. Then one coordinate of d changes by at most 1.
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
    const auto volume = volume_of(a, b, c, d);
    const int expected = (volume > 0) - (volume < 0);
    zeros += expected == 0;
    CHECK(orientation(a, b, c, d) == expected);
    CHECK(orientation(b, a, c, d) == -expected);
    CHECK(orientation(b, c, d, a) == -expected);
  }
  CHECK(zeros > 5000);
}

TEST_CASE("orientation_is_exact_where_rounding_decides") {
  // The coordinates of p are near 0.5, in steps of e. The determinant 12 * (j - i) * e is tiny.
  const double e = 0x1p-53;
  for (int i = -8; i <= 8; ++i)
    for (int j = -8; j <= 8; ++j) {
      const Point2 p{0.5 + i * e, 0.5 + j * e}, q{12, 12}, r{24, 24};
      CHECK(orientation(p, q, r) == (i < j) - (i > j));
      CHECK(orientation(Point{p[0], p[1], 0}, Point{12, 12, 0}, Point{24, 24, 0}, Point{1, 1, 1}) ==
            (i < j) - (i > j));
    }
}

TEST_CASE("triangle_crossing_on_a_lattice_agrees_with_integer_arithmetic") {
  int crossing = 0, apart = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Corners s = lattice_triangle(3), t = lattice_triangle(3);
    if (!has_plane(s) || !has_plane(t) || in_one_plane(s, t)) continue;
    bool expected = false;
    for (std::size_t k = 0; k < 3; ++k)
      expected =
          expected || segment_through(s[k], s[(k + 1) % 3], t) || segment_through(t[k], t[(k + 1) % 3], s);
    CHECK(intersect(s, t) == expected);
    CHECK(intersect(t, s) == expected);
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(crosses(s[k], s[(k + 1) % 3], t) == segment_through(s[k], s[(k + 1) % 3], t));
    ++(expected ? crossing : apart);
  }
  CHECK(crossing > 1000);
  CHECK(apart > 1000);
}

TEST_CASE("coplanar_triangles_cross_only_if_they_overlap") {
  const Corners t = {{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}};
  CHECK(intersect(t, {{{1, 1, 1}, {9, 1, 1}, {1, 9, 1}}}));
  CHECK(intersect(t, {{{1, 1, 1}, {1.5, 1, 1}, {1, 1.5, 1}}}));  // the triangle is inside t
  CHECK(intersect(t, t));
  CHECK_FALSE(intersect(t, {{{4, 0, 1}, {0, 4, 1}, {4, 4, 1}}}));    // a common edge
  CHECK_FALSE(intersect(t, {{{2, 0, 1}, {6, 0, 1}, {4, -4, 1}}}));   // a part of an edge
  CHECK_FALSE(intersect(t, {{{0, 0, 1}, {-1, 0, 1}, {0, -1, 1}}}));  // a common corner
  CHECK_FALSE(intersect(t, {{{1, 1, 2}, {9, 1, 2}, {1, 9, 2}}}));
}

TEST_CASE("a_triangle_without_area_has_no_plane") {
  CHECK_FALSE(has_plane({{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}}));
  CHECK_FALSE(has_plane({{{1, 2, 3}, {1, 2, 3}, {0, 0, 0}}}));
  CHECK(has_plane({{{0, 0, 0}, {1, 1, 1}, {3, 3, std::nextafter(3.0, 4.0)}}}));
}

TEST_CASE("triangle_distance_agrees_with_sampling") {
  for (int i = 0; i < 400; ++i) {
    const Corners s = lattice_triangle(4);
    Corners t = lattice_triangle(4);
    if (i % 2) {
      for (Point& p : t) p[0] += 5;
    }
    const double distance = std::sqrt(squared_distance(s, t)), sampled = sampled_distance(s, t);
    CHECK(distance <= sampled + 1e-12);
    CHECK(distance > sampled - 1.0);  // the error of the grids is at most 1
    CHECK(squared_distance(t, s) == doctest::Approx(distance * distance).epsilon(1e-12));
    if (has_plane(s) && has_plane(t) && intersect(s, t)) CHECK(distance == 0);
  }
  const Corners t = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  CHECK(squared_distance(t, {{{0.2, 0.2, 2}, {5, 5, 9}, {5, 6, 9}}}) == 4);
  CHECK(squared_distance(t, {{{3, 0, 0}, {3, 0, 0}, {3, 0, 0}}}) == 4);               // a point
  CHECK(squared_distance(t, {{{0.5, -1, 1}, {0.5, 2, 1}, {0.5, 0, 1}}}) == 1);        // a segment above t
  CHECK(squared_distance(t, {{{0.3, 0.3, 1}, {0.3, 0.3, -1}, {0.3, 0.3, 9}}}) == 0);  // a segment through t
  CHECK(squared_distance({{{0.3, 0.3, 1}, {0.3, 0.3, -1}, {0.3, 0.3, 9}}}, t) == 0);
}
