#include "mesh/point_tree.h"

#include <doctest/doctest.h>

#include <map>
#include <numeric>
#include <random>

#include "mesh/triangle.h"

using namespace viete::mesh;

namespace {

std::vector<Point> random_points(std::size_t count, double size, const Point& about) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> coordinate(-size, size);
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(about + Point{coordinate(engine), coordinate(engine), 0.1 * coordinate(engine)});
  return points;
}

std::uint32_t nearest_of_all(const std::vector<Point>& points, const std::vector<std::uint32_t>& some,
                             const Point& a, const Point& b, const Point& c) {
  std::uint32_t best = some.front();
  double least = HUGE_VAL;
  for (const auto i : some) {
    const double d = closest_on_triangle(points[i], a, b, c).squared_distance;
    if (d < least || (d == least && i < best)) best = i, least = d;
  }
  return best;
}

std::vector<std::uint32_t> every(std::size_t count, std::size_t step) {
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < count; i += step) some.push_back(static_cast<std::uint32_t>(i));
  return some;
}

}  // namespace

TEST_CASE("the_nearest_point_is_that_of_all_points_one_by_one") {
  for (const double size : {1e-30, 1.0, 1e30}) {
    for (const Point about : {Point{0, 0, 0}, Point{100 * size, 0, -50 * size}}) {
      const auto points = random_points(3000, size, about);
      const auto targets = random_points(300, 2 * size, about);
      for (const std::size_t step : {1, 7, 2999}) {
        const auto some = every(points.size(), step);
        const PointTree tree(points, some);
        for (std::size_t i = 0; i + 2 < targets.size(); i += 3) {
          const auto &a = targets[i], &b = targets[i + 1], &c = targets[i + 2];
          CHECK(tree.nearest(a, b, c) == nearest_of_all(points, some, a, b, c));
          CHECK(tree.nearest(a, b, b) == nearest_of_all(points, some, a, b, b));
          CHECK(tree.nearest(a) == nearest_of_all(points, some, a, a, a));
          CHECK(tree.nearest(points[some[i % some.size()]]) == some[i % some.size()]);
        }
      }
    }
  }
}

TEST_CASE("of_points_that_are_equally_near_the_lowest_is_taken") {
  std::vector<Point> points(1000, Point{1, 2, 3});
  CHECK(PointTree(points, every(points.size(), 1)).nearest({0, 0, 0}) == 0);
  std::vector<std::uint32_t> backwards = every(points.size(), 1);
  std::reverse(backwards.begin(), backwards.end());
  backwards.pop_back();
  CHECK(PointTree(points, backwards).nearest({0, 0, 0}) == 1);
  // The corners of many cubes about their middle.
  points.clear();
  for (int i = 0; i < 400; ++i) points.push_back({i & 1 ? 1.0 : -1, i & 2 ? 1.0 : -1, i & 4 ? 1.0 : -1});
  CHECK(PointTree(points, every(points.size(), 1)).nearest({0, 0, 0}) == 0);
  CHECK(PointTree(points, every(points.size(), 1)).nearest({0, 0, 1}, {0, 0, 2}, {0, 0, 2}) == 4);
}

TEST_CASE("the_nearest_of_each_group_is_what_a_look_at_all_finds") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  for (const std::uint32_t count : {1u, 5u, 40u}) {
    std::vector<Point> points;
    std::vector<std::uint32_t> all, groups;
    for (std::uint32_t i = 0; i < 500; ++i) {
      points.push_back({std::round(20 * any(random)), any(random), any(random)});
      all.push_back(i), groups.push_back(static_cast<std::uint32_t>(points.back()[0] * count / 21));
    }
    const PointTree tree(points, all, groups);
    for (int n = 0; n < 100; ++n) {
      const Point p{20 * any(random), any(random), any(random)};
      const double radius = 4 * any(random);
      const std::uint32_t but = groups[random() % groups.size()];
      std::map<std::uint32_t, std::pair<double, std::uint32_t>> expected, found;
      for (const std::uint32_t i : all) {
        const double square = squared_norm(points[i] - p);
        if (groups[i] == but || square > radius * radius) continue;
        const auto [at, is_new] = expected.try_emplace(groups[i], square, i);
        if (!is_new) at->second = std::min(at->second, {square, i});
      }
      for (const auto& near : tree.nearest_of_groups(p, radius, but))
        CHECK(found.try_emplace(near.group, near.squared_distance, near.point).second);
      CHECK(found == expected);
    }
  }
}
