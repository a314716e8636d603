#include "mesh/triangle_tree.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::mesh;

namespace {

struct TreeCase : test::Random {
  using Random::Random;

  Corners triangle(double size) {
    const Point p = vector(1);
    return {p, p + vector(size), p + vector(size)};
  }
  // Returns random triangles, needles, segments and points.
  Surface mixed(std::size_t count) {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    for (std::uint32_t t = 0; t < count; ++t) {
      Corners c = triangle(t % 5 == 0 ? 1 : 0.1);
      if (t % 7 == 1) c[2] = c[0] + 1e-9 * (c[1] - c[0]);
      if (t % 7 == 2) c[2] = 0.5 * (c[0] + c[1]);
      if (t % 7 == 3) c[1] = c[2] = c[0];
      points.insert(points.end(), c.begin(), c.end());
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return from_triangles(points, triangles);
  }
};

Corners at(const Surface& s, std::size_t t) {
  return corners_of(s.positions, s.triangles[t]);
}

}  // namespace

TEST_CASE("tree_nearest_triangle_agrees_with_brute_force") {
  TreeCase random(1);
  for (const std::size_t count : {1, 4, 5, 63, 1000}) {
    const Surface s = random.mixed(count);
    const TriangleTree tree(s.positions, s.triangles);
    for (int i = 0; i < 200; ++i) {
      const Point p = random.vector(i % 2 ? 1.0 : 20.0);
      double least = HUGE_VAL;
      for (std::size_t t = 0; t < count; ++t) {
        const Corners c = at(s, t);
        least = std::min(least, closest_on_triangle(p, c[0], c[1], c[2]).squared_distance);
      }
      const auto found = tree.nearest(p);
      CHECK(found.squared_distance == least);
      const Corners c = at(s, found.triangle);
      CHECK(closest_on_triangle(p, c[0], c[1], c[2]).squared_distance == least);
      CHECK(tree.nearest(p, least * (1 + 1e-9)).squared_distance == least);
      CHECK(tree.nearest(p, least).squared_distance == HUGE_VAL);
      CHECK(tree.nearest(p, least).triangle == std::numeric_limits<std::uint32_t>::max());
    }
  }
}

TEST_CASE("tree_nearest_of_groups_agrees_with_brute_force") {
  TreeCase random(3);
  for (const std::uint32_t count : {1u, 5u, 40u}) {
    const Surface s = random.mixed(500);
    std::vector<std::uint32_t> groups;
    for (const Point& p : s.positions)
      groups.push_back(std::min(count - 1, static_cast<std::uint32_t>((1 + p[0]) / 2 * count)));
    const TriangleTree tree(s.positions, s.triangles, nullptr, groups);
    for (int n = 0; n < 100; ++n) {
      const Point p = random.vector(1);
      const double radius = std::abs(random.vector(0.5)[0]);
      const std::uint32_t but = n % count;
      std::map<std::uint32_t, double> expected, found, all;
      for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        const auto [a, b, c] = at(s, t);
        const double square = closest_on_triangle(p, a, b, c).squared_distance;
        const auto group = groups[s.triangles[t][0]];
        if (group == but || square > radius * radius) continue;
        const auto [known, is_new] = expected.try_emplace(group, square);
        if (!is_new) known->second = std::min(known->second, square);
      }
      for (const auto& near : tree.nearest_of_groups(p, radius, HUGE_VAL, but)) {
        CHECK(groups[s.triangles[near.triangle][0]] == near.group);
        CHECK(all.try_emplace(near.group, near.squared_distance).second);
      }
      CHECK(all == expected);
      double least = HUGE_VAL;
      for (const auto& [group, square] : expected) least = std::min(least, square);
      const auto is_farther = [&](const auto& one) { return one.second > 4 * least; };
      for (const auto& near : tree.nearest_of_groups(p, radius, 2, but))
        CHECK(found.try_emplace(near.group, near.squared_distance).second);
      std::erase_if(expected, is_farther);
      std::erase_if(found, is_farther);
      CHECK(found == expected);
    }
  }
}

TEST_CASE("tree_proximity_agrees_with_brute_force") {
  TreeCase random(2);
  int near = 0, far = 0;
  for (const std::size_t count : {1, 30, 300}) {
    const Surface s = random.mixed(count);
    const TriangleTree tree(s.positions, s.triangles);
    for (int i = 0; i < 300; ++i) {
      const Corners t = random.triangle(i % 3 == 0 ? 1 : 0.05);
      double least = HUGE_VAL;
      bool cut = false;
      for (std::size_t other = 0; other < count; ++other) {
        const Corners c = at(s, other);
        least = std::min(least, squared_distance(t, c));
        cut = cut ||
              (has_plane(c) ? intersect(t, c)
                            : crosses(c[0], c[1], t) || crosses(c[1], c[2], t) || crosses(c[2], c[0], t));
      }
      CHECK(tree.is_near(t) == cut);
      const double distance = std::sqrt(least);
      if (distance > 0) {
        CHECK(tree.is_near(t, distance * (1 + 1e-9)));
        CHECK_FALSE(tree.is_near(t, distance * (1 - 1e-9)));
      }
      ++(cut ? near : far);
    }
  }
  CHECK(near > 50);
  CHECK(far > 50);
}

TEST_CASE("tree_winding_number_agrees_with_the_exact_one") {
  TreeCase random(4);
  for (const Surface& s : {test::sphere(4), test::torus(60, 30, true), random.mixed(400)}) {
    const TriangleTree tree(s.positions, s.triangles);
    double worst = 0, sum = 0;
    for (int i = 0; i < 400; ++i) {
      const Point place = random.vector(3);
      const double error = std::abs(tree.winding_number(place) - winding_number(s, place));
      worst = std::max(worst, error);
      sum += error;
    }
    CHECK(worst < 0.08);
    CHECK(sum / 400 < 0.03);
  }
}

TEST_CASE("tree_of_equal_triangles_works") {
  const Surface one = test::cube();
  std::vector<Triangle> many(50'000, one.triangles[0]);
  const TriangleTree tree(one.positions, many);
  const Corners c = at(one, 0);
  CHECK(tree.nearest(c[0]).squared_distance == 0);
  CHECK(std::abs(tree.nearest({0, 0, -3}).squared_distance - 4) < 1e-12);
  CHECK_FALSE(tree.is_near({Point{5, 5, 5}, Point{6, 5, 5}, Point{5, 6, 5}}, 0.1));
}

TEST_CASE("building_a_tree_can_be_cancelled") {
  const Surface s = test::sphere(4);
  base::Progress progress;
  const TriangleTree tree(s.positions, s.triangles, &progress);
  CHECK(progress.done() > 0.9);
  progress.cancel();
  CHECK_THROWS_AS(TriangleTree(s.positions, s.triangles, &progress), base::Cancelled);
}

namespace {

// Computes the formula of Van Oosterom and Strackee in long double, with one arc tangent per triangle.
double by_arc_tangents(const Surface& s, const Point& p) {
  using Real = long double;
  Real sum = 0;
  for (const Triangle& t : s.triangles) {
    Real r[3][3], length[3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) r[i][k] = Real{s.positions[t[i]][k]} - Real{p[k]};
      length[i] = std::sqrt(r[i][0] * r[i][0] + r[i][1] * r[i][1] + r[i][2] * r[i][2]);
    }
    const auto dot = [&](int i, int j) { return r[i][0] * r[j][0] + r[i][1] * r[j][1] + r[i][2] * r[j][2]; };
    const Real det = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                     r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                     r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    sum += std::atan2(det, length[0] * length[1] * length[2] + dot(0, 1) * length[2] + dot(1, 2) * length[0] +
                               dot(2, 0) * length[1]);
  }
  return static_cast<double>(sum / (2 * std::acos(Real{-1})));
}

}  // namespace

TEST_CASE("a_closed_surface_winds_once_around_the_inside_and_not_around_the_outside") {
  for (const double scale : {1e-100, 1e-30, 1.0, 1e30, 1e100}) {
    const Surface s = test::moved(test::cube(), scale);
    CHECK(winding_number(s, {0, 0, 0}) == doctest::Approx(1).epsilon(1e-14));
    CHECK(winding_number(s, {0.999 * scale, 0.3 * scale, -0.9 * scale}) == doctest::Approx(1).epsilon(1e-12));
    CHECK(std::abs(winding_number(s, {1.001 * scale, 0.3 * scale, 0})) < 1e-12);
    CHECK(std::abs(winding_number(s, {1e3 * scale, 0, 0})) < 1e-12);
  }
}

TEST_CASE("winding_numbers_agree_with_a_sum_of_arc_tangents") {
  Surface open = test::sphere(2), twice = test::sphere(2), inside_out = test::cube();
  open.triangles.resize(100);
  for (const Triangle t : test::sphere(2).triangles) twice.triangles.push_back(t);
  for (Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  for (const Surface& s : {test::sphere(3), test::torus(20, 10), open, twice, inside_out}) {
    const auto points = test::Random(7).vectors(203, 3);
    base::WorkerPool pool(3);
    const auto outside = points_outside(s, points);
    CHECK(outside == points_outside(s, points, &pool));
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const double number = by_arc_tangents(s, points[i]);
      CHECK(std::abs(winding_number(s, points[i]) - number) < 1e-12);
      CHECK(std::ranges::binary_search(outside, i) == (std::abs(number) < 0.5));
    }
  }
}

TEST_CASE("points_outside_are_those_beyond_the_cage") {
  const auto points = test::Random(7).vectors(2000, 1.5);
  Surface cage = test::cube();
  for (int orientation = 0; orientation < 2; ++orientation) {
    const auto outside = points_outside(cage, points);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const Point& p = points[i];
      if (std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > 1) expected.push_back(i);
    }
    CHECK(outside == expected);
    CHECK(outside.size() > 1000);
    for (Triangle& t : cage.triangles) std::swap(t[1], t[2]);
  }
}

TEST_CASE("points_on_the_cage_are_not_outside") {
  const Surface cage = test::cube();
  CHECK(points_outside(cage, cage.positions).empty());
  std::vector<Point> points = {{1, 0, 0},       {0, 0, -1},      {1, 1, 0.3},
                               {0.25, 0.25, 1}, {-1, 0.1, -0.7}, {1 + 1e-11, 0, 0}};
  CHECK(points_outside(cage, points).empty());
  points = {{1 + 1e-6, 0, 0}, {1, 1, 1.0001}, {1, 1.5, 0}};
  CHECK(points_outside(cage, points).size() == 3);
  const Surface sphere = test::sphere(3);
  CHECK(points_outside(sphere, sphere.positions).empty());
}

TEST_CASE("every_point_is_outside_of_an_empty_cage") {
  CHECK(points_outside(test::cube(), {}).empty());
  const std::vector<Point> points = {{0, 0, 0}, {1, 2, 3}};
  CHECK(points_outside(Surface{}, points).size() == 2);
}
