// Which of many points is nearest to a point, an edge or a triangle.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// A kd tree over some of an array of positions that the caller keeps. Thread-safe.
class PointTree {
public:
  /// Tree over positions[i] for all i of `some`, at least one. O(n log n).
  PointTree(std::span<const Point> positions, std::vector<std::uint32_t> some);

  /// The i whose point is nearest to the triangle (see closest_on_triangle(): repeated corners make it an
  /// edge or a point); the lowest of those that are equally near.
  std::uint32_t nearest(const Point& a, const Point& b, const Point& c) const;
  std::uint32_t nearest(const Point& p) const { return nearest(p, p, p); }
  /// visit(i) of all points that are no farther from p than radius, in any order.
  void for_within(const Point& p, double radius, const std::function<void(std::uint32_t)>& visit) const;

private:
  struct Ball {
    Point center;
    double radius;
  };
  static double least(double to_center, const Ball& ball);
  static double bound(const Point& p, const Ball& ball);
  struct Search;
  void build(std::size_t node, std::size_t begin, std::size_t end);
  void search(std::size_t node, std::size_t begin, std::size_t end, Search& search) const;

  std::span<const Point> positions_;
  std::vector<std::uint32_t> points_;
  std::vector<Ball> balls_;  // of node i and its children 2 i + 1 and 2 i + 2
};

}  // namespace viete::mesh
