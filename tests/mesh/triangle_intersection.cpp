#include "mesh/triangle.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace viete::mesh;

namespace {

std::mt19937_64 pair_engine(5);

// On a coarse lattice, so that touching, common edges and common planes are frequent.
Corners lattice_triangle(int size) {
  std::uniform_int_distribution<int> number(0, size);
  Corners t;
  for (Point& p : t) p = {1.0 * number(pair_engine), 1.0 * number(pair_engine), 1.0 * number(pair_engine)};
  return t;
}

// The least distance of places on both, of a fine grid.
double sampled_distance(const Corners& s, const Corners& t) {
  constexpr int n = 12;
  double least = HUGE_VAL;
  const auto place = [](const Corners& c, int i, int j) {
    const double u = i / double(n), v = j / double(n);
    return (1 - u - v) * c[0] + u * c[1] + v * c[2];
  };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      for (int k = 0; k <= n; ++k) {
        for (int l = 0; k + l <= n; ++l) least = std::min(least, norm(place(s, i, j) - place(t, k, l)));
      }
    }
  }
  return least;
}

// In whole numbers, by the definition: the interiors of the two have a point in common which is no common
// border. Told by moving towards each other's middle: enough for what does not lie in one plane.
long long volume_of(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto n = [](double x) { return static_cast<long long>(x); };
  const long long m[3][3] = {{n(b[0] - a[0]), n(b[1] - a[1]), n(b[2] - a[2])},
                             {n(c[0] - a[0]), n(c[1] - a[1]), n(c[2] - a[2])},
                             {n(d[0] - a[0]), n(d[1] - a[1]), n(d[2] - a[2])}};
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

bool segment_through(const Point& p, const Point& q, const Corners& t) {
  const long long a = volume_of(t[0], t[1], t[2], p), b = volume_of(t[0], t[1], t[2], q);
  if ((a > 0) == (b > 0) || a == 0 || b == 0) return false;
  const long long u = volume_of(p, q, t[0], t[1]), v = volume_of(p, q, t[1], t[2]),
                  w = volume_of(p, q, t[2], t[0]);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

bool in_one_plane(const Corners& s, const Corners& t) {
  return std::ranges::all_of(t, [&](const Point& p) { return volume_of(s[0], s[1], s[2], p) == 0; });
}

}  // namespace

TEST_CASE("triangles_on_a_lattice_cross_as_whole_numbers_say") {
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

TEST_CASE("triangles_in_one_plane_cross_where_they_overlap_and_not_where_they_touch") {
  const Corners t = {{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}};
  CHECK(intersect(t, {{{1, 1, 1}, {9, 1, 1}, {1, 9, 1}}}));
  CHECK(intersect(t, {{{1, 1, 1}, {1.5, 1, 1}, {1, 1.5, 1}}}));  // within
  CHECK(intersect(t, t));
  CHECK_FALSE(intersect(t, {{{4, 0, 1}, {0, 4, 1}, {4, 4, 1}}}));    // a common edge
  CHECK_FALSE(intersect(t, {{{2, 0, 1}, {6, 0, 1}, {4, -4, 1}}}));   // a part of one
  CHECK_FALSE(intersect(t, {{{0, 0, 1}, {-1, 0, 1}, {0, -1, 1}}}));  // a common corner
  CHECK_FALSE(intersect(t, {{{1, 1, 2}, {9, 1, 2}, {1, 9, 2}}}));
}

TEST_CASE("a_triangle_without_area_has_no_plane") {
  CHECK_FALSE(has_plane({{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}}));
  CHECK_FALSE(has_plane({{{1, 2, 3}, {1, 2, 3}, {0, 0, 0}}}));
  CHECK(has_plane({{{0, 0, 0}, {1, 1, 1}, {3, 3, std::nextafter(3.0, 4.0)}}}));
}

TEST_CASE("distances_between_triangles_are_those_of_their_nearest_places") {
  for (int i = 0; i < 400; ++i) {
    const Corners s = lattice_triangle(4);
    Corners t = lattice_triangle(4);
    if (i % 2) {
      for (Point& p : t) p[0] += 5;
    }
    const double distance = std::sqrt(squared_distance(s, t)), sampled = sampled_distance(s, t);
    CHECK(distance <= sampled + 1e-12);
    CHECK(distance > sampled - 1.0);  // the grid's cells are at most that wide together
    CHECK(squared_distance(t, s) == doctest::Approx(distance * distance).epsilon(1e-12));
    if (has_plane(s) && has_plane(t) && intersect(s, t)) CHECK(distance == 0);
  }
  const Corners t = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  CHECK(squared_distance(t, {{{0.2, 0.2, 2}, {5, 5, 9}, {5, 6, 9}}}) == 4);
  CHECK(squared_distance(t, {{{3, 0, 0}, {3, 0, 0}, {3, 0, 0}}}) == 4);               // a point
  CHECK(squared_distance(t, {{{0.5, -1, 1}, {0.5, 2, 1}, {0.5, 0, 1}}}) == 1);        // a segment above
  CHECK(squared_distance(t, {{{0.3, 0.3, 1}, {0.3, 0.3, -1}, {0.3, 0.3, 9}}}) == 0);  // one through it
  CHECK(squared_distance({{{0.3, 0.3, 1}, {0.3, 0.3, -1}, {0.3, 0.3, 9}}}, t) == 0);
}
