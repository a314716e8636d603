#include "mesh/point_tree.h"
#include "mesh/point_index.h"

#include <doctest/doctest.h>

#include <map>
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
    if (d < least || (d == least && i < best)) {
      best = i;
      least = d;
    }
  }
  return best;
}

std::vector<std::uint32_t> every(std::size_t count, std::size_t step) {
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < count; i += step) some.push_back(static_cast<std::uint32_t>(i));
  return some;
}

}  // namespace

TEST_CASE("nearest_point_agrees_with_brute_force") {
  for (const double size : {1e-30, 1.0, 1e30})
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

TEST_CASE("ties_of_nearest_points_go_to_the_lowest_index") {
  std::vector<Point> points(1000, Point{1, 2, 3});
  CHECK(PointTree(points, every(points.size(), 1)).nearest({0, 0, 0}) == 0);
  std::vector<std::uint32_t> backwards = every(points.size(), 1);
  std::reverse(backwards.begin(), backwards.end());
  backwards.pop_back();
  CHECK(PointTree(points, backwards).nearest({0, 0, 0}) == 1);
  // The eight corners of a cube, 50 times each.
  points.clear();
  for (int i = 0; i < 400; ++i) points.push_back({i & 1 ? 1.0 : -1, i & 2 ? 1.0 : -1, i & 4 ? 1.0 : -1});
  CHECK(PointTree(points, every(points.size(), 1)).nearest({0, 0, 0}) == 0);
  CHECK(PointTree(points, every(points.size(), 1)).nearest({0, 0, 1}, {0, 0, 2}, {0, 0, 2}) == 4);
}

TEST_CASE("equal_points_share_an_index") {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> few(0, 19);
  PointIndex index;
  std::vector<Point> positions;
  std::map<Point, std::uint32_t> reference;
  for (int i = 0; i < 20000; ++i) {
    const Point p = {few(random) / 7.0, few(random) * 1e30, few(random) * 1e-30};
    const auto expected = reference.try_emplace(p, static_cast<std::uint32_t>(positions.size()));
    const std::uint32_t found = index.find_or_add(p, positions);
    REQUIRE(found == expected.first->second);
    if (found == positions.size()) positions.push_back(p);
  }
  CHECK(positions.size() == reference.size());
  CHECK(positions.size() > 5000);
}
