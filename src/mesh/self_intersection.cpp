#include "mesh/self_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mesh/triangle_tree.h"

namespace viete::mesh {

namespace {

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
      if (has_plane(corners)) order_.push_back(static_cast<std::uint32_t>(corners_.size()));
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
