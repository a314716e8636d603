#include "mesh/self_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mesh/orientation.h"

namespace viete::mesh {

namespace {

using Corners = std::array<Point, 3>;

Point2 without(const Point& p, int axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

// The axis along which the triangle is seen with area; -1 if it has none.
int visible_axis(const Corners& t) {
  for (int axis = 0; axis < 3; ++axis) {
    if (orientation(without(t[0], axis), without(t[1], axis), without(t[2], axis)) != 0) return axis;
  }
  return -1;
}

// An edge of s has t wholly on its outer side, or on it.
bool edge_separates(const Corners& s, const Corners& t, int axis) {
  for (int i = 0; i < 3; ++i) {
    const Point2 a = without(s[i], axis), b = without(s[(i + 1) % 3], axis);
    const int inner = orientation(a, b, without(s[(i + 2) % 3], axis));
    const auto outside = [&](const Point& p) { return orientation(a, b, without(p, axis)) * inner <= 0; };
    if (std::all_of(t.begin(), t.end(), outside)) return true;
  }
  return false;
}

// Two of equal sign, or one and zeros.
bool same_side(int a, int b, int c) {
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// An edge of s goes through t: its ends lie on both sides of the plane, and its line meets the triangle.
bool edge_crosses(const Corners& s, const Corners& t, const std::array<int, 3>& sides) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (sides[i] * sides[j] >= 0) continue;
    if (same_side(orientation(s[i], s[j], t[0], t[1]), orientation(s[i], s[j], t[1], t[2]),
                  orientation(s[i], s[j], t[2], t[0]))) {
      return true;
    }
  }
  return false;
}

std::array<int, 3> sides_of(const Corners& s, const Corners& t) {
  return {orientation(t[0], t[1], t[2], s[0]), orientation(t[0], t[1], t[2], s[1]),
          orientation(t[0], t[1], t[2], s[2])};
}

bool intersect(const Corners& s, const Corners& t) {
  const auto of_s = sides_of(s, t);
  if (of_s == std::array{0, 0, 0}) {
    const int axis = visible_axis(s);
    return !edge_separates(s, t, axis) && !edge_separates(t, s, axis);
  }
  if (of_s[0] * of_s[1] > 0 && of_s[1] * of_s[2] > 0) return false;
  return edge_crosses(s, t, of_s) || edge_crosses(t, s, sides_of(t, s));
}

bool meet(const Bounds& a, const Bounds& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

class Sweep {
public:
  explicit Sweep(const Surface& surface) : found_(surface.triangles.size(), 0) {
    const Bounds all = used_bounds(surface);
    for (int k = 1; k < 3; ++k) {
      if (all.high[k] - all.low[k] > all.high[axis_] - all.low[axis_]) axis_ = k;
    }
    take_corners(surface, all);
  }

  std::vector<std::uint32_t> run(base::Progress* progress) {
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (progress && i % 256 == 0)
        progress->report(static_cast<double>(i) / static_cast<double>(order_.size()));
      const auto t = order_[i];
      std::erase_if(open, [&](std::uint32_t s) { return boxes_[s].high[axis_] < boxes_[t].low[axis_]; });
      for (const auto s : open) test(s, t);
      open.push_back(t);
    }
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t t = 0; t < found_.size(); ++t) {
      if (found_[t]) triangles.push_back(t);
    }
    return triangles;
  }

private:
  // Scaled by a power of two, which rounds nothing, so that no product leaves the range of double.
  void take_corners(const Surface& surface, const Bounds& all) {
    double largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(all.low[k]), std::abs(all.high[k])});
    const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
    for (const Triangle& t : surface.triangles) {
      Corners corners;
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) corners[i][k] = std::ldexp(surface.positions[t[i]][k], exponent);
      }
      if (visible_axis(corners) >= 0) order_.push_back(static_cast<std::uint32_t>(corners_.size()));
      corners_.push_back(corners);
      boxes_.push_back(bounds(corners));
    }
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t s, std::uint32_t t) { return boxes_[s].low[axis_] < boxes_[t].low[axis_]; });
  }

  void test(std::uint32_t s, std::uint32_t t) {
    if ((found_[s] && found_[t]) || !meet(boxes_[s], boxes_[t])) return;
    if (intersect(corners_[s], corners_[t])) found_[s] = found_[t] = 1;
  }

  int axis_ = 0;
  std::vector<Corners> corners_;
  std::vector<Bounds> boxes_;
  std::vector<std::uint32_t> order_;  // those with area, by where they begin along the axis
  std::vector<std::uint8_t> found_;
};

}  // namespace

std::vector<std::uint32_t> self_intersecting_triangles(const Surface& surface, base::Progress* progress) {
  return Sweep(surface).run(progress);
}

}  // namespace viete::mesh
