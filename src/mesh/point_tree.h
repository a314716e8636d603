// Nearest point to a point, an edge or a triangle.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// A kd tree over a subset of positions, which the caller must keep alive. Thread-safe.
class PointTree {
public:
  /// Tree over positions[i] for all i of `some`, at least one. O(n log n).
  PointTree(std::span<const Point> positions, std::vector<std::uint32_t> some);

  /// The i whose point is nearest to the triangle; the lowest on a tie. Repeated corners make it an edge or a
  /// point, see closest_on_triangle().
  std::uint32_t nearest(const Point& a, const Point& b, const Point& c) const;
  std::uint32_t nearest(const Point& p) const { return nearest(p, p, p); }
  /// Calls visit(i) for every point within radius of p, in any order.
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
  std::vector<Ball> balls_;  // node i has the children 2 i + 1 and 2 i + 2
};

}  // namespace viete::mesh
