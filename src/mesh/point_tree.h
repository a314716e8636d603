// Finds the point nearest to a point, an edge or a triangle.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// A kd tree of points. Thread-safe.
class PointTree {
public:
  /// Makes a tree of the points with the indices `some`. `some` must not be empty.
  PointTree(std::span<const Point> positions, const std::vector<std::uint32_t>& some);

  /// Returns the index of the point nearest to the triangle. If several points are equally near, returns the
  /// lowest index. For an edge, pass two equal corners. For a point, pass three equal corners.
  std::uint32_t nearest(const Point& a, const Point& b, const Point& c) const;
  std::uint32_t nearest(const Point& p) const { return nearest(p, p, p); }
  /// Returns all points whose distance to the triangle is at most `slack` larger than that of the nearest
  /// point. Ascending.
  std::vector<std::uint32_t> all_nearest(const Point& a, const Point& b, const Point& c, double slack) const;
  /// Calls visit(i) for every point i whose distance to p is at most the radius, in any order.
  void for_within(const Point& p, double radius, const std::function<void(std::uint32_t)>& visit) const;

private:
  struct Ball {
    Point center;
    double radius;
  };
  struct Placed {
    Point position;
    std::uint32_t index;
  };
  struct Search;
  void build(std::size_t node, std::size_t begin, std::size_t end);
  void search(std::size_t node, std::size_t begin, std::size_t end, Search& search) const;

  std::vector<Placed> points_;
  std::vector<Ball> balls_;  // node i has the children 2 * i + 1 and 2 * i + 2
};

}  // namespace viete::mesh
