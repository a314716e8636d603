// Fast, sampled distances to a model, used in cage making.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"

namespace viete::cages {

using mesh::Point, mesh::Vec3;

using Index3 = std::array<std::size_t, 3>;

/// Calls visit(i, j, k) from low to high, including both.
template <class Visit>
void for_box(const Index3& low, const Index3& high, Visit&& visit) {
  for (std::size_t k = low[2]; k <= high[2]; ++k) {
    for (std::size_t j = low[1]; j <= high[1]; ++j) {
      for (std::size_t i = low[0]; i <= high[0]; ++i) visit(i, j, k);
    }
  }
}

/// Nodes of a regular grid. With `mirrored`, nodes i = 0 lie in x = 0 and only x >= 0 is covered.
struct Grid {
  Point origin{};
  double step = 1;
  Index3 size{};  ///< nodes along each axis
  bool mirrored = false;

  std::size_t node_count() const { return size[0] * size[1] * size[2]; }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (k * size[1] + j) * size[0] + i;
  }
  Point place(std::size_t i, std::size_t j, std::size_t k) const {
    return origin + step * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
  }
  Index3 node(std::size_t index) const {
    return {index % size[0], index / size[0] % size[1], index / size[0] / size[1]};
  }
  Point place(std::size_t index) const {
    const auto [i, j, k] = node(index);
    return place(i, j, k);
  }
};

/// A grid around a box: `padding` on every side, about `cells` along the longest side. With mirrored, covers
/// the half x >= 0 of a box that is symmetric about x = 0.
Grid grid_around(const mesh::Bounds& box, std::size_t cells, double padding, bool mirrored);

struct Closing {
  double offset = 0;  ///< distance of the extracted surface from the model
  double gap = 0;     ///< closes gaps narrower than twice this; 0: none
};

/// Distances to a model, sampled on a grid and interpolated: positive outside, approximately the distance to
/// the model; smaller in closed gaps; negative inside the model and in enclosed cavities. Thread-safe.
class Clearance {
public:
  Clearance(const Grid& grid, std::vector<float> values);

  const Grid& grid() const { return grid_; }
  float at_node(std::size_t index) const { return values_[index]; }

  /// Interpolated at any point. Outside of the grid, a lower bound of the distance to the model.
  double at(const Point& p) const;

  /// True if the clearance is at least `margin` at samples on the triangle about a step apart, without its
  /// corners. A sample's clearance beyond the margin also covers the points within that distance.
  bool is_clear(const mesh::Corners& t, double margin) const;

private:
  using Place = mesh::Vec3f;  // in grid steps from the origin
  Place in_steps(const Point& p) const;
  float at(const Place& p) const;
  bool is_clear(const Place& a, const Place& b, const Place& c, float radius, float margin) const;

  Grid grid_;
  std::array<float, 3> last_;  // last node along each axis
  std::vector<float> values_;
};

/// The model as a tree of its triangles. If it is open, winding numbers decide what is inside.
struct Obstacle {
  const mesh::TriangleTree& tree;
  bool closed = false;
};

/// The outside is the region reached from the grid's border through points farther from the model than offset
/// + gap with winding number 0, grown by gap, so that gaps stay closed. Distances beyond a few more steps are
/// lower bounds. Same bits for any pool. Throws base::Cancelled.
Clearance clearance(const Obstacle& model, const Grid& grid, const Closing& closing, base::WorkerPool& pool,
                    base::Progress* progress = nullptr);

/// Adds balls around these points to the model where the clearance is less than `most`, so that details
/// smaller than a grid step are not missed.
Clearance with_balls(const Clearance& clearance, std::span<const Point> centers, double radius, double most);

}  // namespace viete::cages
