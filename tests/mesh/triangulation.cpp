#include "mesh/triangulation.h"

#include <numbers>

#include "mesh/summary.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

namespace {

constexpr double half_turn = std::numbers::pi;
using Ring = std::vector<Point>;

// Returns a ring in the plane z = 0. `numbers` has x and y of each corner.
Ring flat(const std::vector<double>& numbers) {
  Ring ring;
  for (std::size_t i = 0; i < numbers.size(); i += 2) ring.push_back({numbers[i], numbers[i + 1], 0});
  return ring;
}

// Returns a ring around the origin. Corner i has the distance radius(i) from the origin.
template <class Radius>
Ring polar(std::size_t n, const Radius& radius) {
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = 2 * half_turn * static_cast<double>(i) / static_cast<double>(n), r = radius(i);
    ring.push_back({r * std::cos(a), r * std::sin(a), 0});
  }
  return ring;
}

const Ring dart = flat({2, 0, 1, 0.5, 0, 0, 1, 1.5});
const Ring u_shape = flat({0, 0, 6, 0, 6, 4, 4, 4, 4, 1.5, 2, 1.5, 2, 4, 0, 4});
// A square with a square hole. The ring uses the bridge between boundary and hole in both directions.
const Ring keyhole = flat({0, 0, 4, 0, 4, 4, 0, 4, 0, 0, 1, 1, 1, 3, 3, 3, 3, 1, 1, 1});

Ring star(std::size_t n) {
  return polar(n, [](std::size_t i) { return i % 2 ? 1.0 : 10.0; });
}

// Returns a comb with overhanging teeth. Most corners cannot see most other corners.
Ring comb(int teeth) {
  Ring ring = flat({0, -1, 3.0 * teeth, -1});
  for (int i = teeth; i-- > 0;) {
    const double x = 3 * i;
    for (const auto& p : flat({x + 2, 0, x + 4, 9, x + 3, 9, x + 1, 0})) ring.push_back(p);
  }
  return ring;
}

// Returns a band in the shape of a spiral.
Ring spiral(int n) {
  const auto at = [&](int i, double width) {
    const double a = 0.1 * i, r = 1 + 0.1 * a + width;
    return Point{r * std::cos(a), r * std::sin(a), 0};
  };
  Ring ring;
  for (int i = 0; i < n / 2; ++i) ring.push_back(at(i, 0.3));
  for (int i = n / 2; i-- > 0;) ring.push_back(at(i, 0));
  return ring;
}

// Adds a corner at the middle of each side, and repeats every third corner.
Ring with_more_corners(const Ring& ring) {
  Ring more;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& next = ring[(i + 1) % ring.size()];
    more.insert(more.end(), i % 3 ? 1 : 2, ring[i]);
    more.push_back(0.5 * (ring[i] + next));
  }
  return more;
}

// Transforms the ring by an integer matrix. Planar or collinear points stay exactly planar or collinear.
Ring onto_a_slope(const Ring& ring) {
  Ring turned;
  for (const Point& p : ring)
    turned.push_back({2 * p[0] - p[1] + 5, 2 * p[0] + 2 * p[1] - p[2], p[0] + 3 * p[1] + 2 * p[2] - 7});
  return turned;
}

Ring turned_by_rounded_numbers(const Ring& ring) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  Ring turned;
  for (const Point& p : ring) {
    const double up = s * p[0] + c * p[1];
    turned.push_back({c * p[0] - s * p[1], 0.8 * up, 0.6 * up + p[2]});
  }
  return turned;
}

Vec3 area_of(const Ring& ring) {
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 2; i < ring.size(); ++i)
    sum = sum + 0.5 * cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  return sum;
}

// Checks that the triangles form a disc with the ring as its boundary, and that no triangle is reversed. The
// triangles then cover each point of a simple ring once.
void check_cover(const Ring& ring, const std::vector<Triangle>& triangles) {
  CAPTURE(ring.size());
  REQUIRE(triangles.size() == ring.size() - 2);
  const Vec3 area = area_of(ring);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  double sum = 0, worst = 0;
  for (const auto& t : triangles) {
    REQUIRE((t[0] < t[1] && t[1] < t[2] && t[2] < ring.size()));
    const Vec3 own = 0.5 * cross(ring[t[1]] - ring[t[0]], ring[t[2]] - ring[t[0]]);
    sum += norm(own);
    worst = std::min(worst, dot(own, area) / squared_norm(area));
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  }
  CHECK(sum == doctest::Approx(norm(area)).epsilon(1e-12));
  CHECK(worst > -1e-14);
  bool is_disc = true;
  const auto n = static_cast<std::uint32_t>(ring.size());
  for (const auto& [side, count] : sides) {
    const bool on_rim = side.second == (side.first + 1) % n;
    is_disc &= count == 1 && on_rim != sides.contains({side.second, side.first});
  }
  CHECK(is_disc);
}

std::size_t without_area(const Ring& ring) {
  std::size_t count = 0;
  for (const auto& [i, j, k] : triangulation(ring))
    count += stable_norm(cross(ring[j] - ring[i], ring[k] - ring[i])) < 1e-12 * norm(area_of(ring));
  return count;
}

Ring from_corner(Ring ring, std::size_t first) {
  std::ranges::rotate(ring, ring.begin() + static_cast<std::ptrdiff_t>(first));
  return ring;
}

std::vector<Triangle> fan(std::size_t n) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 2; i < n; ++i) triangles.push_back({0, i - 1, i});
  return triangles;
}

}  // namespace

TEST_CASE("convex_polygon_is_a_fan") {
  for (std::size_t n = 3; n < 40; ++n) {
    const Ring ring = polar(n, [](std::size_t) { return 1.0; });
    for (const Ring& r : {ring, onto_a_slope(ring), turned_by_rounded_numbers(ring)})
      CHECK(triangulation(r) == fan(n));
  }
}

TEST_CASE("collinear_corners_make_no_triangles_without_area_and_repeated_corners_one_each") {
  const Ring square = flat({0, 0, 1, 0, 1, 1, 0, 1});
  for (const Ring& r : {with_more_corners(square), with_more_corners(onto_a_slope(square)),
                        with_more_corners(turned_by_rounded_numbers(square))}) {
    for (std::size_t first = 0; first < r.size(); ++first) {
      const Ring from = from_corner(r, first);
      check_cover(from, triangulation(from));
      CHECK(without_area(from) == 2);
    }
  }
  const Ring with_a_corner_in_an_edge = flat({0, 0, 2, 0, 0, 2, 0, 1});
  for (std::size_t first = 0; first < 4; ++first)
    CHECK(without_area(from_corner(with_a_corner_in_an_edge, first)) == 0);
}

TEST_CASE("every_simple_polygon_is_covered_once_from_any_first_corner") {
  for (const Ring& shape : {dart, u_shape, keyhole, star(10), star(21), comb(3), spiral(140)})
    for (const Ring& ring : {shape, with_more_corners(shape)})
      for (const Ring& placed : {ring, onto_a_slope(ring), turned_by_rounded_numbers(ring)})
        for (std::size_t first = 0; first < ring.size(); first += 1 + ring.size() / 30) {
          const Ring from = from_corner(placed, first);
          check_cover(from, triangulation(from));
        }
}

TEST_CASE("only_repeated_corners_make_triangles_without_area") {
  CHECK(without_area(u_shape) == 0);
  CHECK(without_area(keyhole) == 0);
  Ring ring;  // the U-shape with a corner in the middle of each side
  for (std::size_t i = 0; i < u_shape.size(); ++i) {
    ring.push_back(u_shape[i]);
    ring.push_back(0.5 * (u_shape[i] + u_shape[(i + 1) % u_shape.size()]));
  }
  CHECK(without_area(ring) == 0);
  CHECK(without_area(onto_a_slope(ring)) == 0);
  ring.insert(ring.begin() + 5, ring[5]);
  CHECK(without_area(ring) == 1);
}

TEST_CASE("polygons_that_touch_themselves_are_covered") {
  // Two bridges from one corner; a hole that touches a side; a slit; two corners that touch.
  const Ring two_bridges =
      flat({0, 0, 9, 0, 9, 9, 0, 9, 0, 0, 1, 5, 2, 6, 2, 5, 1, 5, 0, 0, 4, 2, 5, 3, 6, 2, 4, 2});
  const Ring hole_at_side = flat({0, 0, 4, 0, 4, 4, 2, 4, 3, 2, 1, 2, 2, 4, 0, 4});
  const Ring slit = flat({0, 0, 4, 0, 4, 4, 2, 4, 2, 1, 2, 4, 0, 4});
  const Ring touching_corner = flat({0, 0, 4, 0, 4, 4, 2, 4, 2, 2, 0, 0, 1, 2, 1, 4, 0, 4});
  for (const Ring& ring : {two_bridges, hole_at_side, slit, touching_corner})
    for (std::size_t first = 0; first < ring.size(); ++first) {
      const Ring from = from_corner(ring, first), slope = onto_a_slope(from);
      check_cover(from, triangulation(from));
      check_cover(slope, triangulation(slope));
    }
}

TEST_CASE("polygons_of_thousands_of_corners_are_covered") {
  for (const Ring& ring : {star(10000), comb(2500), spiral(10000), with_more_corners(spiral(1000))}) {
    check_cover(ring, triangulation(ring));
    const Ring slope = onto_a_slope(ring);
    check_cover(slope, triangulation(slope));
  }
}

TEST_CASE("almost_planar_polygons_are_triangulated_along_their_normal") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> off(-1e-3, 1e-3);
  for (const Ring& shape : {u_shape, star(14), comb(4), spiral(100)}) {
    Ring ring = onto_a_slope(shape);
    for (Point& p : ring) p = p + Point{off(random), off(random), off(random)};
    const auto triangles = triangulation(ring);
    REQUIRE(triangles.size() == ring.size() - 2);
    const Vec3 normal = area_of(ring);
    for (const auto& [i, j, k] : triangles)
      CHECK(dot(cross(ring[j] - ring[i], ring[k] - ring[i]), normal) > 0);
  }
}

TEST_CASE("a_bent_quad_keeps_its_first_diagonal_as_long_as_it_is_convex_along_its_normal") {
  for (const double height : {0.0, 0.3, -2.0}) {
    CHECK(triangulation(Ring{{0, 0, 0}, {1, 0, height}, {1, 1, 0}, {0, 1, height}}) == fan(4));
    CHECK(triangulation(Ring{{0, 0, height}, {0.4, 0.3, 0}, {1, 0, height}, {0.4, 1, 0}}) != fan(4));
  }
}

TEST_CASE("triangulation_is_invariant_under_scaling_and_mirroring") {
  for (const Ring& ring : {u_shape, star(16), comb(3), spiral(60), keyhole, with_more_corners(u_shape)}) {
    const auto triangles = triangulation(ring);
    for (const double scale : {1e-100, 3e-20, 7.0, 1e99}) {
      Ring scaled;
      for (const Point& p : ring) scaled.push_back(scale * p);
      CHECK(triangulation(scaled) == triangles);
    }
  }
  for (const Ring& ring : {comb(3), spiral(60), with_more_corners(comb(2))}) {
    const auto n = static_cast<std::uint32_t>(ring.size());
    Ring image{ring[0]};
    for (std::size_t i = n - 1; i > 0; --i) image.push_back(ring[i]);
    for (Point& p : image) p[0] = -p[0];
    std::vector<Triangle> mirrored;
    for (auto t : triangulation(ring)) {
      for (auto& i : t) i = (n - i) % n;
      std::ranges::sort(t);
      mirrored.push_back(t);
    }
    std::ranges::sort(mirrored);
    CHECK(triangulation(image) == mirrored);
  }
}

TEST_CASE("self_crossing_or_flat_polygons_get_n_minus_2_triangles") {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Ring> rings = {polar(5, [](std::size_t) { return 1.0; }), flat({0, 0, 1, 1, 1, 0, 0, 1}),
                             Ring(7, Point{3, 4, 5}), flat({0, 0, 1, 0, 2, 0, 0.5, 0, 1.5, 0})};
  std::swap(rings[0][1], rings[0][3]);
  for (const std::size_t n : {5, 6, 9, 50, 5000}) {
    Ring& ring = rings.emplace_back(n);
    for (Point& p : ring) p = {any(random), any(random), any(random)};
  }
  for (const Ring& ring : rings) {
    const auto triangles = triangulation(ring);
    REQUIRE(triangles.size() == ring.size() - 2);
    std::vector<std::uint8_t> used(ring.size(), 0);
    for (const auto& [i, j, k] : triangles) {
      REQUIRE((i < j && j < k && k < ring.size()));
      used[i] = used[j] = used[k] = 1;
    }
    CHECK(std::ranges::count(used, 1) == static_cast<std::ptrdiff_t>(ring.size()));
    CHECK(triangulation(ring) == triangles);
  }
}

TEST_CASE("triangles_refer_to_their_polygon_corners") {
  // The keyhole's bridge has two corners at one vertex. A vertex therefore does not identify a corner.
  Surface s;
  s.positions = flat({0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 1, 3, 3, 3, 3, 1, 9, 9});
  s.corners = {1, 8, 2, 0, 1, 2, 3, 0, 4, 5, 6, 7, 4, 1, 0, 7};
  s.polygon_starts = {0, 3, 13, 16};
  triangulate(s);
  test::check_invariants(s);
  const double area =
      0.5 * norm(cross(s.positions[8] - s.positions[1], s.positions[2] - s.positions[1])) + 12 + 2;
  CHECK(summarize(s).area == doctest::Approx(area));
  std::size_t t = 0;
  std::vector<int> uses(s.corners.size(), 0);
  for_each_triangle(s, [&](const Triangle& triangle, const Triangle& corners) {
    const std::uint32_t polygon = s.triangle_polygon[t++];
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(triangle[k] == s.corners[corners[k]]);
      CHECK((corners[k] >= s.polygon_starts[polygon] && corners[k] < s.polygon_starts[polygon + 1]));
      ++uses[corners[k]];
    }
  });
  CHECK(t == s.triangles.size());
  CHECK(std::ranges::count(uses, 0) == 0);
  CHECK(clipped_of(s, 0).empty());
  CHECK(clipped_of(s, 1).size() == 8);
  CHECK(clipped_of(s, 2).empty());
}
