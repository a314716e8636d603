#include "mesh/point_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/triangle.h"

namespace viete::mesh {

namespace {

constexpr std::size_t points_per_leaf = 8;
constexpr double rounding = 1e-12;  // the largest relative rounding error of radius and distance

std::size_t middle_of(std::size_t begin, std::size_t end) {
  return begin + (end - begin) / 2;
}

int longest_side(const Bounds& box) {
  const Point size = box.high - box.low;
  return static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
}

}  // namespace

struct PointTree::Search {
  Point a, b, c;
  double slack = -1;  // if not negative, `near` lists the points that were within `slack` of the best
  double squared_distance = std::numeric_limits<double>::infinity();
  std::uint32_t best = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::pair<double, std::uint32_t>> near{};  // distances and points

  // Returns the largest squared distance of interest.
  double limit() const {
    const double farthest = std::sqrt(squared_distance) + slack;
    return slack < 0 ? squared_distance : farthest * farthest;
  }

  double squared_distance_to(const Point& p) const {
    return closest_on_triangle(p, a, b, c).squared_distance;
  }
  // Returns a lower bound of the distances to the points in the ball.
  double bound(const Ball& ball) const {
    const double to_center = std::sqrt(squared_distance_to(ball.center));
    return std::max(0.0, to_center * (1 - rounding) - ball.radius * (1 + rounding));
  }
  void visit(std::uint32_t i, const Point& p) {
    const double d = squared_distance_to(p);
    if (slack >= 0 && d <= limit()) near.push_back({std::sqrt(d), i});
    if (d > squared_distance || (d == squared_distance && i > best)) return;
    squared_distance = d;
    best = i;
  }
};

PointTree::PointTree(std::span<const Point> positions, const std::vector<std::uint32_t>& some) {
  points_.reserve(some.size());
  for (const auto i : some) points_.push_back({positions[i], i});
  build(0, 0, points_.size());
}

void PointTree::build(std::size_t node, std::size_t begin, std::size_t end) {
  const auto run = std::span(points_).subspan(begin, end - begin);
  Bounds box{run[0].position, run[0].position};
  for (const Placed& p : run) extend(box, p.position);
  if (balls_.size() <= node) balls_.resize(node + 1);
  balls_[node] = {box.center(), 0.5 * box.diagonal()};
  if (run.size() <= points_per_leaf) return;
  const std::size_t middle = middle_of(begin, end);
  const int side = longest_side(box);
  std::nth_element(run.begin(), run.begin() + static_cast<std::ptrdiff_t>(middle - begin), run.end(),
                   [&](const Placed& p, const Placed& q) { return p.position[side] < q.position[side]; });
  build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

void PointTree::search(std::size_t node, std::size_t begin, std::size_t end, Search& s) const {
  if (end - begin <= points_per_leaf) {
    for (std::size_t n = begin; n < end; ++n) s.visit(points_[n].index, points_[n].position);
    return;
  }
  const std::size_t middle = middle_of(begin, end), left = 2 * node + 1, right = left + 1;
  const double to_left = s.bound(balls_[left]), to_right = s.bound(balls_[right]);
  const auto go = [&](std::size_t child, double bound) {
    if (bound * bound > s.limit()) return;
    child == left ? search(left, begin, middle, s) : search(right, middle, end, s);
  };
  const bool left_first = to_left <= to_right;
  go(left_first ? left : right, left_first ? to_left : to_right);
  go(left_first ? right : left, left_first ? to_right : to_left);
}

std::uint32_t PointTree::nearest(const Point& a, const Point& b, const Point& c) const {
  Search s{a, b, c};
  search(0, 0, points_.size(), s);
  return s.best;
}

std::vector<std::uint32_t> PointTree::all_nearest(const Point& a, const Point& b, const Point& c,
                                                  double slack) const {
  Search s{a, b, c, slack};
  search(0, 0, points_.size(), s);
  std::vector<std::uint32_t> nearest;
  for (const auto& [distance, i] : s.near)
    if (distance <= std::sqrt(s.squared_distance) + slack) nearest.push_back(i);
  std::ranges::sort(nearest);
  return nearest;
}

void PointTree::for_within(const Point& p, double radius,
                           const std::function<void(std::uint32_t)>& visit) const {
  const auto go = [&](const auto& self, std::size_t node, std::size_t begin, std::size_t end) -> void {
    const double reach = (radius + balls_[node].radius) * (1 + 2 * rounding);
    if (squared_norm(balls_[node].center - p) > reach * reach) return;
    if (end - begin > points_per_leaf) {
      const std::size_t middle = middle_of(begin, end);
      self(self, 2 * node + 1, begin, middle);
      self(self, 2 * node + 2, middle, end);
      return;
    }
    for (std::size_t n = begin; n < end; ++n) {
      if (squared_norm(points_[n].position - p) <= radius * radius) visit(points_[n].index);
    }
  };
  go(go, 0, 0, points_.size());
}

}  // namespace viete::mesh
